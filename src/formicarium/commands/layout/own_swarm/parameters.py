"""Every number of the swarm, with unit, bounds and reason."""

from formicarium.tables import Table, number
from formicarium.trial.swarm.arena import ArenaTable
from formicarium.trial.swarm.parameters import SwarmParameters


class OwnArena(ArenaTable):
    """The arena: a square."""

    side: float = number(1.6, "m", "length of a wall", gt=0.3, le=10)


class Behaviour(Table):
    """What a robot does."""

    speed: float = number(0.08, "m/s", "of a walk", gt=0, le=0.12)
    turn_rate: float = number(2.0, "rad/s", "of a turn away from what is ahead", gt=0, le=4)
    near: float = number(0.20, "m", "who is heard from nearer than this counts as a neighbour", gt=0, le=0.8)
    stay: float = number(0.05, "1/s", "rate at which a walking robot stops, times the number of its neighbours", ge=0)
    leave: float = number(0.10, "1/s", "rate at which a resting robot leaves, over (1 + neighbours)^2", ge=0)


class Parameters(SwarmParameters):
    """All of a trial."""

    arena: OwnArena = OwnArena()
    behaviour: Behaviour = Behaviour()

"""Two castes in one swarm: scouts and carriers, with bodies, wheels, sensors and behaviours of their own.

Scouts are small and fast and look at the ground: on white floor they stop and shine green. Carriers are large, heavy,
slow and short-sighted and look at lights: they walk until they see green, and go there.
"""

import math
from enum import IntEnum

import numpy as np

from formicarium.compiled import compiled
from formicarium.control.moves import steer
from formicarium.control.speech import be_quiet
from formicarium.robots.epuck import PROXIMITY_COSINES, PROXIMITY_SINES, Epuck
from formicarium.robots.records import Colour
from formicarium.streams import advanced, uniform
from formicarium.systems.own import Swarm, assemble
from formicarium.tables import Table, number
from formicarium.trial.swarm.arena import Arena, ArenaTable, Floor
from formicarium.trial.swarm.castes import Caste, act, sense
from formicarium.trial.swarm.parameters import SwarmParameters, SwarmTable
from formicarium.trial.swarm.phases import move, note_roles, serve


class Kind(IntEnum):
    """The castes."""

    SCOUT = 0
    CARRIER = 1


class Numbers(Table):
    """How many scouts, and what robots do."""

    scouts: float = number(0.34, "1", "share of the swarm that scouts", ge=0, le=1)
    white: float = number(0.5, "1", "ground readings above this are white floor", gt=0, lt=1)
    near: float = number(0.12, "m", "a carrier this near to a scout's light has arrived", gt=0, le=0.5)


class Parameters(SwarmParameters):
    """All of a trial. The group epuck is the scouts', the group carrier the carriers'."""

    swarm: SwarmTable = SwarmTable(robots=12, time_cap=90.0)
    epuck: Epuck = Epuck(radius=0.03, mass=0.3, proximity_start=0.03)
    carrier: Epuck = Epuck(radius=0.04, mass=1.2, proximity_start=0.04, speed_limit=0.05, camera_range=0.25)
    arena: ArenaTable = ArenaTable()
    behaviour: Numbers = Numbers()


class Role(IntEnum):
    """What a robot is at."""

    WALKING = 0
    SHINING = 1
    ARRIVED = 2


class EventKind(IntEnum):
    """What the log tells."""

    ROLE = 0
    DIED = 1


# A memory's field "caste" is written before the first cycle; robots know what they are.
MEMORY = np.dtype([("role", "i8"), ("caste", "i8"), ("draws", "u8"), ("turn", "f8")], align=True)


@compiled
def decide(reading, memory, command, table, epuck, cycle_time):
    """Read, remember, decide; each caste its own way."""
    be_quiet(command)
    if memory.caste == Kind.SCOUT:
        scout(reading, memory, command, table, epuck)
    else:
        carry(reading, memory, command, table, epuck)


@compiled
def scout(reading, memory, command, table, epuck):
    """Walk until the floor is white, then shine."""
    if reading.ground[1] > table.white:
        memory.role = Role.SHINING
    if memory.role == Role.SHINING:
        command.colour = Colour.GREEN
    else:
        walk(reading, memory, command, epuck)


@compiled
def carry(reading, memory, command, table, epuck):
    """Go to the nearest green light; walk where none is seen."""
    for n in range(reading.blob_count):
        if reading.blobs[n].colour == Colour.GREEN:
            memory.role = Role.ARRIVED if reading.blobs[n].distance < table.near else Role.WALKING
            if memory.role == Role.WALKING:
                go(reading, command, reading.blobs[n].bearing, epuck)
            return
    memory.role = Role.WALKING
    walk(reading, memory, command, epuck)


@compiled
def walk(reading, memory, command, epuck):
    """Wander, away from what is near."""
    memory.draws = advanced(memory.draws)
    memory.turn = 0.95 * memory.turn + 0.4 * (uniform(memory.draws) - 0.5)
    go(reading, command, memory.turn, epuck)


@compiled
def go(reading, command, direction, epuck):
    """Drive in a direction, away from what is near, as fast as one's own wheels can."""
    ahead, aside = math.cos(direction), math.sin(direction)
    for k in range(8):
        ahead -= 3.0 * reading.proximity[k] * PROXIMITY_COSINES[k]
        aside -= 3.0 * reading.proximity[k] * PROXIMITY_SINES[k]
    steer(command, math.atan2(aside, ahead), epuck.speed_limit, 4.0, 3.0, epuck.wheel_distance)


@compiled
def run(state, cycles):
    """Sense, decide, act, move, serve, note; ``sense`` and ``act`` are those for castes."""
    clock = state.clock[0]
    for _ in range(cycles):
        if clock.finished == 1:
            return
        sense(state)
        for i in range(len(state.robots)):
            if state.robots[i].alive == 1:
                decide(
                    state.readings[i],
                    state.memories[i],
                    state.commands[i],
                    state.behaviour[0],
                    state.epuck[state.castes[i]],
                    state.world.settings[0].cycle_time,
                )
        act(state)
        move(state)
        serve(state)
        note_roles(state)
        clock.cycle += 1


def castes(parameters):
    """Return how many robots of each caste there are, and their tables; robot 1 is the first scout."""
    scouts = round(parameters.behaviour.scouts * parameters.swarm.robots)
    return Caste(scouts, parameters.epuck), Caste(parameters.swarm.robots - scouts, parameters.carrier)


def arena(parameters):
    """Return a square room with white floor in the middle of one side."""
    half = 0.6
    return Arena(
        outline=((-half, -half), (half, -half), (half, half), (-half, half)),
        floor=(Floor(rectangle=(-0.2, 0.2, 0.2, half), shade=1.0),),
    )


def outcome(parameters, state, events):
    """Return the row of a finished trial: how many shine or have arrived, and the way that wheels have run."""
    way = 0.5 * (np.abs(state.robots.left_path) + np.abs(state.robots.right_path))
    row = {}
    for kind, role in ((Kind.SCOUT, Role.SHINING), (Kind.CARRIER, Role.ARRIVED)):
        own = np.asarray(state.castes) == kind
        name = kind.name.lower()
        row[f"{name}s_{role.name.lower()}"] = int((state.memories.role[own] == role).sum())
        row[f"{name}s"] = int(own.sum())
        row[f"{name}_way_m"] = round(float(way[own].max(initial=0.0)), 2)
    return row


SYSTEM = assemble(
    Swarm(
        name="two-castes",
        summary="Scouts that find white floor and carriers that go where they shine",
        parameters=Parameters,
        arena=arena,
        memory=MEMORY,
        loop=run,
        outcome=outcome,
        kinds=EventKind,
        roles=Role,
        castes=castes,
        decide=decide,
        note=note_roles,
    )
)

if __name__ == "__main__":
    for seed in (1, 2):
        row = SYSTEM.run(SYSTEM.configure(), seed).outcome
        print(f"seed {seed}: " + ", ".join(f"{name} {value}" for name, value in row.items()))

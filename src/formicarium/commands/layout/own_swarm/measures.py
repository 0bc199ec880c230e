"""What an observer writes down, and the row of results. No robot sees any of it."""

from enum import IntEnum

import numpy as np
from formicarium.compiled import compiled
from formicarium.trial.events import write_event
from formicarium.trial.swarm.phases import note_roles

from own_swarm.behaviour import Role


class EventKind(IntEnum):
    """What the log tells."""

    ROLE = 0  # a robot's role has changed; value: new, detail: old (note_roles)
    DIED = 1  # (note_roles)
    GATHERED = 2  # three quarters of the living robots rest; value: how many


@compiled
def note(state):
    """Log changes of role, and the first moment at which most robots rest."""
    note_roles(state)
    clock = state.clock[0]
    alive = 0
    resting = 0
    for i in range(len(state.robots)):
        if state.robots[i].alive == 1:
            alive += 1
            if state.memories[i].role == Role.RESTING:
                resting += 1
    if 4 * resting >= 3 * alive:
        write_event(clock, state.events, EventKind.GATHERED, 0, 0, resting, 0)
        clock.finished = 1


def outcome(parameters, state, events):
    """Return the row of a finished trial: numbers and texts by name; times in seconds, None if not reached."""
    gathered = events[events["kind"] == EventKind.GATHERED]["cycle"]
    return {
        "time_gathered_s": (float(gathered[0]) + 1.0) * parameters.swarm.cycle_time if len(gathered) else None,
        "resting": int(((state.memories.role == Role.RESTING) & (state.robots.alive == 1)).sum()),
        "spread_m": float(np.hypot(state.world.bodies.x.std(), state.world.bodies.y.std())),
        "cause": None if len(gathered) else "did not gather",
    }

"""A swarm of the coverage system that tests put where they want it and step cycle by cycle."""

import numpy as np

from formicarium.contracts.states import copy_of
from formicarium.systems.coverage.loop import run
from formicarium.systems.coverage.parameters import coverage_parameters
from formicarium.systems.coverage.setup import begin
from formicarium.trial.situated import look


def swarm(places=None, setting=2, robots=None, seed=1, **groups):
    """Return a state; ``places`` (N, 3) x, y, heading, the master's first; bodies are stored in that order."""
    if places is not None:
        places, robots = np.array(places, float), len(places)
    return begin(coverage_parameters(setting, robots, **groups), seed, places=places)


def advance(state, cycles):
    for _ in range(cycles):
        run(state, 1)
        state.clock[0].event_count = 0
    return state


def stay(state, cycles):
    """Advance, but put every body back where it was: only words travel."""
    for _ in range(cycles):
        kept = state.world.bodies.copy()
        advance(state, 1)
        state.world.bodies[:] = kept
        look(state)
    return state


def line(count, apart=2.0, heading=0.0):
    """Return places of a straight chain along x; each hears its two neighbours alone (range 3 m)."""
    return [(apart * k, 0.0, heading) for k in range(count)]


def move(state, robot, x, y, turn=0.0):
    """Return a copy in which a body stands elsewhere."""
    state = copy_of(state)
    body = state.world.bodies[robot]
    body.x, body.y, body.heading = x, y, body.heading + turn
    look(state)
    return state

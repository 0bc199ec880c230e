"""Robots that fail in the midst of a trial (ST-71): who, when, and what is left of them. No robot sees any of this."""

import numpy as np

from formicarium.compiled import compiled
from formicarium.observers.graphs import Graph, count_cut_robots
from formicarium.physics.records import records
from formicarium.streams import generator
from formicarium.systems.coverage.parameters import CoverageParameters

RANDOM, ARTICULATION, MASTER = range(3)
AIMS = ("random", "articulation", "master")
NOWHERE = -1000.0  # m, where removed bodies stand, far from everything
APART = 10.0  # m, between them

# One failure.
FAILURE = np.dtype(
    [
        ("cycle", "i8"),  # from which it strikes
        ("aim", "i8"),
        ("removed", "i8"),  # 1 if the body is taken away
        ("draw", "f8"),  # [0, 1), which of those that it may strike
        ("victim", "i8"),  # key of the robot that it has struck, -1 for none yet
    ],
    align=True,
)


def make_failures(p: CoverageParameters, seed: int) -> np.recarray:
    """Return the failures of a trial, at random times by a stream of their own."""
    f = p.failures
    failures = records(FAILURE, f.count)
    draws = generator(seed, "mission failures")
    for failure in failures:
        failure.cycle = round(draws.uniform(f.earliest, f.latest) / p.swarm.cycle_time)
        failure.draw = draws.uniform()
        failure.aim = AIMS.index(f.aim)
        failure.removed = f.remains == "removed"
        failure.victim = -1
    return failures


@compiled
def fail(state):
    """Strike whom a failure is due for, and take away the bodies of those that are to leave none."""
    cycle = state.clock[0].cycle
    for k in range(len(state.failures)):
        failure = state.failures[k]
        if failure.victim < 0 and cycle >= failure.cycle:
            strike(state, failure)
        elif failure.victim >= 0 and failure.removed == 1:
            take_away(state, failure.victim)


@compiled
def strike(state, failure):
    """Let one of those that a failure may strike die in this cycle; who it is goes by keys, not by places in memory."""
    master = state.survey[0].master
    if failure.aim == ARTICULATION:
        neighbours, counts = state.world.neighbours, state.world.neighbour_count
        count_cut_robots(neighbours, counts, state.links, state.places, Graph.RANGE, master)
    count = 0
    for i in range(len(state.robots)):
        count += may_strike(state, failure.aim, i, master)
    left = int(failure.draw * count)
    for place in range(len(state.robots)):
        i = state.world.lists[place].order
        if may_strike(state, failure.aim, i, master):
            if left == 0:
                state.robots[i].dies_at = state.clock[0].cycle
                failure.victim = state.robots[i].key
                return
            left -= 1


@compiled
def may_strike(state, aim, i, master):
    """Tell whether a failure may strike body ``i`` now; one that is dead, or dies in this cycle, cannot fail again."""
    if state.robots[i].alive == 0 or state.robots[i].dies_at == state.clock[0].cycle:
        return False
    if aim == MASTER:
        return i == master
    return i != master and (aim == RANDOM or state.places[i].mark == 1)


@compiled
def take_away(state, key):
    """Put the body of a dead robot where nobody meets it."""
    for i in range(len(state.robots)):
        if state.robots[i].key == key and state.robots[i].alive == 0:
            body = state.world.bodies[i]
            body.x = NOWHERE - APART * key
            body.y = NOWHERE

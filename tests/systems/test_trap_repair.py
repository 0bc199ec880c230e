"""An established branch is not repaired, a growing one is (T27, TS-70)."""

import math

import numpy as np
import pytest

from formicarium.robots.records import Colour
from formicarium.systems.sequencing.loop import run
from formicarium.systems.sequencing.memory import Role
from formicarium.systems.sequencing.parameters import BehaviourTable
from systems.stage import chain, guardian, put, wide_stage

SPACING = BehaviourTable().spacing
LINKS, PUSHED = 6, 3
PUSH = 0.12  # m aside, a centimetre a cycle


def branch(seed: int, established: int):
    """Return links in place between their two guardians; the far one has not been reached and says nothing."""
    state = wide_stage(LINKS + 2, seed)
    chain(state, LINKS, SPACING, established)
    put(state, LINKS + 1, (LINKS + 1) * SPACING, 0.0, math.pi)
    guardian(state, LINKS + 1, Colour.GREEN, False)
    run(state, 20)
    return state


def push(state, k: int) -> None:
    """Push a link aside, so slowly that its neighbours can see it go."""
    for _ in range(round(PUSH / 0.01)):
        body = state.world.bodies[k]
        put(state, k, float(body.x), float(body.y) + 0.01, float(body.heading))
        run(state, 1)


def places(state) -> np.ndarray:
    """Return where the members are, (LINKS + 2, 2) m."""
    return np.column_stack([state.world.bodies.x, state.world.bodies.y])


def bend(state, k: int) -> float:
    """Return by how much the branch turns at a link, degrees."""
    before, after = np.diff(places(state)[k - 1 : k + 2], axis=0)
    return abs(math.degrees(math.remainder(math.atan2(*after[::-1]) - math.atan2(*before[::-1]), math.tau)))


@pytest.mark.parametrize("seed", range(1, 4))
def test_an_established_link_stays_where_it_was_pushed_and_its_neighbours_do_not_follow(seed):
    """T27."""
    state = branch(seed, established=1)
    before = places(state)
    push(state, PUSHED)
    pushed = places(state)
    run(state, 1200)
    assert places(state) == pytest.approx(pushed, abs=1e-9)
    assert pushed[PUSHED, 1] == pytest.approx(PUSH, abs=0.002)
    assert np.delete(pushed, PUSHED, axis=0) == pytest.approx(np.delete(before, PUSHED, axis=0), abs=1e-9)
    assert bend(state, PUSHED) > 45.0
    assert (state.memories.role[1 : LINKS + 1] == Role.LINK).all()
    assert (state.commands.colour[1 : LINKS + 1] == Colour.YELLOW).all()  # its role and colour stay too


@pytest.mark.parametrize("seed", range(1, 4))
def test_a_link_that_is_not_yet_established_moves_back_and_its_neighbours_help(seed):
    """T27, TS-66: until the branch is mended but for the tolerance."""
    state = branch(seed, established=0)
    push(state, PUSHED)
    assert bend(state, PUSHED) > 30.0
    run(state, 1200)
    tolerance = math.degrees(float(state.behaviour[0].alignment_tolerance))
    assert max(bend(state, k) for k in range(1, LINKS + 1)) < 2.0 * tolerance
    gaps = np.hypot(*np.diff(places(state), axis=0).T)
    assert np.abs(gaps - SPACING).max() < float(state.behaviour[0].spacing_tolerance) + 0.03
    assert places(state)[PUSHED, 1] < 0.6 * PUSH


@pytest.mark.parametrize("seed", range(1, 4))
def test_a_link_that_is_told_while_it_is_out_of_place_stops_there(seed):
    """T27, TS-70: "stops where it is", not where it should be."""
    state = branch(seed, established=0)
    push(state, PUSHED)
    other = state.memories[LINKS + 1]
    other.in_chain, other.established, other.branch = 1, 1, 2
    while not state.memories.established[1 : LINKS + 1].all() and state.clock[0].cycle < 200:
        run(state, 1)
    assert state.memories.established[1 : LINKS + 1].all()
    run(state, 2)  # the wheels stop
    then = places(state)
    run(state, 1200)
    assert places(state) == pytest.approx(then, abs=1e-9)
    assert bend(state, PUSHED) > 2.0 * math.degrees(float(state.behaviour[0].alignment_tolerance))

"""Robots that fail in a trial (ST-71): who, when, what is left of them, and that it is a stream of its own."""

import numpy as np
import pytest
from pydantic import ValidationError
from scipy.sparse.csgraph import connected_components

from formicarium.systems.coverage.parameters import coverage_parameters
from formicarium.systems.coverage.setup import begin
from formicarium.trial.situated import look
from systems.coverage.swarm import advance, line, stay, swarm
from systems.coverage.test_mission import FLOWN, mission

WINDOW = {"earliest": 2.0, "latest": 20.0}


def failing(seed=1, **failures):
    return mission(seed=seed, behaviour=FLOWN, failures={**WINDOW, **failures})


def parted_without(state, victim):
    """Tell whether the living but one are in several pieces by range."""
    others = [i for i in range(len(state.robots)) if i != victim and state.robots[i].alive == 1]
    x, y = state.world.bodies.x[others], state.world.bodies.y[others]
    return connected_components(np.hypot(x[:, None] - x, y[:, None] - y) <= state.footbot[0].radio_range)[0] > 1


def test_as_many_fail_as_asked_within_the_window_and_never_the_master():
    victims = []
    for seed in range(1, 9):
        state = failing(seed, count=3)
        assert (state.failures.cycle >= 20).all() and (state.failures.cycle <= 200).all()
        for cycle in range(205):
            due = int((state.failures.cycle < cycle).sum())
            assert int((state.robots.alive == 0).sum()) == due
            advance(state, 1)
        victims += state.failures.victim.tolist()
    assert 0 not in victims and len(set(victims)) > 4


def test_the_dead_say_nothing_and_stand_still():
    state = failing(count=2)
    advance(state, 205)
    dead = np.flatnonzero(state.robots.alive == 0)
    places = state.world.bodies[["x", "y"]][dead].copy()
    advance(state, 100)
    assert len(dead) == 2 and (state.commands.message.bytes[dead] == 0).all()
    assert (state.world.bodies[["x", "y"]][dead] == places).all()


def test_an_aimed_failure_parts_the_swarm():
    """Trap 24: of a chain any robot but the last; a swarm that no single loss parts is spared until one would."""
    for seed in range(1, 6):
        state = swarm(line(6), setting=0, failures={**WINDOW, "count": 1, "aim": "articulation"}, seed=seed)
        stay(state, int(state.failures[0].cycle) + 1)
        victim = int(np.flatnonzero(state.robots.alive == 0)[0])
        assert 0 < victim < 5 and parted_without(state, victim)
    crowd = [(0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (1.0, 1.0, 0.0)]
    state = swarm(crowd, setting=0, failures={**WINDOW, "count": 1, "aim": "articulation"})
    assert (stay(state, 300).robots.alive == 1).all()


def test_the_master_fails_when_it_is_aimed_at():
    state = failing(count=1, aim="master")
    advance(state, 205)
    assert state.robots.alive.tolist() == [0, *[1] * 7]


def test_a_removed_body_is_in_nobodys_way_or_sight():
    """Of three in a line the middle one hides the ends from each other until it is taken away."""
    places = line(3, apart=1.0)
    kept, gone = (
        swarm(places, setting=0, failures={**WINDOW, "count": 1, "aim": "articulation", "remains": remains})
        for remains in ("obstacle", "removed")
    )
    for state in (kept, gone):
        state.failures.aim, state.failures.draw = 0, 0.0  # key 1, the middle one
        stay(state, int(state.failures[0].cycle) + 1)
        for _ in range(3):
            ends = state.world.bodies[[0, 2]].copy()
            advance(state, 1)
            state.world.bodies[[0, 2]] = ends
            look(state)
        assert state.robots.alive.tolist() == [1, 0, 1]
    assert kept.sight[0, 2] == 0 and gone.sight[0, 2] == 1
    assert not gone.sight[1].any() and gone.world.bodies[1].x < -900.0


def test_failures_change_no_other_draw():
    """Named stream: until the first failure everything is as without failures."""
    one, other = mission(behaviour=FLOWN), failing(count=2)
    first = int(other.failures.cycle.min())
    for state in (one, other):
        advance(state, first - 1)
    for name in ("x", "y", "heading"):
        assert np.array_equal(one.world.bodies[name], other.world.bodies[name])
    assert np.array_equal(one.robots.dies_at, other.robots.dies_at)


def test_where_a_robot_is_kept_does_not_decide_who_fails():
    p = coverage_parameters(0, 8, failures={**WINDOW, "count": 2})
    plain, permuted = begin(p, 3), begin(p, 3, storage=np.array([3, 5, 0, 7, 2, 1, 6, 4]))
    for state in (plain, permuted):
        advance(state, 205)
    assert plain.failures.victim.tolist() == permuted.failures.victim.tolist() != [-1, -1]
    for state in (plain, permuted):
        assert sorted(state.robots.key[state.robots.alive == 0].tolist()) == sorted(state.failures.victim.tolist())


@pytest.mark.parametrize(
    ("failures", "said"),
    [
        ({"count": 8}, "failures.count = 8 of swarm.robots = 8: at least one must be left"),
        ({"earliest": 50.0, "latest": 40.0}, "failures.latest = 40 s is before failures.earliest = 50 s"),
        ({"aim": "tip"}, "failures.aim"),
    ],
)
def test_failures_that_cannot_be_are_refused_by_name(failures, said):
    with pytest.raises(ValidationError, match=said):
        coverage_parameters(0, 8, failures=failures)

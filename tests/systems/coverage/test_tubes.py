"""Networks of arms and tubes (ST-74): ways to tips, flux counters, the conductance rule, the finished network."""

import math

import numpy as np
import pytest

from formicarium.contracts.states import copy_of
from formicarium.systems.coverage.networks import network_columns, spanning_length, survived
from formicarium.systems.coverage.parameters import coverage_parameters
from formicarium.systems.coverage.tubes import flux_of
from systems.coverage.swarm import advance, stay, swarm

DELTA = 2.4
ARMS = (0.0, 2.0 * math.pi / 3.0, 4.0 * math.pi / 3.0)  # directions of three arms, with first_direction 0


def point(arm, distance):
    return distance * math.cos(ARMS[arm]), distance * math.sin(ARMS[arm])


def between(one, other, share):
    """Return a place on the way from the tip of an arm to that of another."""
    (ax, ay), (bx, by) = point(one, 2 * DELTA), point(other, 2 * DELTA)
    return ax + share * (bx - ax), ay + share * (by - ay)


def star(tubes=(), headings=True, **formation):
    """Return three arms of two robots, and on the way from tip 1 to tip 2 robots at the given shares of it.

    Robots hear no farther than 2.5 m, so that a tube and the stems beside it do not.
    """
    draws = np.random.default_rng(2)
    places = [(0.0, 0.0)] + [point(arm, k * DELTA) for arm in range(3) for k in (1, 2)]
    places += [between(0, 1, share) for share in tubes]
    turned = [(x, y, draws.uniform(-3.0, 3.0) if k and headings else 0.0) for k, (x, y) in enumerate(places)]
    state = swarm(
        turned,
        setting=9,
        tasks={"count": 3, "first_direction": 0.0, "distance": 30.0},
        footbot={"radio_range": 2.5},
        behaviour={"arm_choice": "draw"},
        formation={"shape": "network", **formation},
    )
    stay(state, 8)
    m = state.memories
    m.arm[1:7] = (1, 1, 2, 2, 3, 3)
    m.arm[7:], m.branch[7:] = 1, 1
    m.drawn[:] = m.correction[:]
    return state


def test_the_ways_to_the_tips_are_the_shortest_ones():
    """From tip 1 to tip 2 through the master: 4 delta."""
    state = stay(star(), 20)
    ways = state.memories[2].arms["way"][:3]
    assert ways == pytest.approx([0.0, 4 * DELTA, 4 * DELTA])
    assert state.memories[0].arms["way"][:3] == pytest.approx([2 * DELTA] * 3)


def test_flux_counters_count_the_tips_that_send_through_a_robot():
    """A star: all six pairs through the master; through an arm's first robot four, two each way."""
    state = stay(star(), 30)
    flux = [flux_of(memory.arms, memory.arm_count) for memory in state.memories]
    assert flux[0] == 6.0
    assert [flux[k] for k in (1, 3, 5)] == [4.0, 4.0, 4.0]


def test_a_closed_tube_takes_the_traffic_of_its_two_arms_and_an_open_one_none():
    shares = (0.25, 0.5, 0.75)
    state = stay(star(shares), 40)
    closed = [flux_of(memory.arms, memory.arm_count) for memory in state.memories]
    assert closed[7:] == [2.0, 2.0, 2.0] and closed[0] == 4.0
    state = stay(star(shares[:1]), 40)
    opened = [flux_of(memory.arms, memory.arm_count) for memory in state.memories]
    assert opened[7:] == [0.0] and opened[0] == 6.0


def test_a_tube_may_end_at_the_middle_of_the_next_arm():
    """Its second robot hears the first of arm 2: 2.08 + 2.08 + 2.4 + 2.4 m are less than four delta."""
    state = stay(star((0.25, 0.5)), 40)
    assert [flux_of(memory.arms, memory.arm_count) for memory in state.memories[7:]] == [2.0, 2.0]


def test_a_lost_tip_is_forgotten_and_does_not_count_to_infinity():
    state = stay(star(), 30)
    state.robots.alive[2] = 0
    state.commands.enabled[2] = 0
    stay(state, 150)
    assert (state.memories.arms["open"][[0, 1, 3, 4, 5, 6], 0] == 0).all()


def test_conductance_follows_its_rule():
    """dC/dt = Q^2 / (1 + Q^2) - C from C(0): C = f + (C(0) - f) exp(-t / tube_time), f(2) = 0.8."""
    state = stay(star((0.25, 0.5, 0.75), tube_time=30.0), 60)
    before = state.memories.conductance[7:].copy()
    stay(state, 600)
    expected = 0.8 + (before - 0.8) * math.exp(-60.0 / 30.0)
    assert state.memories.conductance[7:] == pytest.approx(expected, abs=0.005)
    assert (state.memories.withered == 0).all()


def test_a_tube_that_leads_nowhere_withers_and_its_robots_try_the_other_side():
    state = stay(star((0.25,), tube_time=20.0), 700)
    assert (state.memories.withered[7:] >= 1).all()
    kept = stay(star((0.25, 0.5, 0.75), tube_time=20.0), 700)
    assert (kept.memories.withered == 0).all() and (kept.memories.branch[7:] == 1).all()


@pytest.fixture(scope="module")
def grown():
    """Return a network of 16 robots after 300 s, and its parameters."""
    return coverage_parameters(9), advance(swarm(setting=9, seed=900301), 3000)


def test_sixteen_robots_join_three_arms_and_survive_any_single_failure(grown):
    p, state = grown
    row = network_columns(p, state)
    assert row["arms_joined"] >= 2
    assert row["survived_range"] == 1.0
    assert state.connections[0].losses == 0


def test_length_and_failures_agree_with_slow_ways(grown):
    """The spanning tree by Prim's way; each robot taken out by hand."""
    _, state = grown
    bodies = state.world.bodies
    points = np.column_stack([bodies.x, bodies.y])
    inside, total = {0}, 0.0
    while len(inside) < len(points):
        length, best = min(
            (math.dist(points[a], points[b]), b) for a in inside for b in range(len(points)) if b not in inside
        )
        inside.add(best)
        total += length
    assert spanning_length(points) == pytest.approx(total)
    near = np.array([[0.0 < math.dist(a, b) <= 3.0 for b in points] for a in points])
    alive = [whole_without(near, k) for k in range(len(points))]
    assert survived(near, 0) == (pytest.approx(np.mean(alive[1:])), int(alive[0]))


def whole_without(near, lost):
    """Tell by flooding whether the others are connected when one is lost."""
    rest = [k for k in range(len(near)) if k != lost]
    seen, todo = {rest[0]}, [rest[0]]
    while todo:
        here = todo.pop()
        for k in rest:
            if near[here, k] and k not in seen:
                seen.add(k)
                todo.append(k)
    return len(seen) == len(rest)


def test_a_chain_survives_the_loss_of_its_ends_alone():
    chain = np.eye(5, k=1, dtype=bool) | np.eye(5, k=-1, dtype=bool)
    assert survived(chain, 0) == (0.25, 1)
    assert survived(chain, 2) == (0.5, 0)
    ring = chain.copy()
    ring[0, 4] = ring[4, 0] = True
    assert survived(ring, 2) == (1.0, 1)
    chain[0, 1] = chain[1, 0] = False
    assert survived(chain, 2) == (0.0, 0)


def test_a_network_without_one_of_its_robots_is_measured_without_it(grown):
    p, state = grown
    less = copy_of(state)
    less.robots.alive[int(np.flatnonzero(less.memories.branch > 0)[0])] = 0
    was, now = network_columns(p, state), network_columns(p, less)
    assert now["robots_used"] + now["robots_spare"] == was["robots_used"] + was["robots_spare"] - 1


def test_two_arms_are_no_network():
    with pytest.raises(ValueError, match=r"tasks\.count = 2.*Make tasks\.count 3 or more"):
        coverage_parameters(9, tasks={"count": 2})

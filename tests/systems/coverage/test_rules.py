"""Potentials, frames, wheels, gradient, arms: single rules against closed formulas and hand-worked cases."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from formicarium.control.bearings import carried_over, carried_over_printed
from formicarium.control.potentials import lennard_jones, lennard_jones_printed, smooth_depth
from formicarium.control.turning import Turning, drive_towards, turn_state
from formicarium.physics.records import records
from formicarium.robots.footbot import COMMAND
from formicarium.systems.coverage.master import correct_arms
from formicarium.systems.coverage.memory import Mode, Stage
from systems.coverage.swarm import advance, line, move, stay, swarm

POSES = st.tuples(*[st.floats(-50.0, 50.0)] * 2, st.floats(-20.0, 20.0))


def wrapped(angle):
    return (angle + math.pi) % (2.0 * math.pi) - math.pi


def sight(one, other):
    """Return the bearing of one pose's place in another's frame."""
    return wrapped(math.atan2(other[1] - one[1], other[0] - one[0]) - one[2])


@given(POSES, POSES, st.floats(-3.1, 3.1))
@settings(max_examples=500)
def test_a_direction_carried_over_is_the_same_direction_in_the_world(me, you, direction):
    """ST-36, on any pair of poses: h_i + T_i = h_j + T_j."""
    if math.hypot(me[0] - you[0], me[1] - you[1]) < 1e-3:
        return
    told = wrapped(direction - you[2])
    mine = carried_over(told, sight(you, me), sight(me, you))
    assert abs(wrapped(mine + me[2] - direction)) < 1e-9


def test_the_printed_rule_is_a_right_angle_off_on_average():
    draws = np.random.default_rng(1)
    errors = []
    for _ in range(4000):
        me, you = ((*draws.uniform(-5, 5, 2), draws.uniform(-math.pi, math.pi)) for _ in range(2))
        direction = draws.uniform(-math.pi, math.pi)
        mine = carried_over_printed(wrapped(direction - you[2]), sight(you, me), sight(me, you))
        errors.append(abs(wrapped(mine + me[2] - direction)))
    assert math.degrees(np.mean(errors)) == pytest.approx(90.0, abs=3.0) and math.degrees(max(errors)) > 179.0


@pytest.mark.parametrize(
    ("distance", "force"), [(1.00, 1096704.0), (2.40, 0.0), (3.00, -3072.0), (2.4 * math.sqrt(5 / 3), -3098.4)]
)
def test_the_potential_against_the_oracles_of_the_statement(distance, force):
    """ST-27: eps 10^6 cm2/s, tau 240 cm; forces in cm/s."""
    assert 100.0 * lennard_jones(distance, 2.4, 100.0) == pytest.approx(force, rel=1e-4, abs=1e-6)


def test_the_force_is_minus_the_slope_of_the_potential():
    def potential(x):
        return 7.0 * ((1.3 / x) ** 4 - 2.0 * (1.3 / x) ** 2)

    for x in (0.5, 1.0, 1.3, 2.0, 4.0):
        slope = (potential(x + 1e-6) - potential(x - 1e-6)) / 2e-6
        assert lennard_jones(x, 1.3, 7.0) == pytest.approx(-slope, rel=1e-5, abs=1e-6)
    assert potential(1.3 / math.sqrt(2.0)) == pytest.approx(0.0, abs=1e-12)


def test_the_printed_equation_only_pushes():
    assert all(lennard_jones_printed(x, 2.4, 100.0) > 0.0 for x in (0.3, 1.0, 2.4, 3.0))


def test_the_smooth_force_is_linear_near_its_distance():
    for off in (-0.01, 0.01):
        assert lennard_jones(2.4 + off, 2.4, smooth_depth(0.5, 2.4)) == pytest.approx(-0.5 * off, rel=0.05)


def test_turning_has_three_states_with_their_own_thresholds():
    """ST-24: HARD above 90 degrees until 70, SOFT until 10."""
    state, met = Turning.STRAIGHT, []
    for error in (0, 9, 11, 89, 91, 80, 71, 70, 40, 11, 10, 0):
        state = turn_state(state, math.radians(error))
        met.append(int(state))
    assert met == [0, 0, 1, 1, 2, 2, 2, 1, 1, 1, 0, 0]


@given(st.floats(-0.5, 0.5), st.floats(-0.5, 0.5), st.sampled_from(list(Turning)))
def test_the_body_is_never_faster_than_the_limit(ahead, aside, state):
    command = records(COMMAND, 1)[0]
    command.ahead, command.aside = ahead, aside
    drive_towards(command, state, 0.15)
    assert abs(command.left + command.right) / 2.0 <= min(0.15, math.hypot(ahead, aside)) + 1e-12
    if math.radians(11) < math.atan2(aside, ahead) < math.radians(169) and math.hypot(ahead, aside) > 1e-9:
        assert command.right > command.left


def test_the_gradient_is_the_length_of_the_shortest_way():
    """Against Floyd and Warshall on the places."""
    draws = np.random.default_rng(2)
    places = [(0.0, 0.0, 0.0), *((*draws.uniform(-4, 4, 2), draws.uniform(-3, 3)) for _ in range(24))]
    state = stay(swarm(places, footbot={"occlusion": False, "radius": 0.02}), 40)
    way = np.hypot(*(np.array(places)[:, None, :2] - np.array(places)[:, :2]).transpose(2, 0, 1))
    way[way > 3.0] = np.inf
    for k in range(25):
        way = np.minimum(way, way[:, k : k + 1] + way[k : k + 1])
    near = np.isfinite(way[0])
    assert np.allclose(state.memories.gradient[near], way[0][near], atol=1e-9)
    assert (state.memories.linked == near).all()


@pytest.mark.parametrize("variant", ["faithful", "safe"])
def test_a_detached_group_finds_out_within_as_many_cycles_as_there_are_robots(variant):
    """ST-34: no counting to infinity."""
    state = stay(swarm([*line(4, 1.5), *((6.0 + 1.2 * k, 0.5 * (k % 3), 0.0) for k in range(6))]), 40)
    assert (state.memories.linked == 1).all()
    for robot in range(4, 10):
        state = move(state, robot, state.world.bodies[robot].x + 50.0, state.world.bodies[robot].y)
    stay(state, 10 + 10)
    assert (state.memories.linked[:4] == 1).all() and (state.memories.linked[4:] == 0).all()


def test_the_authors_gradient_never_notices():
    """As in their files: it only falls."""
    state = stay(
        swarm([*line(4, 1.5), *((6.0 + 1.2 * k, 0.0, 0.0) for k in range(3))], behaviour={"variant": "buzz"}), 40
    )
    for robot in range(4, 7):
        state = move(state, robot, state.world.bodies[robot].x + 50.0, 0.0)
    assert (stay(state, 60).memories.linked == 1).all()


def test_the_master_counts_everybody_through_the_tree():
    state = stay(swarm(line(9)), 25)
    assert state.memories.counted.tolist() == [9, 8, 7, 6, 5, 4, 3, 2, 1]
    assert state.memories[0].farthest == pytest.approx(16.0)


def test_arms_are_drawn_by_weight():
    """ST-32: P(k) = d_k / sum of d, over many robots and seeds."""
    counts = np.zeros(3)
    for seed in range(40):
        state = swarm(setting=5, robots=16, seed=seed, behaviour={"arm_choice": "draw"})
        state.memories.slots["wanted"][:, 0, :3] = (1.0, 2.0, 3.0)
        advance(state, 8)
        counts += np.bincount(state.memories.arm[1:], minlength=4)[1:4]
    assert counts / counts.sum() == pytest.approx([1 / 6, 1 / 3, 1 / 2], abs=0.06)


def test_quotas_are_met_by_correction():
    """Independent draws give 5, 5, 5 in one of twenty swarms; the master's corrections nearly always."""
    met = 0
    for seed in range(10):
        state = advance(swarm(setting=5, seed=seed), 500)
        met += sorted(np.bincount(state.memories.arm[1:], minlength=4)[1:4].tolist()) == [5, 5, 5]
    assert met >= 9


def test_an_anchor_at_the_limit_of_its_link_is_changed_for_a_nearer_one():
    """One robot is tied to another behind the master, 2.62 m away; the master itself is at 2.3 m."""
    state = swarm([(0.0, 0.0, 0.0), (-0.3, 0.3, 0.0), (2.3, 0.0, 0.0)], behaviour={"variant": "safe"})
    stay(state, 10)
    identity = state.robots.identity.tolist()
    state.memories[2].anchor = identity[1]
    assert stay(state, 1).memories[2].anchor == identity[0]
    slack = move(state, 1, 1.0, 1.3)  # at 1.84 m; the master's 2.3 m are no reason to change
    slack.memories[2].anchor = identity[1]
    assert stay(slack, 1).memories[2].anchor == identity[1]


def test_counts_in_which_errors_make_up_for_each_other_correct_nothing():
    """Who changes its way to the master is counted twice or not at all for a cycle."""
    state = advance(swarm(setting=5), 300)
    master, chart, table = state.memories[0], state.charts[0], state.behaviour[0]
    memory = master.copy()
    memory.corrected, memory.agreed, memory.correction = 0, 0, 7
    for cycle, counts in enumerate([(5, 6, 4), (6, 5, 4), (5, 6, 4), (5, 5, 4), (5, 6, 4)]):
        memory.arms["count"][:3] = counts
        correct_arms(memory, table, chart, chart.slots[0], 300 + cycle)
    assert memory.correction == 7
    for cycle in range(3):
        memory.arms["count"][:3] = (5, 6, 4)
        correct_arms(memory, table, chart, chart.slots[0], 305 + cycle)
    assert memory.correction == 8 and memory.arms["leave"][:3].tolist() == [0.0, 1 / 6, 0.0]


def test_word_of_a_task_goes_through_robots_of_other_arms():
    """ST-43: the flag comes down the gradient, whoever is on the way; only the arm itself stops for it."""
    state = swarm(line(4), tasks={"count": 2, "distance": 6.0, "stop": True})
    stay(state, 10)
    state.memories.arm[1:] = (2, 2, 1)
    state.beacons.x[0], state.beacons.y[0], state.beacons.task[0] = 6.0, 0.0, 1
    stay(state, 10)
    assert state.memories[0].arms["reached"][:2].tolist() == [57, 0]
    assert state.memories.stage[3] == Stage.HOLDING and (state.memories.stage[1:3] != Stage.HOLDING).all()
    assert (stay(move(state, 3, 40.0, 0.0), 70).memories.arms["reached"][:3, :2] == 0).all()


def test_when_a_tip_has_left_the_others_go_on_though_the_master_holds():
    state = swarm(line(3), tasks={"distance": 4.0, "stop": True})
    state.beacons.x[0], state.beacons.y[0] = 4.0, 0.0
    stay(state, 10)
    assert state.memories.stage[2] == Stage.HOLDING
    state.memories.mode, state.memories.epoch = Mode.HOLD, 9
    state.beacons.x[0] = 40.0
    stay(state, 70)
    assert (state.memories.stage[1:] != Stage.HOLDING).all()


def test_phases_follow_each_other_and_everybody_hears_of_them():
    state = swarm(setting=0, robots=10, tasks={"distance": 4.0, "travel": 2.0, "hold_time": 3.0, "count": 2})
    modes = []
    while not state.clock[0].finished and state.clock[0].cycle < 9000:
        advance(state, 1)
        if not modes or modes[-1] != state.memories[0].mode:
            modes.append(int(state.memories[0].mode))
    assert modes == [Mode.FLOCK, Mode.ERUPT, Mode.HOLD, Mode.GATHER]
    assert state.clock[0].finished == 1 and (state.memories.epoch == 4).all()
    assert math.hypot(state.world.bodies[0].x - 2.0, state.world.bodies[0].y) < 0.5


def test_a_message_has_at_most_five_hundred_bytes_and_everybody_gets_a_turn():
    state = swarm(setting=2, robots=100)
    told = {int(k): set() for k in state.robots.identity}
    for _ in range(60):
        advance(state, 1)
        for identity, command in zip(state.robots.identity, state.commands, strict=True):
            message = command.message
            assert message.bytes <= 500
            told[int(identity)] |= set(message.entries["receiver"][: message.entry_count].tolist())
    assert state.survey[0].bytes_most > 250
    assert min(len(names) for names in told.values()) >= 5

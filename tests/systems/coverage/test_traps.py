"""How a lazy build cheats, and the detector of each cheat (traps 1 to 5, 10, 11, 15 to 17, 25)."""

import math
from importlib import import_module

import numpy as np
import pytest

from formicarium.contracts.states import copy_of, distances, turned
from formicarium.robots.footbot import PACKETS
from formicarium.systems.coverage.behaviour import decide
from formicarium.systems.coverage.eruption import BUZZ_SPIRALS
from formicarium.systems.coverage.loop import run
from formicarium.systems.coverage.memory import Mode, Stage
from systems.coverage.swarm import advance, line, move, stay, swarm

EXACT = 1e-9
EVERY_PHASE = [(0, 40, {}), (2, 300, {}), (2, 300, {"behaviour": {"variant": "safe"}}), (6, 300, {})]
EVERY_PHASE += [
    (8, 300, {"formation": {"shape": "fractal", "branch_robots": 1}}),
    (9, 300, {"formation": {"shape": "network", "branch_robots": 1}}),
]


def next_commands(state):
    state = copy_of(state)
    advance(state, 1)
    return state.commands


def wrapped(angle):
    return (angle + math.pi) % (2.0 * math.pi) - math.pi


@pytest.mark.parametrize(("setting", "cycles", "groups"), EVERY_PHASE)
def test_a_rigidly_moved_world_gives_the_same_commands_and_messages(setting, cycles, groups):
    """Trap 1: nobody reads a place or a heading of the world."""
    draws = np.random.default_rng(3)
    state = swarm(setting=setting, robots=9, **groups)
    for _ in range(6):
        advance(state, cycles)
        there = turned(state, draws.uniform(-3.0, 3.0), tuple(draws.uniform(-50.0, 50.0, 2)))
        gaps = distances(next_commands(state), next_commands(there))
        wrong = {path: gap for path, gap in gaps.items() if gap > EXACT and "direction" not in path}
        assert wrong == {}
        one, other = next_commands(state).message.arms, next_commands(there).message.arms
        assert np.abs(wrapped(one["direction"] - other["direction"])).max() < EXACT


def test_who_has_no_way_to_the_master_does_not_know_the_direction():
    """Trap 2: four robots out of reach, with headings of their own, never align and never hear of the phase."""
    places = [*line(3), *((40.0 + 1.5 * k, 5.0, 1.0 + k) for k in range(4))]
    state = advance(swarm(places), 300)
    assert (state.memories.mode[:3] == Mode.ERUPT).all()
    assert (state.memories.mode[3:] == Mode.WAIT).all()
    assert (state.memories.aligned[3:] == 0).all() and (state.memories.arm_count[3:] == 0).all()


def test_words_travel_one_hop_a_cycle():
    """Traps 3 and 17, the light cone: who is h hops away changes no earlier than h cycles after the master."""
    state = stay(swarm(line(8), behaviour={"flee_range": 0.0}), 30)
    other = copy_of(state)
    other.memories[0].slots[0].task_ahead[0], other.memories[0].slots[0].task_aside[0] = 3.0, 20.0
    other.memories[0].epoch += 1
    first, heard = np.full(8, -1), np.full(8, -1)
    for cycle in range(12):
        stay(state, 1)
        stay(other, 1)
        for h in range(8):
            changed = state.memories[h].arms[0].direction != other.memories[h].arms[0].direction
            first[h] = cycle if first[h] < 0 and changed else first[h]
            heard[h] = cycle if heard[h] < 0 and other.memories[h].epoch == 2 else heard[h]
    assert first.tolist() == list(range(8)) and heard.tolist() == list(range(8))


@pytest.mark.parametrize("variant", ["faithful", "buzz", "safe"])
def test_a_robot_out_of_everybodys_reach_may_be_anywhere(variant):
    """Trap 4: no command and no message of the others changes."""
    places = [*line(6, 1.7), (60.0, 60.0, 0.0)]
    state = advance(swarm(places, behaviour={"variant": variant}), 50)
    here, there = next_commands(state), next_commands(move(state, 6, -70.0, 20.0, 2.0))
    assert here[:6].tobytes() == there[:6].tobytes()


def test_without_messages_nobody_erupts():
    """Trap 4: all messages are lost."""
    state = advance(swarm(line(6), footbot={"radio_loss": 1.0}), 200)
    assert (state.memories.arm_count[1:] == 0).all() and (state.memories.stage[1:] == Stage.WAITING).all()
    assert np.hypot(state.world.bodies.speed_x, state.world.bodies.speed_y).max() == 0.0


def test_when_messages_stop_robots_have_no_reference():
    state = advance(swarm(line(6)), 100)
    state.footbot.radio_loss = 1.0
    advance(state, 20)
    assert (state.memories.linked[1:] == 0).all() and (state.memories.stage[1:] == Stage.LOST).all()


def test_a_controller_calls_no_linear_algebra_and_no_graph_search():
    """Trap 5: what it may call is what its modules import; none of it is an observer or NumPy's."""
    for name in (
        "behaviour",
        "listening",
        "eruption",
        "flocking",
        "forces",
        "keeping",
        "arms",
        "master",
        "messages",
        "branches",
        "branching",
        "tubes",
    ):
        module = import_module(f"formicarium.systems.coverage.{name}")
        assert "np" not in vars(module) and "scipy" not in vars(module)


def aligned_after(hops, **behaviour):
    """Return whether the last robot of a chain, with headings at random, takes the right direction over."""
    draws = np.random.default_rng(hops)
    places = [(2.0 * k, 0.0, draws.uniform(-3.0, 3.0) if k else 0.0) for k in range(hops + 1)]
    state = stay(swarm(places, behaviour=behaviour), hops + 5)
    told = state.memories[hops].arms[0].direction + state.world.bodies[hops].heading
    return abs(wrapped(told + 0.25 * math.pi)) < 0.1


def test_the_printed_rule_fails_at_the_first_hop_and_the_corrected_one_at_none():
    """Trap 10: a robot's own direction is wrong with the printed rule; those behind it inherit that."""
    assert all(aligned_after(hops) for hops in (1, 2, 3, 6))
    assert not any(aligned_after(hops, transform="printed") for hops in (2, 3, 6))


def test_two_hops_away_robots_align_with_the_corrected_rule_alone():
    """Trap 10: first-hop robots use the master's own words and align with either rule."""
    fronts = {}
    for rule in ("corrected", "printed"):
        state = advance(swarm(setting=2, robots=11, seed=3, behaviour={"transform": rule}), 1500)
        fronts[rule] = float(state.axes.front[0])
    assert fronts["corrected"] > 2.0 * fronts["printed"]


@pytest.mark.parametrize(
    "groups",
    [
        {},
        pytest.param({"footbot": {"drive": "holonomic"}}, marks=pytest.mark.long),
        pytest.param({"footbot": {"radius": 0.05}}, marks=pytest.mark.long),
    ],
)
def test_speeds_bodies_and_links_keep_their_limits(groups):
    """Trap 11: v <= 0.15 m/s, no overlap, nobody hears through a body or beyond the range."""
    state = swarm(setting=2, robots=14, **groups)
    for _ in range(400):
        before = state.world.bodies.copy()
        heard = links_by_hand(state)
        cycle = int(state.clock[0].cycle)
        advance(state, 1)
        assert not ((state.heard == cycle) & ~heard).any()
        bodies = state.world.bodies
        assert np.hypot(bodies.x - before.x, bodies.y - before.y).max() <= 0.15 * 0.1 + 1e-12
        gap = np.hypot(bodies.x[:, None] - bodies.x, bodies.y[:, None] - bodies.y) + 10.0 * np.eye(14)
        assert gap.min() > 2.0 * bodies.radius[0] - 0.001


def links_by_hand(state):
    """Return who may hear whom, worked out from places alone: the distance of a third disc from the line."""
    bodies = state.world.bodies
    places = np.column_stack([bodies.x, bodies.y])
    count = len(places)
    may = np.zeros((count, count), bool)
    for i in range(count):
        for j in range(count):
            way = places[j] - places[i]
            length = np.hypot(*way)
            if i == j or length > 3.0:
                continue
            clear = True
            for k in range(count):
                if k not in (i, j):
                    along = np.dot(places[k] - places[i], way) / length**2
                    off = np.hypot(*(places[k] - places[i] - along * way))
                    clear &= not (0.0 < along < 1.0 and off < bodies.radius[k])
            may[i, j] = clear
    return may


def test_an_arm_stops_at_a_beacon_within_half_a_metre_and_at_no_other():
    """Trap 15: the beacon is moved away after the master was told of it; nobody stops where it was."""
    stopped = swarm(setting=2, robots=9, tasks={"stop": True, "distance": 6.0})
    moved = copy_of(stopped)
    moved.beacons.x += 3.0
    for state in (stopped, moved):
        advance(state, 1500)
    assert (stopped.memories.stage[1:] == Stage.HOLDING).sum() >= 4 and 5.0 < stopped.axes.front[0] < 7.5
    assert not (moved.memories.stage == Stage.HOLDING).any() and moved.axes.front[0] > 9.0


def test_a_beacon_of_another_arm_stops_nobody():
    state = swarm(setting=2, robots=9, tasks={"stop": True, "distance": 6.0})
    state.beacons.task = 2
    assert not (advance(state, 1500).memories.stage == Stage.HOLDING).any()


@pytest.mark.parametrize("variant", ["faithful", "safe"])
def test_numbers_name_robots_and_decide_nothing(variant):
    """Trap 16: with other identities everybody does the same."""
    one = swarm(setting=5, behaviour={"variant": variant, "arm_choice": "draw"})
    other = copy_of(one)
    other.robots.identity[:] = np.random.default_rng(1).permutation(other.robots.identity)
    for state in (one, other):
        advance(state, 600)
    for name in ("x", "y", "heading"):
        assert np.array_equal(one.world.bodies[name], other.world.bodies[name])


def test_the_authors_spirals_go_by_number():
    """And only in the variant that says so."""
    assert len(BUZZ_SPIRALS) == 20
    one = swarm(setting=2, behaviour={"variant": "buzz"})
    other = copy_of(one)
    other.robots.identity[:] = other.robots.identity[::-1].copy()
    for state in (one, other):
        advance(state, 100)
    assert not np.array_equal(one.world.bodies.x, other.world.bodies.x)


def test_broken_messages_break_nothing():
    """Trap 25: fields missing, out of order, doubled, a third of all lost; no direction comes from missing data."""
    draws = np.random.default_rng(5)
    state = swarm(setting=0, robots=10, footbot={"radio_loss": 0.3})
    for _ in range(300):
        advance(state, 1)
        for reading, memory, command, chart in zip(
            state.readings, state.memories, state.commands, state.charts, strict=True
        ):
            count = int(reading.packet_count)
            if count == 0:
                continue
            packets = np.asarray(reading.packets)
            doubled = min(PACKETS, 2 * count)
            packets[:doubled] = packets[draws.integers(0, count, doubled)]
            packets["named"][: doubled // 2] = 0
            packets["bearing_of_me"][packets["named"] == 0] = math.nan
            packets["arm_count"][draws.integers(0, doubled)] = 0
            reading.packet_count = doubled
            decide(reading, memory, command, state.behaviour[0], chart, state.footbot[0])
            for value in (command.ahead, command.aside, command.left, command.right, memory.arms[0].direction):
                assert math.isfinite(value)


def test_no_direction_is_taken_from_who_does_not_name_one():
    state = stay(swarm(line(3)), 10)
    reading, memory = state.readings[1], state.memories[1]
    known = float(memory.arms[0].direction)
    reading.packets["named"][:] = 0
    reading.packets["bearing_of_me"][:] = 1.0
    reading.turned = 0.0
    decide(reading, memory, state.commands[1], state.behaviour[0], state.charts[1], state.footbot[0])
    assert float(memory.arms[0].direction) == known and memory.reference_place == -1


def test_a_watch_of_the_loop_needs_no_python():
    """The loop is the compiled one: as many cycles at once give the same bytes as one by one."""
    one, other = swarm(setting=0), swarm(setting=0)
    run(one, 80)
    advance(other, 80)
    assert one.world.bodies.tobytes() == other.world.bodies.tobytes()

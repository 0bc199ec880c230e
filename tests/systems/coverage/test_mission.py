"""Missions of several slots in one piece: order, forgetting, no jumps, and the tasks that a message speaks of."""

import math

import numpy as np
import pytest
from pydantic import ValidationError
from scipy.sparse.csgraph import connected_components

from formicarium.contracts.interpreted import compiled, interpreted
from formicarium.contracts.states import copy_of, differences
from formicarium.systems.coverage.behaviour import decide
from formicarium.systems.coverage.listening import round_of
from formicarium.systems.coverage.memory import Mode
from formicarium.systems.coverage.parameters import coverage_parameters
from formicarium.trial.touching import touch_robot
from formicarium.trial.watching import Intervention
from systems.coverage.swarm import advance, line, stay, swarm

SLOTS = (
    {
        "x": 1.5,
        "y": 0.5,
        "tasks": (
            {"name": "well", "x": 4.0, "y": 2.0, "duration": 6.0, "robots": 3},
            {"name": "gate", "x": -1.0, "y": 2.5, "duration": 3.0, "robots": 3},
        ),
    },
    {"x": 0.0, "y": -1.0, "tasks": ({"name": "roof", "x": -3.0, "y": -3.0, "duration": 4.0, "robots": 4},)},
)

FAR = {"x": 0.0, "y": 0.0, "tasks": ({"name": "mast", "x": 13.0, "y": 0.0, "duration": 5.0, "robots": 7},)}
LATEST = 4000  # cycle; a master that waits for the dead is on its way to the second slot then
PLANNED = {"programme": "mission", "erupt_limit": 100.0, "gather_limit": 20.0}
FLOWN = {  # what a map's missions have switched on
    "variant": "safe",
    "arm_choice": "quota",
    "rendezvous": "flocking",
    "sweep_cycles": 600,
    "strays": "return",
    "agreed_cycles": 0,
    "census_cycles": 300,
}


def mission(seed=1, robots=8, slots=SLOTS, **groups):
    groups = {
        "tasks": PLANNED,
        "mission": {"slots": slots},
        **groups,
    }
    return swarm(setting=0, robots=robots, seed=seed, **groups)


def test_slots_follow_each_other_and_end():
    state = mission()
    phases = []
    while not state.clock[0].finished and state.clock[0].cycle < 9000:
        advance(state, 1)
        now = (round_of(int(state.memories[0].epoch)), int(state.memories[0].mode))
        if not phases or phases[-1] != now:
            phases.append(now)
    one_slot = [Mode.FLOCK, Mode.ERUPT, Mode.HOLD, Mode.GATHER]
    assert phases == [(slot, mode) for slot in (0, 1) for mode in one_slot]
    assert state.clock[0].finished == 1 and (state.memories.epoch == 8).all()


@pytest.mark.parametrize("variant", ["faithful", "safe"])
def test_nobody_jumps_between_phases(variant):
    """Trap 18: no body moves farther in a cycle than its speed allows, whatever phase begins or ends in it."""
    state = mission(behaviour={"variant": variant, "arm_choice": "quota"})
    longest, epochs = 0.0, set()
    while not state.clock[0].finished and state.clock[0].cycle < 9000:
        before = state.world.bodies.copy()
        advance(state, 1)
        moved = np.hypot(state.world.bodies.x - before.x, state.world.bodies.y - before.y)
        longest = max(longest, float(moved.max()))
        epochs |= set(state.memories.epoch.tolist())
    assert epochs == set(range(9)) and 0.014 < longest <= 0.015 + 1e-9


def test_arms_are_forgotten_with_their_slot_even_by_who_missed_its_end():
    """A robot that was away from the eruption of slot one to that of slot two draws among the arms of slot two."""
    state = mission()
    while state.memories[0].mode != Mode.HOLD:
        advance(state, 1)
    assert (state.memories.arm[1:] > 0).all() and (state.memories[0].arms["task"][:2] == (1, 2)).all()
    late = state.memories[7:8].copy()
    while not (round_of(int(state.memories[0].epoch)) == 1 and state.memories[0].mode == Mode.ERUPT):
        advance(state, 1)
    state.memories[7] = late[0]
    stay(state, 5)
    assert state.memories[7].epoch == state.memories[0].epoch
    assert (state.memories.arm_count == 1).all() and (state.memories.arms["task"][:, 0] == 3).all()
    assert state.memories[7].arm == 1


def test_who_has_not_heard_of_the_new_slot_teaches_no_old_arms():
    """The last one to hear still speaks of two arms; whoever has forgotten them takes nothing of it."""
    state = mission()
    while state.memories[0].mode != Mode.GATHER:
        advance(state, 1)
    while state.memories[0].mode == Mode.GATHER:
        advance(state, 1)
    for _ in range(10):
        told = round_of(1) != np.array([round_of(int(epoch)) for epoch in state.memories.epoch])
        assert (state.memories.arm_count[told] == 0).all() and (state.memories.arm[told] == 0).all()
        advance(state, 1)
    assert told.all()


def test_a_beacon_of_another_slot_stops_nobody():
    """Traps 15: arms have numbers in their slot, tasks in the mission; the beacon of task 1 is not that of arm 1."""
    state = mission()
    state.beacons.task[2] = 1
    while not (round_of(int(state.memories[0].epoch)) == 1 and state.memories[0].mode == Mode.ERUPT):
        advance(state, 1)
    advance(state, 600)
    assert state.memories[0].mode == Mode.ERUPT and (state.memories.arms["reached"][:, 0] == 0).all()


def test_a_task_costs_no_bytes_beside_whether_its_direction_is_known():
    """What was 27 bytes an arm still is: 7 bits of number and one bit."""
    one = advance(mission(slots=SLOTS[1:]), 1000).commands.message
    assert (one["arms"]["task"][:, 0] == 1).all()
    assert (one["bytes"] == 54 + 27 * one["arm_count"] + 9 * one["entry_count"]).all()


def test_numbers_name_robots_and_decide_nothing_in_a_mission():
    """Trap 16: with other identities everybody does the same, from slot to slot."""
    one = mission(behaviour=FLOWN)
    other = copy_of(one)
    other.robots.identity[:] = np.random.default_rng(1).permutation(other.robots.identity)
    for state in (one, other):
        advance(state, 1500)
    assert round_of(int(one.memories[0].epoch)) == 1
    for name in ("x", "y", "heading"):
        assert np.array_equal(one.world.bodies[name], other.world.bodies[name])


def test_word_of_the_next_slot_travels_one_hop_a_cycle():
    """Trap 17: in a chain whoever is h hops away forgets the arms h cycles after the master has."""
    state = swarm(line(7), setting=0, tasks=PLANNED, mission={"slots": SLOTS})
    state.memories.epoch, state.memories.mode = 3, Mode.HOLD
    stay(state, 12)
    assert (state.memories.arm_count == 2).all()
    state.memories[0].epoch, state.memories[0].mode = 4, Mode.GATHER
    state.charts[0].gather_cycles = 0
    state.memories[0].since = state.clock[0].cycle
    forgot = np.full(7, -1)
    for cycle in range(12):
        stay(state, 1)
        new = (forgot < 0) & (state.memories.arm_count == 0)
        forgot[new] = cycle
    assert forgot.tolist() == [forgot[0] + h for h in range(7)]


@pytest.mark.parametrize(("attempts", "rounds"), [(1, [0, 1]), (2, [0, 0, 1, 1])])
def test_a_slot_that_was_not_held_is_tried_again(attempts, rounds):
    """The master knows of its tasks by word alone: the beacons are away, and no word comes."""
    state = mission(tasks={**PLANNED, "erupt_limit": 10.0, "attempts": attempts}, behaviour=FLOWN)
    state.beacons.x += 100.0
    slots, epoch = [], 0
    while not state.clock[0].finished and state.clock[0].cycle < 9000:
        advance(state, 1)
        if state.memories[0].epoch != epoch:
            epoch = int(state.memories[0].epoch)
            slots += [int(state.memories[0].slot)] if state.memories[0].mode == Mode.ERUPT else []
    assert slots == rounds and state.clock[0].finished == 1


def test_a_slot_begins_the_same_compiled_and_interpreted():
    state = mission(behaviour=FLOWN)
    while state.memories[0].mode != Mode.GATHER:
        advance(state, 1)
    state.charts[0].gather_cycles = 4
    state.memories[0].since = state.clock[0].cycle
    expected = compiled("coverage", state, 16)
    assert round_of(int(expected.memories[0].epoch)) == 1 and (expected.memories.arm == 0).all()
    assert differences(interpreted("coverage", state, 16), expected) == []


@pytest.mark.parametrize("cut", [False, True])
def test_the_dead_are_silent_and_the_others_finish(cut):
    """Traps 18 and 24: a robot dies as the arms are out, any one, or one whose loss parts the swarm."""
    state = mission(slots=(FAR, *SLOTS[1:]), behaviour=FLOWN)
    while state.tasks[0].worked < 20:
        advance(state, 1)
    victim = next(i for i in range(1, 8) if parts(state, i) == cut)
    touch_robot(state, Intervention(0, "kill", int(state.robots[victim].identity)))
    place = state.world.bodies[victim].x, state.world.bodies[victim].y
    while not state.clock[0].finished and state.clock[0].cycle < 15000:
        advance(state, 1)
        assert state.commands[victim].message.bytes == 0 and state.commands[victim].enabled[0] == 0
    assert (state.world.bodies[victim].x, state.world.bodies[victim].y) == place
    assert state.clock[0].finished == 1 and state.clock[0].cycle < LATEST
    assert state.tasks[-1].worked >= state.tasks[-1].needed


def parts(state, victim):
    """Tell whether the living without one are in several pieces by range."""
    others = [i for i in range(len(state.robots)) if i != victim]
    x, y = state.world.bodies.x[others], state.world.bodies.y[others]
    near = np.hypot(x[:, None] - x, y[:, None] - y) <= state.footbot[0].radio_range
    return connected_components(near, directed=False)[0] > 1


def test_broken_messages_break_nothing_in_any_phase_of_a_mission():
    """Trap 25: doubled, out of order, 30 % lost, of wrong slots and far too late phases."""
    draws = np.random.default_rng(5)
    state = mission(behaviour=FLOWN, footbot={"radio_loss": 0.3})
    for _ in range(1500):
        advance(state, 1)
        i = int(draws.integers(len(state.robots)))
        memory, command, reading = state.memories[i].copy(), state.commands[i].copy(), state.readings[i].copy()
        count = int(reading.packet_count)
        if count == 0:
            continue
        packets = np.asarray(reading.packets)
        packets[: 2 * count] = packets[draws.integers(0, count, 2 * count)]
        packets["named"][:count] = 0
        packets["bearing_of_me"][packets["named"] == 0] = np.nan
        packets["epoch"][: 2 * count] = draws.integers(0, 200, 2 * count)
        packets["arm_count"][: 2 * count] = draws.integers(0, 7, 2 * count)
        reading.packet_count = 2 * count
        decide(reading, memory, command, state.behaviour[0], state.charts[i], state.footbot[0])
        for value in (command.left, command.right, *memory.arms["direction"]):
            assert math.isfinite(value)
    assert round_of(int(state.memories[0].epoch)) == 1


@pytest.mark.parametrize(
    ("change", "said"),
    [
        ({"swarm": {"robots": 6}}, r"mission.slots\[0\] wants 6 robots in its arms, swarm.robots = 6 has 5"),
        ({"tasks": {"programme": "tour"}}, "tasks.programme = 'tour': set it to 'mission'"),
        ({"mission": {"slots": ()}}, "without mission.slots: give a map"),
        ({"mission": {"slots": ({"x": 0.0, "y": 0.0, "tasks": ()},)}}, "mission.slots.0.tasks"),
    ],
)
def test_a_plan_that_cannot_be_flown_is_refused_by_name(change, said):
    groups = {"swarm": {"robots": 8}, "tasks": {"programme": "mission"}, "mission": {"slots": SLOTS}} | change
    with pytest.raises(ValidationError, match=said):
        coverage_parameters(0, **groups)

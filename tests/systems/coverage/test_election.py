"""Who follows a master that has fallen silent (ST-48, ST-72), by words alone; and that robots know where they are."""

import math

import numpy as np
import pytest
from pydantic import ValidationError

from formicarium.contracts.interpreted import compiled, interpreted
from formicarium.contracts.states import copy_of, differences
from formicarium.systems.coverage.behaviour import decide
from formicarium.systems.coverage.election import STANDING, comes_before
from formicarium.systems.coverage.memory import Mode, Stage
from formicarium.systems.coverage.parameters import coverage_parameters
from formicarium.systems.coverage.replanning import advance as go_on
from systems.coverage.swarm import advance, line, move, stay, swarm
from systems.coverage.test_mission import FLOWN, PLANNED, SLOTS, mission

SILENCE = 50
FOLLOWING = {**FLOWN, "silence_cycles": SILENCE}


def chain(count=8, **groups):
    """Return a chain whose robots have all heard of the master."""
    slots = {"mission": {"slots": SLOTS}, "tasks": PLANNED, "behaviour": FOLLOWING}
    state = swarm(line(count), setting=0, **{**slots, **groups})
    return stay(state, 40)


def kill(state, i):
    state.robots[i].dies_at = state.clock[0].cycle
    return state


def test_the_lowest_number_alive_follows_and_nobody_before_five_seconds():
    state = chain()
    kill(state, 0)
    stay(state, SILENCE)
    assert (state.memories.office[1:] == 1).all() and (state.memories.master[1:] == 0).all()
    stay(state, 2 * 8 + STANDING * 8 + 10)
    lowest = 1 + int(state.robots.identity[1:].argmin())
    assert np.flatnonzero(state.memories.master[1:] == 1).tolist() == [lowest - 1]
    assert (state.memories.leader[1:] == state.robots.identity[lowest]).all()
    assert (state.memories.term[1:] == 2).all() and (state.memories.office[1:] == 1).all()


def test_with_other_numbers_another_one_follows():
    """Trap 16: a number decides who follows and nothing else."""
    followers = set()
    for draw in range(4):
        state = chain()
        state.robots.identity[:] = np.random.default_rng(draw).permutation(state.robots.identity)
        state.memories[0].leader = state.robots[0].identity
        stay(kill(stay(state, 60), 0), 120)
        master = int(np.flatnonzero((state.memories.master == 1) & (state.robots.alive == 1))[0])
        assert state.robots[master].identity == state.robots.identity[1:].min()
        followers.add(master)
    assert len(followers) > 1


def test_who_is_h_hops_away_gives_the_master_up_h_cycles_later():
    """Light-cone: the last word of the master travels one hop a cycle, and everybody counts from when it came."""
    state = kill(chain(), 0)
    gave_up = np.full(8, -1)
    for cycle in range(SILENCE + 20):
        before = state.memories.office.copy()
        stay(state, 1)
        gave_up[(before == 1) & (state.memories.office == 0) & (gave_up < 0)] = cycle
    first = int(gave_up[1])
    assert gave_up[2:].min() > 0
    assert (gave_up[1:] <= first + np.arange(7)).all() and (np.diff(gave_up[1:]) >= 0).all()


def test_less_than_half_waits_to_meet_others_and_more_than_half_does_not():
    state = kill(chain(9, behaviour={**FOLLOWING, "patience_cycles": 300}), 0)
    for robot in (6, 7, 8):
        state = move(state, robot, 100.0 + 2.0 * robot, 0.0)
    stay(state, 120)
    assert (state.memories.office[1:6] == 1).all() and state.memories.master[1:6].sum() == 1
    assert (state.memories.office[6:] == 0).all() and state.memories.master[6:].sum() == 0
    assert (state.memories.stage[6:] == Stage.LOST).all()
    stay(state, 300)
    assert state.memories.master[6:].sum() == 1


def test_two_groups_that_meet_have_one_master():
    state = kill(chain(9, behaviour={**FOLLOWING, "patience_cycles": 30}), 0)
    for robot in (6, 7, 8):
        state = move(state, robot, 100.0 + 2.0 * robot, 0.0)
    stay(state, 200)
    assert state.memories.master[1:].sum() == 2
    for robot in (6, 7, 8):
        state = move(state, robot, 2.0 * robot, 0.0)
    stay(state, 30)
    assert state.memories.master[1:].sum() == 1 and len(set(state.memories.leader[1:].tolist())) == 1


def test_a_master_that_was_only_out_of_earshot_is_followed_again():
    state = chain()
    away = stay(move(state, 0, 100.0, 0.0), SILENCE + 15)
    assert (away.memories.office[1:] == 0).any() and (away.memories.term == 1).all()
    back = stay(move(away, 0, 0.0, 0.0), 20)
    assert (back.memories.office == 1).all() and (back.memories.leader == back.robots.identity[0]).all()
    assert back.memories.master.tolist() == [1, *[0] * 7]


def test_stale_words_and_unknown_leaders_are_no_news():
    state = chain()
    memory, packet = state.memories[3].copy(), state.readings[3].packets[0].copy()
    memory.leader, memory.term, memory.office, memory.given_up, memory.given_up_beat = 9, 1, 0, 7, 100
    packet.term, packet.leader, packet.office, packet.beat = 1, 7, 1, 100
    assert not comes_before(memory, packet)
    packet.beat = 101
    assert comes_before(memory, packet)
    packet.leader, packet.office = 12, 0
    assert not comes_before(memory, packet)
    packet.leader = 8
    assert comes_before(memory, packet)
    packet.leader = 0
    assert not comes_before(memory, packet)
    packet.leader, packet.office, packet.term, memory.office = 200, 1, 2, 1
    assert comes_before(memory, packet)


def test_everybody_learns_where_it_is_in_the_frame_of_the_map():
    """From words and wheels: no robot is told its place, and the world's frame is the master's at the start."""
    state = mission(behaviour=FOLLOWING)
    assert state.memories.placed.tolist() == [1, *[0] * 7]
    advance(state, 700)
    bodies = state.world.bodies.copy()  # as they are when robots sense
    advance(state, 1)
    assert (state.memories.placed == 1).all()
    gaps = np.hypot(state.memories.way_ahead - bodies.x, state.memories.way_aside - bodies.y)
    turns = np.abs((state.memories.facing - bodies.heading + math.pi) % (2 * math.pi) - math.pi)
    assert gaps.max() < 0.05 and turns.max() < 0.05
    assert np.hypot(state.world.bodies.x, state.world.bodies.y).max() > 1.2


def test_a_mission_is_done_without_its_first_master_and_nobody_jumps():
    state = mission(behaviour=FOLLOWING, mission={"slots": SLOTS, "replans": 5})
    go_on(state, 150)
    kill(state, 0)
    longest = 0.0
    while not state.clock[0].finished and state.clock[0].cycle < 9000:
        before = state.world.bodies.copy()
        go_on(state, 1)
        state.clock[0].event_count = 0
        longest = max(longest, float(np.hypot(state.world.bodies.x - before.x, state.world.bodies.y - before.y).max()))
    assert state.clock[0].finished == 1 and (state.tasks.worked >= state.tasks.needed).all()
    assert longest <= 0.015 + 1e-9 and state.survey[0].master != 0


def test_without_new_plans_a_successor_flies_the_plan_from_its_beginning():
    state = kill(advance(mission(behaviour=FOLLOWING), 150), 0)
    while not state.clock[0].finished and state.clock[0].cycle < 9000:
        advance(state, 1)
    assert state.clock[0].finished == 1 and (state.tasks.worked >= state.tasks.needed).all()


def test_what_is_said_of_the_master_costs_54_bytes():
    state = advance(mission(behaviour=FOLLOWING), 900)
    message = state.commands.message
    assert (message["bytes"] == 54 + 54 + 27 * message["arm_count"] + 9 * message["entry_count"]).all()
    assert (message["bytes"] <= 500).all() and (message["arm_count"] > 0).any()


def test_a_master_is_followed_the_same_compiled_and_interpreted():
    state = kill(advance(mission(behaviour=FOLLOWING), 150), 0)
    advance(state, SILENCE + 10)
    while not (state.memories.master[1:] == 1).any():
        kept = copy_of(state)
        advance(state, 1)
    expected = compiled("coverage", kept, 12)
    assert (expected.memories.master[1:] == 1).any()
    assert differences(interpreted("coverage", kept, 12), expected) == []


def test_broken_words_of_masters_break_nothing():
    """Trap 25: doubled, out of order, of masters that never were."""
    draws = np.random.default_rng(7)
    state = mission(behaviour=FOLLOWING, footbot={"radio_loss": 0.3})
    for _ in range(800):
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
        packets["placed"][count : count + 1] = 0
        packets["way_ahead"][packets["placed"] == 0] = np.nan
        for name, most in (("term", 4), ("leader", 256), ("office", 2), ("beat", 10**6), ("epoch", 200)):
            packets[name][: 2 * count] = draws.integers(0, most, 2 * count)
        reading.packet_count = 2 * count
        decide(reading, memory, command, state.behaviour[0], state.charts[i], state.footbot[0])
        for value in (command.left, command.right, memory.way_ahead, memory.way_aside, memory.facing):
            assert math.isfinite(value)


def test_default_messages_say_nothing_of_masters():
    state = advance(mission(behaviour=FLOWN), 300)
    assert (state.commands.message["term"] == 0).all() and (state.memories.placed == 0).all()
    assert (state.charts.slot_count[1:] == 0).all() and state.memories[0].mode != Mode.WAIT


def test_a_successor_without_a_mission_is_refused_by_name():
    said = "behaviour.silence_cycles = 50, but tasks.programme = 'tour'"
    with pytest.raises(ValidationError, match=said):
        coverage_parameters(0, behaviour={"silence_cycles": 50})

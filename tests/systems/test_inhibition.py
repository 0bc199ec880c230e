"""Robots make room for the one that has set out for a task (TS-64, TS-105, TS-106, T22)."""

import math

import pytest

from formicarium.robots.records import Colour
from formicarium.systems.sequencing.memory import State
from systems.one_robot import OneRobot
from systems.stage import add_packet, guardian, put_before_booth, step, wide_stage, written

INHIBITION = written(identity=99, inhibit=1)
ECHO = written(identity=99, inhibit=1, guardian=1, colour=1, count=7)


def bystander(seed: int = 1, identity: int = 7, **numbers) -> OneRobot:
    """Return a runner that follows a chain near a booth's guardian."""
    return OneRobot(identity, seed, **numbers).turn_to(State.FOLLOW)


def told(robot: OneRobot, payload, distance: float = 0.2, bearing: float = 0.3) -> OneRobot:
    return robot.see((Colour.CYAN, 0.22, 0.5), (Colour.YELLOW, 0.15, 1.5)).hear(payload, distance, bearing).live()


@pytest.mark.parametrize("payload", [INHIBITION, ECHO], ids=["initiator", "echo"])
def test_a_runner_near_a_task_stays_clear_while_another_sets_out_for_it(payload):
    robot = bystander(inhibition_leave=0.0)
    assert told(robot, payload).memory.state == State.INHIBITED


def test_with_the_initiator_muted_runners_crowd_in():
    """T22: nothing but the message holds them back."""
    robot = bystander(inhibition_leave=0.0)
    for _ in range(20):
        robot.see((Colour.CYAN, 0.22, 0.5), (Colour.YELLOW, 0.15, 1.5)).live()
        assert robot.memory.state == State.FOLLOW and robot.motion()[0] > 0


def test_everyone_but_the_initiator_obeys_an_echo():
    """TS-64."""
    assert told(bystander(identity=99, inhibition_leave=0.0), ECHO).memory.state == State.FOLLOW


def test_the_initiator_itself_goes_on():
    robot = OneRobot(99).turn_to(State.APPROACH)
    m = robot.memory
    m.colour, m.target.known, m.target.x, m.target.seen = Colour.RED, 1, 0.25, robot.reading.cycle
    robot.see((Colour.RED, 0.25, 0.0)).hear(ECHO).live()
    assert m.state == State.APPROACH and robot.motion()[0] > 0


def test_of_two_that_have_set_out_one_gives_way():
    """U28: of any two identities, exactly one."""
    for a, b in ((3, 200), (200, 3), (99, 100)):
        yielded = []
        for own, other in ((a, b), (b, a)):
            robot = OneRobot(own).turn_to(State.APPROACH)
            m = robot.memory
            m.colour, m.target.known, m.target.x, m.target.seen = Colour.RED, 1, 0.25, robot.reading.cycle
            robot.see((Colour.RED, 0.25, 0.0)).hear(written(identity=other, inhibit=1)).live()
            yielded.append(bool(m.state == State.INHIBITED))
        assert sorted(yielded) == [False, True]


def test_inhibition_counts_only_within_its_distance():
    """TS-106: radio range would freeze the whole arena."""
    robot = bystander(inhibition_leave=0.0)
    assert told(robot, INHIBITION, robot.table.inhibition_distance + 0.01).memory.state == State.FOLLOW
    assert told(robot, INHIBITION, robot.table.inhibition_distance - 0.01).memory.state == State.INHIBITED


def test_an_inhibited_robot_resumes_after_a_while_without_messages():
    robot = told(bystander(inhibition_leave=0.0), INHIBITION)
    for _ in range(int(robot.table.inhibition_memory)):
        assert robot.see((Colour.YELLOW, 0.3, 1.5)).live().memory.state == State.INHIBITED
        assert robot.motion() == (0.0, 0.0)
    for _ in range(3):
        robot.see((Colour.YELLOW, 0.15, 1.5)).live()
    assert robot.memory.state == State.FOLLOW


def test_an_inhibited_robot_clears_the_space_before_the_task():
    robot = told(bystander(inhibition_leave=0.0), INHIBITION)
    near = float(robot.table.inhibition_clearance) - 0.05
    robot.see((Colour.CYAN, near, math.pi)).hear(INHIBITION).live()
    assert robot.motion()[0] > 0  # the guardian is behind it
    robot.see((Colour.CYAN, near, 0.0)).hear(INHIBITION).live()
    forward, turn = robot.motion()
    assert forward <= 1e-9 and turn != 0.0  # ahead of it: turns away, does not drive at it


def test_an_inhibited_robot_keeps_its_count():
    """TS-104."""
    robot = bystander()
    robot.memory.count = 2
    for _ in range(100):
        told(robot, INHIBITION)
    assert robot.memory.count == 2


@pytest.mark.parametrize("leave", [0.0, 0.2, 1.0])
def test_with_a_certain_probability_it_leaves_instead(leave):
    left = sum(told(bystander(seed, inhibition_leave=leave), INHIBITION).memory.state != State.INHIBITED
               for seed in range(400))  # fmt: skip
    spread = 3.5 * math.sqrt(400 * leave * (1 - leave))
    assert abs(left - 400 * leave) <= spread


def test_a_runner_inhibits_from_setting_out_until_it_is_past_the_guardian():
    """TS-106."""
    for state in (*(State.APPROACH, State.EXCHANGE, State.TURN_ROUND, State.LEAVE, State.STAND_OFF),):
        robot = OneRobot().turn_to(state)
        m = robot.memory
        m.colour, m.target.known, m.target.x, m.target.seen = Colour.RED, 1, 0.06, robot.reading.cycle
        m.turn_left = 3.0
        robot.live()
        assert robot.message().inhibit == 1 and robot.message().identity == 7, state
    for state in (State.WALK, State.FOLLOW, State.JOIN):
        message = OneRobot().turn_to(state).live().message()
        assert message is None or message.inhibit == 0


def test_an_inhibited_robot_between_guardian_and_booth_does_not_back_into_the_bay():
    """TS-106: it is to clear the space before the task, not to fill the booth."""
    entered = 0
    for seed in range(8):
        state = wide_stage(3, seed, setting=0, behaviour={"inhibition_leave": 0.0})
        booth = seed % 3
        put_before_booth(state, 0, booth, 0.19)
        state.world.bodies[0].heading += math.pi
        guardian(state, 0, int(state.booths[booth].colour), True, 3, in_chain=1)
        put_before_booth(state, 1, booth, 0.07, 0.03 * (seed % 3 - 1))  # between the two
        state.memories[1].state = State.FOLLOW

        def inhibit(state):
            add_packet(state.readings[1], INHIBITION, 0.25, 0.0)

        step(state, 200, inhibit)
        entered += int(state.booths[booth].occupied)
    assert entered == 0

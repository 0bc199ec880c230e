"""What happens at the booths: candidates, guardians, visitors, and who is believed (T14 to T18, U28 to U32)."""

import math

import numpy as np
import pytest

from formicarium.devices.booth import placed
from formicarium.physics.world import joined, outline
from formicarium.robots.infrared import FAILURE, SUCCESS
from formicarium.robots.records import Colour
from formicarium.systems.sequencing.arena import make_arena
from formicarium.systems.sequencing.booth_visit import begin_visit
from formicarium.systems.sequencing.loop import run
from formicarium.systems.sequencing.measures import EventKind
from formicarium.systems.sequencing.memory import Role, State
from formicarium.systems.sequencing.parameters import mark_i3_parameters
from formicarium.systems.sequencing.setup import begin
from formicarium.trial.simulate import drain
from systems.one_robot import OneRobot
from systems.stage import add_packet, guardian, put, put_before_booth, step, wide_stage, written

SURE = {"booth": {"exchange_failure": 0.0}}
VISIT = 150  # cycles, a visit takes no longer: 2.6 s in, 7 s of task, 1.7 s to turn round, 2.5 s out, and some reserve


def booth_of(state, place: int) -> int:
    """Return the index of the booth whose task has a place (0, 1, 2) in the correct order."""
    return int(np.argmax(state.booths.colour == state.coordinator[0].order[place]))


def send_in(state, i: int, booth: int, count: int, candidate: int = 0) -> None:
    """Let a runner that has done ``count`` tasks set out for a booth right in front of it."""
    put_before_booth(state, i, booth, 0.06)
    begin_visit(state.memories[i], int(state.booths[booth].colour), candidate, int(state.clock[0].cycle))
    state.memories[i].count = count


def of(events, kind):
    return events[events["kind"] == kind]


def test_a_runner_obeys_only_a_guardian_it_hears():
    """T14: with the guardian's radio muted runners pass by, though they see its light and the booth's."""
    for muted in (False, True):
        robot = OneRobot().turn_to(State.FOLLOW)
        m = robot.memory
        m.count = 1
        m.adverts[Colour.RED].heard = robot.reading.cycle - robot.table.advert_memory - 1  # before it fell silent
        for _ in range(int(robot.table.unattended_after - robot.table.advert_memory) - 1):
            robot.see((Colour.CYAN, 0.2, 0.5), (Colour.RED, 0.25, -0.8))
            if not muted:
                robot.hear(written(identity=50, guardian=1, colour=Colour.RED, count=1, confident=1), 0.2, 0.5)
            robot.live()
        assert (m.state == State.APPROACH and m.candidate == 0) == (not muted)


@pytest.mark.parametrize("flipped", range(8))
def test_a_runner_obeys_the_bits_that_arrive(flipped):
    """T14: CND = 1, CONF = 1 as sent, some bits of CND changed in transit; a runner with CNT = 1 obeys CND = 1."""
    robot = OneRobot().turn_to(State.FOLLOW)
    robot.memory.count = 1
    payload = written(identity=50, guardian=1, colour=Colour.RED, count=1, confident=1)
    payload[3] ^= flipped
    for _ in range(8):
        robot.see((Colour.CYAN, 0.2, 0.5), (Colour.RED, 0.25, -0.8)).hear(payload, 0.2, 0.5).live()
    assert (robot.memory.state == State.APPROACH) == (flipped == 0)


def test_guidance_counts_only_near_the_guardians_light():
    """TS-100: the radio reaches farther than the decision."""
    robot = OneRobot().turn_to(State.FOLLOW)
    for _ in range(8):
        robot.see((Colour.CYAN, robot.table.decide_distance + 0.02, 0.5), (Colour.RED, 0.25, -0.8))
        robot.hear(written(identity=50, guardian=1, colour=Colour.RED, confident=1), 0.32, 0.5).live()
    assert robot.memory.state != State.APPROACH


@pytest.fixture
def watched_task():
    """A guardian that waits with (1, 0) and, 0.2 m beside it, a runner that has done nothing."""
    state = wide_stage(2, epuck={"radio_loss": 0.0})
    put(state, 0, 0.0, 0.0)
    guardian(state, 0, Colour.GREEN, False)
    step(state, 2)
    drain(state)
    return state


def forged(count: int, success: int, distance: float):
    """Return an edit that lets the guardian hear a notification nobody is entitled to send."""

    def edit(state):
        payload = written(identity=int(state.robots[1].identity), count=count, direction=success)
        state.readings[0].packet_count = 0
        add_packet(state.readings[0], payload, distance, 1.0)

    return edit


@pytest.mark.parametrize(("count", "success", "after"), [(2, 1, (1, 1)), (1, 0, (2, 0))])
def test_a_forged_notification_is_believed_and_logged_as_unfounded(watched_task, count, success, after):
    """T15: nothing in four bytes proves an execution; the observers tell."""
    step(watched_task, 1, forged(count, success, 0.2))
    m = watched_task.memories[0]
    assert (m.condition, m.confident) == after
    unfounded = of(drain(watched_task), EventKind.UNFOUNDED)
    assert unfounded["subject"].tolist() == [Colour.GREEN]
    assert unfounded["value"].tolist() == [int(watched_task.robots[1].identity)]


def test_a_notification_from_afar_changes_nothing(watched_task):
    """T15."""
    step(watched_task, 20, forged(2, 1, watched_task.behaviour[0].notification_gate + 0.01))
    m = watched_task.memories[0]
    assert (m.condition, m.confident) == (1, 0)
    assert not np.isin(drain(watched_task)["kind"], (EventKind.CONDITION, EventKind.UNFOUNDED)).any()


def test_no_task_is_done_through_a_blocked_mouth():
    """T16: a board across every mouth, lights in full view; robots try, nothing counts, nobody becomes guardian."""
    p = mark_i3_parameters()
    arena = make_arena(p.arena, p.booth.friction)
    boards = [
        outline([placed(x, y, way, u, v) for u, v in ((-0.06, 0.05), (-0.055, 0.05), (-0.055, -0.05), (-0.06, -0.05))])
        for x, y, way in arena.booths
    ]
    for seed in range(2):
        state = begin(p, seed, arena=arena._replace(segments=joined(arena.segments, *boards)))
        tried = 0
        for _ in range(60):
            run(state, 100)
            tried += int((state.memories.state == State.APPROACH).sum())
            assert not np.isin(drain(state)["kind"], (EventKind.EXECUTED, EventKind.ROLE, EventKind.SEQUENCE)).any()
        assert tried > 5
        assert (state.memories.role == Role.RUNNER).all() and state.referee.executions.sum() == 0


def test_a_task_done_in_the_right_order_counts_and_is_reported():
    state = wide_stage(1, setting=0, **SURE)
    send_in(state, 0, booth_of(state, 0), 0)
    step(state, VISIT)
    done = of(drain(state), EventKind.EXECUTED)
    assert done[["value", "detail"]].tolist() == [(1, 1)]
    m = state.memories[0]
    assert (m.count, m.reported, m.verdict, m.role) == (1, 1, 1, Role.RUNNER)


def test_a_robot_that_lies_about_its_count_is_refused_and_not_counted():
    """T18: it claims the last number of the sequence at the last task without having done the others."""
    state = wide_stage(1, setting=0, **SURE)
    send_in(state, 0, booth_of(state, 2), 2)
    step(state, VISIT)
    events = drain(state)
    executed = of(events, EventKind.EXECUTED)
    assert executed[["value", "detail"]].tolist() == [(0, 3)]
    assert len(of(events, EventKind.PROTOCOL_FAULT)) == 1
    assert len(of(events, EventKind.SEQUENCE)) == 0 and state.chain[0].sequences == 0
    assert state.memories[0].count == 0


def test_an_honest_robot_is_counted_by_the_referee_whatever_it_believes():
    """TS-31, T18: the three tasks in order make a sequence, from presence alone."""
    state = wide_stage(1, setting=0, **SURE)
    for place in range(3):
        send_in(state, 0, booth_of(state, place), place)
        step(state, VISIT)
    events = drain(state)
    assert of(events, EventKind.SEQUENCE)["value"].tolist() == [1]
    assert not np.isin(events["kind"], (EventKind.PROTOCOL_FAULT, EventKind.DISAGREEMENT)).any()


def test_the_first_execution_of_a_future_guardian_never_completes_a_sequence():
    """TS-137."""
    state = wide_stage(1, setting=0, **SURE)
    for place in range(3):
        send_in(state, 0, booth_of(state, place), place, candidate=int(place == 2))
        step(state, VISIT)
    events = drain(state)
    assert of(events, EventKind.EXECUTED)[["value", "detail"]].tolist() == [(1, 1), (1, 2), (1, 3)]
    assert len(of(events, EventKind.SEQUENCE)) == 0 and state.chain[0].sequences == 0


def test_a_mute_booths_visitor_leaves_waits_and_tries_again():
    """TS-25, U30: then it goes on unchanged."""
    state = wide_stage(1, setting=0, booth={"exchange_failure": 1.0})
    send_in(state, 0, booth_of(state, 0), 0)
    state.memories[0].count = 1
    states = []
    step(state, 2000, None, lambda state: states.append(int(state.memories[0].state)))
    events = drain(state)
    tries = 1 + int(state.behaviour[0].retries)
    mute = of(events, EventKind.NO_ANSWER)
    assert len(mute) >= tries and len(of(events, EventKind.EXECUTED)) == 0
    pause = np.diff(np.flatnonzero(np.array(states) == State.PAUSE))
    assert (np.array(states) == State.PAUSE).sum() >= (tries - 1) * state.behaviour[0].retry_pause
    assert (pause > 1).sum() >= tries - 2  # separate pauses
    assert state.memories[0].count == 1 and state.memories[0].notifying == 0


def test_a_second_entry_that_is_answered_makes_up_for_a_lost_exchange():
    """Movie S1: 6:38 no communication, 6:58 done."""
    state = wide_stage(1, setting=0, booth={"exchange_failure": 1.0})
    send_in(state, 0, booth_of(state, 0), 0)
    while state.memories[0].state != State.PAUSE and state.clock[0].cycle < 1000:
        step(state)
    state.booth_table[0].exchange_failure = 0.0
    step(state, 500)
    events = drain(state)
    visits = of(events, EventKind.VISIT)
    entered = visits["cycle"][visits["value"] == 1]
    assert len(of(events, EventKind.NO_ANSWER)) == 1
    assert of(events, EventKind.EXECUTED)["value"].tolist()[:1] == [1]
    assert entered[1] - entered[0] > state.behaviour[0].retry_pause


def test_of_two_robots_that_select_the_same_booth_at_once_one_becomes_its_guardian():
    """U28, U29."""
    for seed in range(6):
        state = wide_stage(2, seed, setting=0, **SURE)
        booth = seed % 3
        for i, aside in enumerate((0.06, -0.06)):
            put_before_booth(state, i, booth, 0.1 + 0.001 * seed, aside)
            begin_visit(state.memories[i], int(state.booths[booth].colour), 1, 0)
        step(state, 600)
        guards = state.memories[state.memories.role == Role.GUARDIAN]
        assert (guards.colour == state.booths[booth].colour).sum() == 1, seed


def leaving_candidate(count: int, verdict: int) -> OneRobot:
    """Return a future guardian on its way out of the bay, its task just done."""
    robot = OneRobot().turn_to(State.EXCHANGE)
    m = robot.memory
    m.colour, m.candidate, m.count, m.exchange = Colour.RED, 1, count, verdict
    robot.live()
    robot.turn_to(State.STAND_OFF)
    return robot


@pytest.mark.parametrize(
    ("count", "verdict", "after"), [(0, SUCCESS, 1), (0, FAILURE, 0), (1, SUCCESS, 2), (2, SUCCESS, 0), (1, FAILURE, 0)]
)
def test_a_candidate_that_finds_a_guardian_on_its_way_out_stays_runner(count, verdict, after):
    """U29: and has done its task as any runner has (TS-104)."""
    robot = leaving_candidate(count, verdict)
    robot.hear(written(identity=50, guardian=1, colour=Colour.RED), 0.2, 0.0).live()
    m = robot.memory
    assert (m.role, m.candidate, m.state) == (Role.RUNNER, 0, State.LEAVE)
    assert m.count == after


def test_a_candidate_that_finds_no_guardian_stops_in_front_of_the_booth_as_guardian():
    """TS-45: exit_distance out, by the booth's lights behind it."""
    robot = leaving_candidate(0, SUCCESS)
    robot.see((Colour.RED, robot.table.exit_distance, math.pi)).live()
    assert robot.memory.role == Role.RUNNER and robot.motion()[0] > 0
    robot.see((Colour.RED, robot.table.exit_distance + robot.table.lights_depth + 0.001, math.pi)).live()
    assert robot.memory.role == Role.GUARDIAN and (robot.memory.condition, robot.memory.confident) == (0, 1)


def test_a_dead_guardians_task_becomes_unattended_and_gets_a_new_guardian():
    """U31, U32, TS-54: from its own first execution, not from what the dead one knew."""
    found = 0
    for seed in range(6):
        state = wide_stage(2, seed, setting=0, **SURE)
        booth = booth_of(state, 1)
        colour = int(state.booths[booth].colour)
        put_before_booth(state, 0, booth, 0.19, 0.1)  # beside the way
        guardian(state, 0, colour, True, 3)  # wants two tasks done first
        state.robots[0].dies_at = 5
        put_before_booth(state, 1, booth, 0.16)
        state.memories[1].count = 1
        step(state, 4)
        assert state.memories[1].state != State.APPROACH  # attended
        step(state, 900)
        m = state.memories[1]
        if m.role == Role.GUARDIAN and m.colour == colour:
            found += 1
            assert (m.condition, m.confident) == (2, 0)  # nobody had recorded a first task: failure with CNT = 1
    assert found >= 3


def test_an_unattended_task_is_one_whose_guardian_has_not_been_heard_for_a_while():
    """TS-92: any distance will do, the radio says whose task it is."""
    robot = OneRobot(walk_turn_probability=0.0)
    for _ in range(30):
        robot.see((Colour.RED, 0.3, 0.4)).hear(written(identity=50, guardian=1, colour=Colour.RED, count=1), 0.7).live()
        assert robot.memory.state == State.WALK
    silent = 0
    while robot.memory.state != State.APPROACH and silent < 100:
        robot.see((Colour.RED, 0.3, 0.4)).live()
        silent += 1
    assert robot.memory.candidate == 1 and robot.memory.colour == Colour.RED
    assert silent >= robot.table.unattended_after


def test_a_robot_in_the_bay_names_itself_and_its_next_number():
    """TS-29 with an 8-bit identity in two bytes, n = CNT + 1."""
    robot = OneRobot(0xB6).turn_to(State.EXCHANGE)
    robot.memory.count = 1
    said = []
    for heard in (None, 0x10, 0x11, 0x12):
        if heard is not None:
            robot.reading.infrared = heard
        said.append(int(robot.live().command.infrared))
    assert said == [0x8B, 0x96, 0x22, 0x22]


def test_a_runner_stops_notifying_when_the_guardian_shows_that_it_knows():
    """U54: the guardian's own G_ADV is the acknowledgement."""
    robot = OneRobot().turn_to(State.FOLLOW)
    m = robot.memory
    m.notifying, m.reported, m.verdict, m.verdict_heard, m.colour = 1, 1, 0, robot.reading.cycle, Colour.RED
    old = written(identity=50, guardian=1, colour=Colour.RED, count=1)
    new = written(identity=50, guardian=1, colour=Colour.RED, count=2)
    for _ in range(int(robot.table.notify_least) + 5):
        assert robot.hear(old).live().memory.notifying == 1 and robot.message().count == 1
    robot.hear(new).live()
    assert m.notifying == 0 and robot.sent() == {}


def test_a_runner_does_not_repeat_the_task_it_has_just_done_until_the_guardian_knows():
    robot = OneRobot().turn_to(State.FOLLOW)
    m = robot.memory
    m.count, m.last_success = 2, Colour.RED
    for _ in range(10):
        robot.see((Colour.CYAN, 0.2, 0.5), (Colour.RED, 0.25, -0.8))
        robot.hear(written(identity=50, guardian=1, colour=Colour.RED, count=1), 0.2, 0.5).live()
    assert m.state != State.APPROACH


@pytest.mark.parametrize("heading", range(0, 360, 45))
def test_a_walking_robot_finds_its_way_out_of_a_bay(heading):
    """However it got there: it must not block the booth to the end of the trial."""
    state = wide_stage(1, 40 + heading, setting=0)
    put_before_booth(state, 0, 0, -0.06)
    state.world.bodies[0].heading += math.radians(heading)
    occupied = []
    step(state, 600, None, lambda state: occupied.append(int(state.booths[0].occupied)))
    assert 1 in occupied and 0 in occupied[10:]


def test_a_guardian_that_is_seen_but_not_heard_keeps_its_task():
    """U28, T14: crowds and booths shadow the radio for seconds; its light tells that the task is attended."""
    robot = OneRobot(walk_turn_probability=0.0)
    for _ in range(100):
        robot.see((Colour.CYAN, 0.2, 0.5), (Colour.RED, 0.25, -0.4)).live()
        assert robot.memory.state != State.APPROACH


def test_a_candidate_on_its_way_out_that_sees_a_guardian_stays_runner():
    """U29: also if it cannot hear it."""
    robot = leaving_candidate(0, SUCCESS)
    for _ in range(3):
        robot.see((Colour.CYAN, 0.15, 0.3), (Colour.RED, 0.1, math.pi)).live()
    out = robot.table.exit_distance + robot.table.lights_depth + 0.001
    robot.see((Colour.CYAN, 0.1, 0.3), (Colour.RED, out, math.pi)).live()
    assert robot.memory.role == Role.RUNNER


def test_a_parked_robot_is_no_visitor():
    state = wide_stage(1)
    put(state, 0, 0.0, 0.0)
    step(state, 50)
    assert len(of(drain(state), EventKind.VISIT)) == 0

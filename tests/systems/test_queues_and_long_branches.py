"""What large arenas and crowds ask of the rules: straight branches, patient tails, room round guardians and booths."""

import math

import numpy as np
import pytest

from formicarium.angles import wrapped
from formicarium.control.odometry import place
from formicarium.robots.infrared import SUCCESS
from formicarium.robots.records import Colour
from formicarium.systems.sequencing.booth_visit import UNSEEN_STEPS, begin_visit
from formicarium.systems.sequencing.memory import Role, State
from formicarium.systems.sequencing.parameters import BehaviourTable
from systems.one_robot import EPUCK, OneRobot
from systems.stage import (
    add_packet,
    chain,
    end_in_tail,
    guardian,
    put,
    put_before_booth,
    step,
    tails,
    wide_stage,
    written,
)

TABLE = BehaviourTable()
INHIBITION = written(identity=99, inhibit=1)
UNREACHABLE = 2.0  # of a proximity value, which is at most 1
FOR_EVER = 1_000_000  # cycles
QUIET = {"camera_distance_noise": 0.0, "camera_bearing_noise": 0.0, "camera_miss": 0.0}


# Links mend until well within tolerance.


def show_errors(robot: OneRobot, gap: float, bend: float) -> OneRobot:
    """Let a link live a cycle between neighbours that are off by these shares of its tolerances."""
    cycle = robot.reading.cycle
    place(robot.memory.successor, TABLE.spacing + gap * TABLE.spacing_tolerance, 0.0, cycle)
    place(robot.memory.predecessor, TABLE.spacing, math.pi - bend * TABLE.alignment_tolerance, cycle)
    return robot.live()


def resting_link() -> OneRobot:
    robot = OneRobot().lead()
    robot.memory.role, robot.memory.state = Role.LINK, State.STAY
    return robot


@pytest.mark.parametrize(("gap", "bend"), [(1.0, 0.0), (-1.0, 0.0), (0.0, 1.0), (0.0, -1.0), (1.0, 1.0)])
def test_a_link_out_of_tolerance_mends_until_well_within_and_then_rests(gap, bend):
    """TS-69: and within tolerance it never starts."""
    robot = resting_link()
    share = TABLE.mending_share
    for error, state in (
        *((0.95, State.STAY), (1.05, State.MEND), (0.95, State.MEND), (share + 0.05, State.MEND)),
        *((share - 0.05, State.STAY), (0.95, State.STAY), (1.05, State.MEND)),
    ):
        show_errors(robot, error * gap, error * bend)
        assert robot.memory.state == state, error
        assert (robot.motion() == (0.0, 0.0)) == (state == State.STAY), error


def test_a_link_that_is_told_that_its_branch_is_complete_stays():
    """TS-51, TS-70: also in the midst of mending."""
    robot = resting_link()
    assert show_errors(robot, 1.5, 1.5).memory.state == State.MEND
    robot.hear(written(identity=60, guardian=1, established=1, branch=2))
    assert show_errors(robot, 1.5, 1.5).memory.state == State.STAY
    for _ in range(3):
        assert show_errors(robot, 1.5, 1.5).memory.state == State.STAY and robot.motion() == (0.0, 0.0)


def bends(state, links: int) -> np.ndarray:
    """Return the angle (rad) by which the branch bends at each inner member."""
    places = np.array([(body.x, body.y) for body in state.world.bodies[: links + 1]])
    ways = np.diff(places, axis=0)
    return np.abs(np.diff(np.unwrap(np.arctan2(ways[:, 1], ways[:, 0]))))


def rested(seed: int, share: float) -> np.ndarray:
    """Return the bends (rad) that are left after 40 s of a branch whose links begin with 14 degrees each."""
    links = 6
    state = wide_stage(links + 1, seed, epuck=QUIET, behaviour={"mending_share": share})
    chain(state, links, TABLE.spacing)
    state.memories[links].established = 1  # the last one stands
    x = y = 0.0
    for k in range(1, links + 1):
        way = (k - 1) * math.radians(14)
        x, y = x + TABLE.spacing * math.cos(way), y + TABLE.spacing * math.sin(way)
        put(state, k, x, y, way)

    def deafen(state):
        state.readings.packet_count = 0

    step(state, 400, deafen)
    return bends(state, links)


@pytest.mark.long
def test_a_branch_whose_links_mend_all_the_way_curls_up_less():
    """Links that rest as soon as they are within tolerance keep nearly all of it, each of them."""
    left = {share: np.mean([rested(seed, share) for seed in range(3)]) for share in (TABLE.mending_share, 1.0)}
    assert left[TABLE.mending_share] < 0.7 * TABLE.alignment_tolerance
    assert left[1.0] > 0.8 * TABLE.alignment_tolerance


# Tails give long branches time.


def pause(state: State, link_number: int, **numbers: int) -> int:
    """Return for how many cycles a tail that nobody answers rests after a state before it sweeps."""
    robot = OneRobot(**numbers).lead(link_number=link_number).turn_to(state)
    robot.memory.successor.seen = robot.reading.cycle - TABLE.track_lost  # if it docks, then out of sight
    states = []
    for _ in range(300):
        place(robot.memory.predecessor, TABLE.spacing, math.pi, robot.reading.cycle)
        states.append(int(robot.live().memory.state))
    return states[states.index(State.OPEN) :].index(State.SWEEP)


@pytest.mark.parametrize("state", [State.SWEEP, State.DOCK])
def test_the_pause_of_a_sweeping_branch_grows_with_its_links(state):
    """U13: after a burst, and after a guardian that went out of sight; the next cycle sweeps."""
    for n in (1, 2, 8, 20, 31):
        assert pause(state, n) == TABLE.sweep_pause + n * TABLE.sweep_pause_per_link + 1
    assert pause(state, 10, sweep_pause_per_link=0) == TABLE.sweep_pause + 1


@pytest.mark.parametrize("state", [State.POSITION, State.OPEN, State.OFFER, State.SWEEP, State.DOCK])
@pytest.mark.parametrize(("branch", "taken_over"), [(2, True), (1, False), (3, False)])
def test_a_tail_hears_in_every_state_that_its_guardian_has_taken_over(state, branch, taken_over):
    """TS-50."""
    robot = OneRobot().lead(branch=1, link_number=6).turn_to(state)
    place(robot.memory.successor, TABLE.spacing, 0.0, robot.reading.cycle)
    robot.memory.chosen = 60
    answer = written(identity=60, guardian=1, colour=Colour.BLUE, established=1, in_chain=1, branch=branch)
    robot.hear(answer, TABLE.spacing, 0.0).live()
    assert (robot.memory.role == Role.LINK) == taken_over == (robot.memory.established == 1)
    assert bool(robot.message().tail) != taken_over


@pytest.mark.parametrize("state_of_tail", [State.OPEN, State.OFFER, State.SWEEP])
def test_a_branch_that_has_reached_its_guardian_does_not_grow_past_it(state_of_tail):
    """A tail that does not listen hands on to the runner that it has chosen, which never finds a guardian."""
    state = wide_stage(5, epuck={"radio_loss": 0.0, "camera_miss": 0.0})
    chain(state, 2, TABLE.spacing)
    end_in_tail(state, 2)
    put(state, 3, 3 * TABLE.spacing, 0.0, math.pi / 2)
    guardian(state, 3, Colour.BLUE, False, 3, in_chain=1)
    state.memories[3].established, state.memories[3].branch = 1, 2
    put(state, 4, 2.5 * TABLE.spacing, -0.14, math.pi / 2)
    state.memories[4].state = State.JOIN
    state.memories[2].state = state_of_tail
    state.memories[2].chosen = int(state.robots[4].identity) if state_of_tail == State.OFFER else 0
    step(state, 100)
    assert tails(state) == 0
    assert (state.memories.role[:3] == [Role.GUARDIAN, Role.LINK, Role.LINK]).all()
    assert (state.memories.established[1:3] == 1).all()


# Queues at guardians.


def follower(guardian_at: float, ahead: float, sensor: int) -> OneRobot:
    """Return a runner with a member on its left, a guardian at some distance and something in front of a sensor."""
    robot = OneRobot().turn_to(State.FOLLOW)
    robot.memory.refuse_until = robot.memory.abstain_until = FOR_EVER
    robot.reading.proximity[sensor] = ahead
    advert = written(identity=60, guardian=1, colour=Colour.BLUE, count=7, in_chain=1, confident=1)
    robot.see((Colour.YELLOW, TABLE.follow_distance, math.pi / 2), (Colour.CYAN, guardian_at, 2.5))
    return robot.hear(advert, guardian_at, 2.5).live()


@pytest.mark.parametrize("sensor", [0, 7])
def test_a_runner_waits_beside_a_guardian_while_something_stands_right_ahead(sensor):
    beside, elsewhere = TABLE.inhibition_clearance - 0.02, TABLE.inhibition_clearance + 0.02
    for guardian_at, ahead, waits in (
        *((beside, TABLE.queue_value + 0.05, True), (beside, TABLE.queue_value - 0.05, False)),
        *((elsewhere, TABLE.queue_value + 0.05, False), (beside, 0.0, False)),
    ):
        robot = follower(guardian_at, ahead, sensor)
        assert robot.memory.state == State.FOLLOW
        assert (robot.motion()[0] < 1e-9) == waits, (guardian_at, ahead)


@pytest.mark.parametrize("sensor", [1, 2, 3, 4, 5, 6])
def test_what_stands_beside_or_behind_a_runner_does_not_make_it_wait(sensor):
    assert follower(TABLE.inhibition_clearance - 0.02, 1.0, sensor).motion()[0] > 0.0


def displacement_by_queue(seed: int, queue_value: float) -> float:
    """Let three runners queue up round a guardian, the first standing against it; return how far it is pushed (m)."""
    state = wide_stage(7, seed, behaviour={"queue_value": queue_value})
    chain(state, 3, TABLE.spacing, established=1)
    apart, round_it, against = 0.08, 0.13, 0.071
    for place_in_queue, i in enumerate((4, 5, 6)):
        away = round_it if place_in_queue else against
        angle = 1.2 - place_in_queue * apart / round_it
        put(state, i, away * math.cos(angle), away * math.sin(angle), angle + math.pi / 2)
        memory = state.memories[i]
        memory.state, memory.refuse_until, memory.abstain_until = State.FOLLOW, FOR_EVER, FOR_EVER
    pushed = 0.0

    def hold_the_first(state):
        state.memories[4].state, state.memories[4].since = State.PAUSE, state.clock[0].cycle

    def measure(state):
        nonlocal pushed
        pushed = max(pushed, math.hypot(state.world.bodies[0].x, state.world.bodies[0].y))

    step(state, 300, hold_the_first, measure)
    return pushed


def test_a_queue_of_runners_does_not_push_a_guardian_out_of_its_place():
    """30 s, less than 1 cm; with runners that never wait the same queue pushes it farther."""
    for seed in range(3):
        assert displacement_by_queue(seed, TABLE.queue_value) < 0.01 < displacement_by_queue(seed, UNREACHABLE)


# Room before the task.


@pytest.mark.parametrize("bearing", range(-90, 91, 30))
def test_who_leaves_an_inhibited_place_turns_away_from_the_task(bearing):
    """TS-106: not at random into the way that it is to clear. Two cycles of turning are 23 degrees."""
    state = wide_stage(2, epuck=QUIET, behaviour={"inhibition_leave": 1.0})
    put(state, 0, 0.0, 0.0)
    guardian(state, 0, Colour.RED, False, 3, in_chain=1)
    put(state, 1, 0.2, 0.0, wrapped(math.pi - math.radians(bearing)))
    state.memories[1].state, state.memories[1].abstain_until = State.FOLLOW, FOR_EVER

    def inhibit(state):
        if state.clock[0].cycle == 2:
            add_packet(state.readings[1], INHIBITION, 0.25, 0.0)

    step(state, 3, inhibit)
    assert state.memories[1].state == State.TURN
    while state.memories[1].state == State.TURN:
        step(state)
    body = state.world.bodies[1]
    assert math.degrees(abs(wrapped(body.heading - math.atan2(body.y, body.x)))) < 23


def test_it_turns_away_from_the_task_that_is_nearest():
    """A booth or a guardian; chain members are no task."""
    for lights, bearing in (
        (((Colour.RED, 0.3, 1.0), (Colour.CYAN, 0.2, -0.5), (Colour.YELLOW, 0.15, 2.0)), -0.5),
        (((Colour.RED, 0.2, 1.0), (Colour.CYAN, 0.3, -0.5), (Colour.MAGENTA, 0.15, 2.0)), 1.0),
    ):
        robot = OneRobot(inhibition_leave=1.0).turn_to(State.FOLLOW)
        robot.memory.abstain_until = FOR_EVER
        robot.see(*lights).hear(INHIBITION).live()
        assert robot.memory.state == State.TURN
        assert robot.memory.turn_left == pytest.approx(wrapped(bearing + math.pi))


def backing_off(*members: tuple[int, float, float]) -> float:
    """Return the forward speed of an inhibited robot that has a guardian right behind it and sees others."""
    robot = OneRobot().turn_to(State.INHIBITED)
    robot.see((Colour.CYAN, TABLE.inhibition_clearance - 0.05, math.pi), *members).hear(INHIBITION).live()
    assert robot.memory.state == State.INHIBITED
    return robot.motion()[0]


@pytest.mark.parametrize("colour", [Colour.YELLOW, Colour.MAGENTA])
@pytest.mark.parametrize("bearing", [0.0, 0.8, -0.8])
def test_an_inhibited_robot_does_not_back_off_into_a_chain_member(colour, bearing):
    assert backing_off((colour, TABLE.member_clearance - 0.005, bearing)) < 1e-9
    assert backing_off((colour, TABLE.member_clearance + 0.005, bearing)) > 0.0


def test_a_member_beside_an_inhibited_robot_does_not_keep_it_from_backing_off():
    assert backing_off((Colour.YELLOW, TABLE.member_clearance - 0.005, math.pi / 2)) > 0.0


# Out of the booth.


@pytest.mark.parametrize("sightings", [1, 5, 15])
def test_who_leaves_a_booth_that_somebody_else_has_entered_knows_how_far_it_is_out(sightings):
    """U26: by the place where it saw the lights last, carried along by the wheel steps."""
    far = 0.2
    behaviour = {"leave_distance": far}
    state = wide_stage(1, setting=0, booth={"exchange_failure": 0.0}, epuck=QUIET, behaviour=behaviour)
    put_before_booth(state, 0, 0, 0.06)
    colour = int(state.booths[0].colour)
    begin_visit(state.memories[0], colour, 0, 0)
    while state.memories[0].state != State.LEAVE:
        step(state)
    lit = 0

    def darken(state):
        nonlocal lit
        reading = state.readings[0]
        lit += bool((reading.blobs["colour"][: reading.blob_count] == colour).any())
        if lit > sightings:
            reading.blob_count = 0

    while state.memories[0].state == State.LEAVE:
        step(state, 1, darken)
    body, booth = state.world.bodies[0], state.booths[0]
    assert lit > sightings
    assert math.hypot(body.x - booth.x, body.y - booth.y) == pytest.approx(far, abs=0.006)


def slip(robot: OneRobot, metres: float) -> None:
    """Let the wheels turn as if the robot had driven on."""
    steps = round(metres / (math.tau * float(EPUCK.wheel_radius)) * float(EPUCK.steps_per_turn))
    robot.reading.left_steps += steps
    robot.reading.right_steps += steps


@pytest.mark.parametrize("lit", [False, True])
def test_a_robot_whose_wheels_slip_in_the_bay_is_still_inside(lit):
    """The lights tell; as long as they stay dark, steps count a quarter, for a blocked robot's wheels slip."""
    robot = OneRobot().turn_to(State.LEAVE)
    robot.memory.colour, robot.memory.exchange = Colour.RED, SUCCESS
    robot.memory.target.known = 0
    a_cycle = 0.004  # m
    patience = TABLE.exit_patience if lit else TABLE.leave_distance / (UNSEEN_STEPS * a_cycle)
    for _ in range(int(0.95 * patience)):
        slip(robot, a_cycle)
        if lit:
            robot.see((Colour.RED, 0.09, math.pi))
        assert robot.live().memory.state == State.LEAVE and robot.motion()[0] > 0.0
    for _ in range(int(0.1 * patience)):
        slip(robot, a_cycle)
        robot.live()
    assert robot.memory.state != State.LEAVE  # it gives up in the end

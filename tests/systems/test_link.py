"""The law of links against the printed formulas (S1.1.2, Fig. S6), and what a link knows and does not know."""

import math

import numpy as np
import pytest

from formicarium.angles import wrapped
from formicarium.control.odometry import place
from formicarium.robots.records import Colour
from formicarium.systems.sequencing.link import alignment_component, distance_component
from formicarium.systems.sequencing.measures import EventKind
from formicarium.systems.sequencing.memory import Role, State
from formicarium.systems.sequencing.parameters import BehaviourTable
from systems.one_robot import OneRobot
from systems.stage import chain, events_of, put, step, wide_stage, written

TABLE = BehaviourTable()


def printed_gamma(alpha: float, beta: float) -> float | None:
    """Return the mean direction as the paper prints it, case by case; None where it is undefined."""
    s = math.sin(alpha) + math.sin(beta)
    c = math.cos(alpha) + math.cos(beta)
    if abs(s) < 1e-12 and abs(c) < 1e-12:
        return None
    if c > 0:
        return math.atan(s / c)
    if c < 0:
        return math.atan(s / c) + math.pi if s >= 0 else math.atan(s / c) - math.pi
    return math.pi / 2 if s > 0 else -math.pi / 2


def expected(following, preceding, spacing):
    """Return the two components and errors of a link with neighbours at (distance, bearing) by section 7."""
    worst = max((preceding, following), key=lambda neighbour: abs(neighbour[0] - spacing))
    sign = 1.0 if worst[0] > spacing else -1.0
    distance = sign * np.array([math.cos(worst[1]), math.sin(worst[1])])
    gamma = printed_gamma(following[1], preceding[1])
    alignment = np.zeros(2) if gamma is None else np.array([math.cos(gamma), math.sin(gamma)])
    between = math.degrees(abs(following[1] - preceding[1])) % 360.0
    askew = abs(180.0 - min(between, 360.0 - between))
    return distance, alignment, worst[0] - spacing, math.radians(askew)


def pairs(count=1000):
    random = np.random.default_rng(7)
    distances = random.uniform(0.03, 0.35, (count, 2))
    bearings = random.uniform(-math.pi, math.pi, (count, 2))
    bearings[::2, 1] = bearings[::2, 0] + math.pi + random.normal(0.0, 0.15, (count + 1) // 2)  # nearly in line
    return [((d, b), (e, wrapped(c))) for (d, e), (b, c) in zip(distances, bearings, strict=True)]


def neighbours(following, preceding):
    robot = OneRobot().lead()
    memory = robot.memory
    memory.role, memory.state = Role.LINK, State.STAY
    place(memory.successor, *following, robot.reading.cycle)
    place(memory.predecessor, *preceding, robot.reading.cycle)
    return memory


def answer(following, preceding, **numbers):
    """Return (forward speed, turn rate) of a link with neighbours at (distance, bearing), through ``decide``."""
    robot = OneRobot(**numbers).lead()
    memory = robot.memory
    memory.role, memory.state = Role.LINK, State.STAY
    place(memory.successor, *following, robot.reading.cycle)
    place(memory.predecessor, *preceding, robot.reading.cycle)
    return robot.live().motion()


def heads_for(motion, direction) -> bool:
    """Tell whether a command drives or turns towards a direction, forwards or backwards, whichever is nearer."""
    forward, turn = motion
    ahead = math.cos(direction)
    error = direction if ahead >= 0 else wrapped(direction + math.pi)
    rate = max(-TABLE.turn_rate, min(TABLE.turn_rate, TABLE.steering_gain * error))
    return (turn == pytest.approx(rate, abs=1e-6) and (forward >= 0) == (ahead >= 0)) or abs(ahead) < 1e-3


def test_both_components_are_the_printed_ones_for_a_thousand_pairs():
    for following, preceding in pairs():
        memory = neighbours(following, preceding)
        distance, alignment, gap, askew = expected(following, preceding, TABLE.spacing)
        assert distance_component(memory.predecessor, memory.successor, TABLE.spacing) == pytest.approx(
            (*distance, gap), abs=1e-9
        )
        assert alignment_component(following[1], preceding[1]) == pytest.approx((*alignment, askew), abs=1e-7)


def test_the_worked_examples():
    """TS-68: 10 and -170 degrees are perfectly aligned; 30 and -170 degrees give 110 degrees."""
    assert alignment_component(math.radians(10), math.radians(-170)) == pytest.approx((0.0, 0.0, 0.0), abs=1e-12)
    x, y, askew = alignment_component(math.radians(30), math.radians(-170))
    assert math.degrees(math.atan2(y, x)) == pytest.approx(110.0)
    assert math.degrees(askew) == pytest.approx(20.0)


@pytest.mark.parametrize("way", [0.0, math.pi / 2, math.pi, -math.pi / 2])
def test_neighbours_on_the_same_side_attract_towards_their_middle(way):
    x, y, askew = alignment_component(wrapped(way + 0.4), wrapped(way - 0.4))
    assert (x, y) == pytest.approx((math.cos(way), math.sin(way)), abs=1e-9)
    assert askew == pytest.approx(math.pi - 0.8)


def test_a_link_in_place_rests():
    for off, bend in ((0.0, 0.0), (0.9, 0.0), (-0.9, 0.9), (0.5, -0.9)):
        distance = TABLE.spacing + off * TABLE.spacing_tolerance
        ahead = (distance, 0.5 + bend * TABLE.alignment_tolerance)
        for separate in (False, True):
            assert answer(ahead, (TABLE.spacing, 0.5 - math.pi), separate_tolerances=separate) == (0.0, 0.0)


@pytest.mark.parametrize("separate", [False, True])
def test_with_both_errors_out_of_tolerance_a_link_moves_by_the_sum_of_both_components(separate):
    tried = 0
    for following, preceding in pairs():
        distance, alignment, gap, askew = expected(following, preceding, TABLE.spacing)
        total = distance + alignment
        if abs(gap) <= TABLE.spacing_tolerance or askew <= TABLE.alignment_tolerance or np.hypot(*total) < 1e-3:
            continue
        tried += 1
        motion = answer(following, preceding, separate_tolerances=separate)
        assert heads_for(motion, math.atan2(total[1], total[0]))
        assert abs(motion[0]) <= TABLE.member_speed + 1e-12
    assert tried > 300


def test_separate_tolerances_mend_only_the_error_that_is_out_of_tolerance():
    tried = set()
    for following, preceding in pairs():
        distance, alignment, gap, askew = expected(following, preceding, TABLE.spacing)
        far, bent = abs(gap) > TABLE.spacing_tolerance, askew > TABLE.alignment_tolerance
        if far == bent:
            continue
        tried.add(far)
        wanted = distance if far else alignment
        motion = answer(following, preceding, separate_tolerances=True)
        assert heads_for(motion, math.atan2(wanted[1], wanted[0]))
    assert tried == {True, False}


def test_in_either_mode_the_movement_lies_between_the_two_components():
    """A link never moves by anything but a mixture of the two: checked where the turn shows the direction."""
    for following, preceding in pairs():
        distance, alignment, gap, askew = expected(following, preceding, TABLE.spacing)
        if abs(gap) <= TABLE.spacing_tolerance and askew <= TABLE.alignment_tolerance:
            continue
        forward, turn = answer(following, preceding)
        error = turn / TABLE.steering_gain
        if abs(turn) > TABLE.turn_rate - 1e-6 or abs(forward) < 1e-4:
            continue  # the turn was cut: the direction does not show
        way = error if forward > 0 else wrapped(error + math.pi)
        direction = np.array([math.cos(way), math.sin(way)])
        shares = np.linalg.lstsq(np.column_stack([distance, alignment]), direction, rcond=None)[0]
        assert (shares > -1e-6).all()


@pytest.mark.parametrize("separate", [False, True])
def test_a_perfectly_aligned_link_with_a_wrong_distance_goes_straight(separate):
    ahead, behind = (TABLE.spacing + 2 * TABLE.spacing_tolerance, 0.0), (TABLE.spacing, math.pi)
    forward, turn = answer(ahead, behind, separate_tolerances=separate)
    assert forward > 0 and turn == pytest.approx(0.0, abs=1e-9)
    forward, _ = answer((TABLE.spacing - 2 * TABLE.spacing_tolerance, 0.0), behind, separate_tolerances=separate)
    assert forward < 0


def established_by(**fields) -> bool:
    robot = OneRobot().lead(branch=1, link_number=3)
    robot.memory.role, robot.memory.state = Role.LINK, State.STAY
    robot.hear(written(identity=99, established=1, **fields)).live()
    return bool(robot.memory.established)


def test_a_link_believes_only_the_guardian_its_branch_reached_or_a_link_of_its_branch():
    """TS-51: the origin guardian of a second branch has EST set too and does not count."""
    assert established_by(guardian=1, branch=2)
    assert established_by(link_number=4, branch=1)
    assert not established_by(guardian=1, branch=1)
    assert not established_by(guardian=1, branch=3)
    assert not established_by(link_number=4, branch=2)


def test_a_link_passes_on_that_the_branch_is_established_and_stops_for_good():
    """TS-70; TS-71."""
    robot = OneRobot().lead(branch=1, link_number=3)
    m = robot.memory
    m.role, m.state = Role.LINK, State.STAY
    robot.hear(written(identity=99, established=1, guardian=1, branch=2)).live()
    place(m.predecessor, 0.3, 2.0, robot.reading.cycle)
    place(m.successor, 0.3, 1.0, robot.reading.cycle)
    for _ in range(50):
        assert robot.live().motion() == (0.0, 0.0)
        assert robot.message().established == 1 and robot.command.colour == Colour.YELLOW


@pytest.fixture
def line():
    """A guardian and six links at rest, exactly in place, not established; noise as it is."""
    state = wide_stage(9, seed=4)
    chain(state, 6, TABLE.spacing)
    put(state, 7, 7 * TABLE.spacing, 0.0)
    memory = state.memories[7]
    memory.role, memory.branch, memory.link_number, memory.established = Role.LINK, 1, 7, 1  # holds the far end
    for k in range(1, 7):  # the end would tell the others that they are established
        state.memories[k].established = 0
    return state


def deaf_to_established(state):
    for k in range(len(state.robots)):
        state.readings[k].packet_count = 0


def moving(state) -> set[int]:
    return {k for k in range(1, 7) if state.commands[k].left != 0.0 or state.commands[k].right != 0.0}


def test_a_straight_chain_rests_under_sensor_noise(line):
    moved = set()
    step(line, 100, deaf_to_established, lambda state: moved.update(moving(state)))
    assert not moved


def test_when_one_link_is_shifted_only_its_neighbours_react(line):
    """T6."""
    step(line, 20, deaf_to_established)
    put(line, 3, 3 * TABLE.spacing, 0.065)
    moved = set()
    step(line, 5, deaf_to_established, lambda state: moved.update(moving(state)))
    assert {2, 4} <= moved <= {2, 3, 4}


def test_a_blinded_link_stops_adjusting(line):
    """T6."""

    def blind(state):
        deaf_to_established(state)
        state.readings[3].blob_count = 0

    lost = line.behaviour[0].track_lost
    step(line, int(lost) + 2, blind)
    put(line, 3, 3 * TABLE.spacing, 0.065)
    where = line.world.bodies[3].x, line.world.bodies[3].y
    step(line, 50, blind, lambda state: not moving(state) & {3} or pytest.fail("a blind link moved"))
    assert (line.world.bodies[3].x, line.world.bodies[3].y) == pytest.approx(where, abs=1e-6)
    step(line, 50, deaf_to_established)
    assert abs(line.world.bodies[3].y) < 0.05  # sees again, and mends


def test_an_established_link_that_is_pushed_away_stays_there_and_it_is_logged():
    """TS-70, T27."""
    state = wide_stage(5)
    chain(state, 4, TABLE.spacing, established=1)
    step(state, 10)
    put(state, 2, 2 * TABLE.spacing, 0.12)
    step(state, 300)
    assert state.world.bodies[2].y == pytest.approx(0.12, abs=1e-6)
    pushed = events_of(state, EventKind.DISPLACED)
    assert pushed["robot"].tolist() == [int(state.robots[2].identity)] and pushed["value"].tolist() == [Role.LINK]

"""How a runner goes round a chain: TS-93 to TS-97, checked with a kinematic unicycle and perfect senses."""

import math

import numpy as np
import pytest

from formicarium.robots.records import Colour
from formicarium.systems.sequencing.following import circle_direction, foot
from formicarium.systems.sequencing.memory import State
from systems.one_robot import EPUCK, OneRobot
from systems.stage import written

CYCLE = 0.1
SPACING = 0.17
MEMBERS = np.array([(k * SPACING, 0.0) for k in range(8)])  # guardian, six links, guardian


def orbit(cycles: int, **numbers) -> np.ndarray:
    """Let one runner follow a straight chain for so many cycles; return its path (cycles, 2)."""
    robot = OneRobot(**numbers).turn_to(State.FOLLOW)
    x, y, heading = 3 * SPACING, -robot.table.follow_distance, 0.0  # below the chain, chain on its left
    path = []
    for _ in range(cycles):
        robot.memory.chain_seen = robot.reading.cycle
        seen = []
        for k, (mx, my) in enumerate(MEMBERS):
            away = math.hypot(mx - x, my - y)
            bearing = math.remainder(math.atan2(my - y, mx - x) - heading, math.tau)
            end = k in (0, len(MEMBERS) - 1)
            if away <= EPUCK.camera_range:
                seen.append((Colour.CYAN if end else Colour.YELLOW, away, bearing))
            if end and away <= EPUCK.radio_range:  # in the chain, and nobody can meet its condition
                fields = dict(identity=200 + k, colour=1 + (k > 0), guardian=1, in_chain=1, count=7, confident=1)
                robot.hear(written(**fields), away, bearing)
        forward, turn = robot.see(*seen).live().motion()
        assert robot.memory.state == State.FOLLOW
        heading += 0.5 * turn * CYCLE
        x, y = x + forward * CYCLE * math.cos(heading), y + forward * CYCLE * math.sin(heading)
        heading += 0.5 * turn * CYCLE
        path.append((x, y))
    return np.array(path)


def away_from_chain(path: np.ndarray) -> np.ndarray:
    """Return the distance of each place to the segment from the first to the last member."""
    along = np.clip(path[:, 0], MEMBERS[0, 0], MEMBERS[-1, 0])
    return np.hypot(path[:, 0] - along, path[:, 1])


def turned(path: np.ndarray) -> float:
    """Return by how many whole turns the path goes round the middle of the chain, positive anticlockwise."""
    angles = np.arctan2(path[:, 1], path[:, 0] - MEMBERS[:, 0].mean())
    return float(np.unwrap(angles)[-1] - angles[0]) / math.tau


@pytest.fixture(scope="module")
def path():
    return orbit(2500)


def test_a_runner_goes_round_the_chain_anticlockwise_again_and_again(path):
    assert turned(path) > 1.5
    assert (np.diff(np.unwrap(np.arctan2(path[:, 1], path[:, 0] - MEMBERS[:, 0].mean()))) > -1e-3).all()


def test_it_keeps_its_distance_to_the_chain(path):
    assert away_from_chain(path).min() > 0.08 and away_from_chain(path).max() < 0.2


def test_it_passes_round_both_ends(path):
    assert path[:, 0].min() < MEMBERS[0, 0] - 0.08 and path[:, 0].max() > MEMBERS[-1, 0] + 0.08


def test_the_chain_is_on_its_left_on_both_sides(path):
    """TS-93: one way on one side, the other way on the other: the two streams do not meet."""
    inner = (path[:-1, 0] > 2 * SPACING) & (path[:-1, 0] < 5 * SPACING)
    below, above = inner & (path[:-1, 1] < 0), inner & (path[:-1, 1] > 0)
    onward = np.diff(path[:, 0])
    assert below.any() and above.any()
    assert (onward[below] > 0).all() and (onward[above] < 0).all()


def test_the_literal_line_of_the_paper_overshoots_the_ends(path):
    """TS-97, C17."""
    literal = orbit(2500, literal_line=True)
    assert away_from_chain(literal).max() > away_from_chain(path).max() + 0.02


def test_the_reference_is_the_foot_of_the_perpendicular_on_the_line_through_two_members():
    random = np.random.default_rng(2)
    for a, b in random.uniform(-0.3, 0.3, (200, 2, 2)):
        literal = np.array(foot(*a, *b, 1))
        assert np.dot(literal, b - a) == pytest.approx(0.0, abs=1e-9)
        assert (literal - a)[0] * (b - a)[1] == pytest.approx((literal - a)[1] * (b - a)[0], abs=1e-9)
        share = np.dot(literal - a, b - a) / np.dot(b - a, b - a)
        clamped = a + min(1.0, max(0.0, share)) * (b - a)
        assert foot(*a, *b, 0) == pytest.approx(tuple(clamped), abs=1e-9)


def test_the_direction_is_radial_and_tangential_with_the_reference_on_the_left():
    """TS-95, TS-96: v = 1.5 clip((d - d0) / d0, -1, 1) u + t."""
    wanted, gain = 0.11, 1.5
    for d in (0.05, 0.11, 0.15, 0.3):
        for bearing in np.linspace(-3.0, 3.0, 13):
            u = np.array([math.cos(bearing), math.sin(bearing)])
            t = np.array([u[1], -u[0]])
            v = gain * np.clip((d - wanted) / wanted, -1, 1) * u + t
            got = np.array(circle_direction(*(d * u), wanted, gain))
            assert got == pytest.approx(v, abs=1e-12)
            assert got[0] * u[1] - got[1] * u[0] > 0  # the reference point is to the left of the motion


def test_a_runner_that_loses_the_chain_goes_on_for_a_while_and_then_walks():
    """U34, TS-104: and its count stays."""
    robot = OneRobot().turn_to(State.FOLLOW)
    robot.memory.count = 2
    robot.memory.chain_seen = robot.reading.cycle
    for _ in range(robot.table.lost_after):
        assert robot.live().memory.state == State.FOLLOW and robot.motion()[0] > 0
    for _ in range(3):
        robot.live()
    assert robot.memory.state in (State.WALK, State.TURN) and robot.memory.count == 2


def test_guardians_without_a_chain_are_not_followed():
    robot = OneRobot(walk_turn_probability=0.0)
    lone = written(identity=200, colour=1, guardian=1, count=7, confident=0)
    for _ in range(5):
        robot.see((Colour.CYAN, 0.2, 0.3)).hear(lone, 0.2, 0.3).live()
        assert robot.memory.state == State.WALK
    robot.see((Colour.CYAN, 0.2, 0.3)).hear(written(identity=200, colour=1, guardian=1, count=7, in_chain=1), 0.2, 0.3)
    assert robot.live().memory.state == State.FOLLOW

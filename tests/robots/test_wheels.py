"""Two wheels: what is commanded, what slips, and what the robot counts."""

import math

import numpy as np
import pytest

from robots.stage import QUIET, Stage

STEP = 2.0 * math.pi * 0.0205 / 1000.0  # m that a wheel's rim runs in one step


def test_without_noise_the_drive_is_that_of_a_differential_drive():
    stage = Stage([(0, 0)], **QUIET)
    assert stage.wheels(0.05, 0.10) == pytest.approx((0.075, 0.05 / 0.053))
    assert stage.wheels(-0.04, 0.04) == pytest.approx((0.0, 0.08 / 0.053))
    assert stage.wheels(0.0, 0.0) == (0.0, 0.0)


def test_wheels_turn_no_faster_than_their_limit():
    stage = Stage([(0, 0)], **QUIET)
    assert stage.wheels(1.0, 1.0) == pytest.approx((0.12, 0.0))
    assert stage.wheels(-1.0, 0.3) == pytest.approx((0.0, 0.24 / 0.053))
    assert stage.wheels(math.inf, math.inf) == pytest.approx((0.12, 0.0))
    assert stage.wheels(-math.inf, -math.inf) == pytest.approx((-0.12, 0.0))


def test_what_is_not_a_number_stands_still():
    stage = Stage([(0, 0)])
    assert stage.wheels(math.nan, math.nan) == (0.0, 0.0)
    assert stage.steps() == (0, 0)
    forward, turning = Stage([(0, 0)], **QUIET).wheels(math.nan, 0.08)
    assert (forward, turning) == pytest.approx((0.04, 0.08 / 0.053))


def test_a_robot_counts_the_steps_its_motors_made():
    stage = Stage([(0, 0)])
    for cycle in range(100):
        stage.wheels(0.03, -0.05, cycle=cycle)
    left, right = stage.steps()
    assert left == math.floor(0.3 / STEP)
    assert right == math.floor(-0.5 / STEP)


def test_steps_add_up_over_cycles_that_each_make_less_than_one():
    stage = Stage([(0, 0)])
    for cycle in range(100):
        stage.wheels(0.0004, 0.0004, cycle=cycle)  # a third of a step in a cycle
    assert stage.steps() == (math.floor(0.004 / STEP),) * 2


def test_a_wheel_that_is_cut_counts_the_steps_it_really_makes():
    stage = Stage([(0, 0)])
    for cycle in range(10):
        stage.wheels(5.0, 5.0, cycle=cycle)
    assert stage.steps() == (math.floor(0.12 / STEP),) * 2


def slips(stage, cycles=6000, speed=0.08):
    """Return the relative slip of the left and the right wheel in many cycles."""
    drives = np.array([stage.wheels(speed, speed, cycle=cycle) for cycle in range(cycles)])
    half = 0.5 * 0.053 * drives[:, 1]
    return np.array([drives[:, 0] - half, drives[:, 0] + half]) / speed - 1.0


def test_each_wheel_slips_by_five_per_cent_on_its_own():
    left, right = slips(Stage([(0, 0)]))
    for wheel in (left, right):
        assert wheel.mean() == pytest.approx(0.0, abs=4 * 0.05 / math.sqrt(6000))
        assert wheel.std() == pytest.approx(0.05, rel=0.04)
    assert abs(np.corrcoef(left, right)[0, 1]) < 4 / math.sqrt(6000)
    assert abs(np.corrcoef(left[1:], left[:-1])[0, 1]) < 4 / math.sqrt(6000)


def test_a_wheel_that_stands_does_not_slip():
    stage = Stage([(0, 0)])
    assert {stage.wheels(0.0, 0.0, cycle=cycle) for cycle in range(50)} == {(0.0, 0.0)}

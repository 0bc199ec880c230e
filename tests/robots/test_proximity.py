"""Proximity sensors: the response of the real robot's, and a wall that is touched is seen."""

import math

import numpy as np
import pytest

from formicarium.physics.world import chain
from formicarium.robots.epuck import PROXIMITY_ANGLES
from robots.stage import QUIET, Stage

# docs/choices.md: gap between body and wall (mm), value of the sensor that faces it; contact reads 1 here.
TABLE = [(0.0, 1.0), (1.5, 1.0), (5.0, 0.939), (10.0, 0.774), (20.0, 0.489), (30.0, 0.263), (40.0, 0.097), (60.0, 0.0)]


def facing_wall(gap, sensor=0, **epuck):
    """Return the values of a robot one of whose sensors points straight at a wall, ``gap`` m from its body."""
    x = 0.035 + gap
    stage = Stage([(0, 0)], -PROXIMITY_ANGLES[sensor], chain([(x, -2), (x, 2)]), **(QUIET | epuck))
    return stage.feel()


@pytest.mark.parametrize("gap, value", TABLE)
def test_a_wall_reads_as_measured(gap, value):
    # The reference's rays start 1 mm outside the body.
    assert facing_wall(gap / 1000.0, proximity_start=0.036)[0] == pytest.approx(value, abs=6e-4)


@pytest.mark.parametrize("sensor", range(8))
def test_every_sensor_answers_to_what_is_in_its_own_direction(sensor):
    d = 0.013
    values = facing_wall(d, sensor)
    assert values[sensor] == pytest.approx(298.701 * d * d - 36.8961 * d + 1.08212)
    assert values[sensor] == values.max()


def test_a_robot_that_touches_or_presses_into_a_wall_is_not_blind():
    assert facing_wall(0.0)[0] == 1.0
    assert facing_wall(-0.0005)[0] == 1.0


def test_a_robot_reads_like_a_wall_at_the_same_distance():
    gap = 0.02
    stage = Stage([(0, 0), (0.07 + gap, 0)], [-PROXIMITY_ANGLES[7], 0.0], **QUIET)
    assert stage.feel()[7] == pytest.approx(facing_wall(gap, 7)[7])


def test_nothing_reads_zero_and_noise_is_cut_at_zero_and_one():
    far = Stage([(0, 0)])
    values = np.array([far.feel(cycle=cycle) for cycle in range(500)])
    assert values.min() == 0.0 and 0.04 < values.max() <= 0.05
    assert np.mean(values == 0.0) == pytest.approx(0.5, abs=0.04)
    assert Stage([(0, 0)], **QUIET).feel().tolist() == [0.0] * 8


def test_noise_is_uniform_within_five_hundredths():
    stage = Stage([(0, 0)], -PROXIMITY_ANGLES[0], chain([(0.055, -2), (0.055, 2)]))
    values = np.array([stage.feel(cycle=cycle)[0] for cycle in range(4000)]) - facing_wall(0.02)[0]
    assert -0.05 <= values.min() < -0.0495 and 0.0495 < values.max() <= 0.05
    assert values.mean() == pytest.approx(0.0, abs=4 * 0.05 / math.sqrt(3 * 4000))
    assert values.std() == pytest.approx(0.05 / math.sqrt(3), rel=0.03)

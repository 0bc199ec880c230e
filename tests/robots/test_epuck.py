"""The e-puck's table: noise is on unless somebody turns it off (TS-12 to TS-19)."""

import math

import numpy as np
import pytest
from pydantic import ValidationError

from formicarium.robots.epuck import PROXIMITY_ANGLES, Epuck
from formicarium.robots.records import COMMAND, PACKET, READING


def test_noise_is_on_by_default():
    epuck = Epuck()
    assert epuck.wheel_noise == 0.05
    assert epuck.proximity_noise == 0.05
    assert epuck.camera_distance_noise == 0.013
    assert epuck.camera_bearing_noise == pytest.approx(math.radians(2.0))
    assert epuck.camera_miss == 0.05
    assert epuck.radio_distance_noise == 0.25
    assert epuck.radio_distance_noise_floor == 0.03
    assert epuck.radio_bearing_noise == pytest.approx(math.radians(8.0))
    assert epuck.radio_capacity == 5
    assert epuck.radio_loss == 0.05


def test_body_and_ranges_are_those_of_the_robot():
    epuck = Epuck()
    assert (epuck.radius, epuck.wheel_distance, epuck.wheel_radius) == (0.035, 0.053, 0.0205)
    assert (epuck.proximity_reach, epuck.radio_range) == (0.05, 0.8)
    assert epuck.camera_range == pytest.approx(0.122 * math.tan(math.radians(70.0)), abs=0.004)


def test_proximity_sensors_stand_as_on_the_robot_and_left_mirrors_right():
    degrees = np.degrees(PROXIMITY_ANGLES)
    assert sorted(np.round(np.abs(degrees))) == [17, 17, 50, 50, 90, 90, 150, 150]
    assert np.allclose(degrees, -degrees[::-1])


def test_a_packet_is_four_bytes_and_there_are_twelve_emitters():
    assert PACKET["payload"].itemsize == 4 and PACKET["payload"].base == np.uint8
    assert COMMAND["payload"].shape == (12, 4) and COMMAND["payload"].base == np.uint8
    assert COMMAND["enabled"].shape == (12,)


def test_nothing_but_the_listed_inputs_and_outputs_crosses_the_boundary():
    own = {"identity", "cycle"}
    sensed = {"proximity", "blob_count", "blobs", "packet_count", "packets", "infrared", "left_steps", "right_steps"}
    assert set(READING.names) == own | sensed
    assert set(READING["blobs"].base.names) == {"colour", "distance", "bearing"}
    assert set(READING["packets"].base.names) == {"payload", "distance", "bearing"}
    assert set(COMMAND.names) == {"left", "right", "colour", "enabled", "payload", "infrared"}


@pytest.mark.parametrize("wrong", [{"radius": 0.0}, {"radio_loss": 1.5}, {"radio_capacity": 11}, {"wheel_noice": 0.1}])
def test_impossible_robots_are_refused(wrong):
    with pytest.raises(ValidationError, match=next(iter(wrong))):
        Epuck(**wrong)

"""The forward camera, the ground sensors and the light sensors, against geometry worked by hand."""

import math

import numpy as np
import pytest

from formicarium.physics.floor import patches
from formicarium.physics.grid import find_neighbours
from formicarium.physics.records import records
from formicarium.physics.world import make_bodies, make_world
from formicarium.robots.epuck import PROXIMITY_ANGLES, EpuckSight
from formicarium.robots.forager import LAMP, NICHE_LIGHT, READING
from formicarium.robots.records import Colour
from formicarium.robots.simulated.forward_camera import sense_sights
from formicarium.robots.simulated.ground import sense_ground
from formicarium.robots.simulated.light import sense_light

QUIET = {"distance_noise": 0.0, "bearing_noise": 0.0, "ground_noise": 0.0, "light_noise": 0.0}
SENSORS = EpuckSight(**QUIET).record()[0]
MOMENT = np.uint64(7)


def seen(places, heading, colour=Colour.BLUE, depth=0.092):
    """Return what a robot at the first place sees of a light at the bottom of a niche that opens to -x."""
    bodies = make_bodies(len(places), radius=0.035, mass=0.4, inertia=1e-3, heading=heading)
    bodies.x, bodies.y = np.array(places, float).T
    world = make_world(bodies, reach=1.0)
    find_neighbours(world)
    lights = records(NICHE_LIGHT, 1)
    lights[0].cosine, lights[0].depth, lights[0].half_width, lights[0].colour = 1.0, depth, 0.05, colour
    reading = records(READING, 1)[0]
    sense_sights(world, 0, lights, SENSORS, MOMENT, reading)
    return [(int(b.colour), float(b.distance), float(b.bearing)) for b in reading.blobs[: reading.blob_count]]


def test_a_light_straight_ahead_has_colour_distance_and_bearing():
    ((colour, distance, bearing),) = seen([(-0.4, 0.05)], 0.0)
    assert colour == Colour.BLUE
    assert distance == pytest.approx(math.hypot(0.4, 0.05))
    assert bearing == pytest.approx(math.atan2(-0.05, 0.4))


@pytest.mark.parametrize(
    ("place", "heading", "colour", "why"),
    [
        ((-0.4, 0.0), 0.6, Colour.BLUE, "beside the field of view"),
        ((-0.4, 0.0), math.pi, Colour.BLUE, "behind"),
        ((-1.1, 0.0), 0.0, Colour.BLUE, "out of range"),
        ((-0.3, 0.17), -0.5, Colour.BLUE, "hidden by the niche's wall"),
        ((-0.4, 0.0), 0.0, Colour.OFF, "dark"),
    ],
)
def test_what_is_not_seen(place, heading, colour, why):
    assert seen([place], heading, colour) == [], why


def test_a_robot_in_between_hides_the_light_and_one_beside_does_not():
    assert seen([(-0.4, 0.0), (-0.2, 0.03)], 0.0) == []
    assert len(seen([(-0.4, 0.0), (-0.2, 0.04)], 0.0)) == 1


def test_inside_the_niche_the_light_is_right_ahead():
    assert len(seen([(-0.05, 0.01)], 0.1)) == 1


def test_the_ground_sensors_sit_ahead_of_the_axis_left_middle_and_right():
    body = make_bodies(1, radius=0.035, mass=0.4, inertia=1e-3, x=0.0, y=0.0, heading=math.pi / 2)[0]
    floor = patches([(-1.0, 0.0, 1.0, 1.0, 0.5), (-1.0, 0.0, -0.005, 1.0, 0.8), (-1.0, -1.0, 1.0, 0.0, 0.2)])
    reading = records(READING, 1)[0]
    sense_ground(body, floor, SENSORS, MOMENT, reading)
    assert reading.ground.tolist() == [0.8, 0.5, 0.5]


def test_light_falls_with_distance_and_with_the_angle_of_the_sensor():
    body = make_bodies(1, radius=0.035, mass=0.4, inertia=1e-3, x=0.0, y=0.0, heading=0.3)[0]
    lamp = records(LAMP, 1)[0]
    lamp.x, lamp.y, lamp.intensity = 0.0, -2.0, 5.0
    reading = records(READING, 1)[0]
    sense_light(body, lamp, SENSORS, MOMENT, reading)
    away = np.abs((PROXIMITY_ANGLES + 0.3 + math.pi / 2 + math.pi) % (2 * math.pi) - math.pi)
    assert reading.light == pytest.approx(math.exp(-0.8) * np.maximum(0.0, 1.0 - 2.0 * away / math.pi))

"""Crowds: many discs press and nobody is squeezed into another or through a wall."""

import math

import numpy as np
import pytest

from formicarium.physics.world import make_world, outline, polygon_walls, regular_polygon
from physics.flat_scenes import discs, hexagon, overlaps, places, run

NORMALS = np.array([(math.cos(angle), math.sin(angle)) for angle in np.radians(range(30, 390, 60))])


def beyond_walls(world, side):
    """Return how deep (m) any disc is in a wall of a hexagon, negative if none touches one."""
    return (places(world) @ NORMALS.T).max() + world.bodies.radius.max() - side * math.sqrt(0.75)


def test_a_packed_crowd_stays_apart_and_inside():
    """40 driven discs fill half the area of a hexagon of 0.34 m; each drives into whatever is in its way."""
    world = hexagon(40, 0.34)
    bodies, random = world.bodies, np.random.default_rng(2)
    for _ in range(600):
        bodies.turning[:] = np.where(random.random(40) < 0.05, random.uniform(-3, 3, 40), bodies.turning)
        run(world, 0.1)
        assert overlaps(world) < 0.002
        assert beyond_walls(world, 0.34) < 0.002


def test_forty_discs_pressing_on_one_spot_stay_apart():
    world = hexagon(40, 0.9)
    for _ in range(100):
        world.bodies.heading[:] = np.arctan2(-world.bodies.y, -world.bodies.x)
        run(world, 0.1)
    assert overlaps(run(world, 1.0)) < 0.002


def test_the_fastest_disc_does_not_tunnel():
    walls = polygon_walls(regular_polygon(6, 0.5))
    headings = np.linspace(-3, 3, 12)
    spots = 0.2 * np.stack([np.cos(headings), np.sin(headings)], axis=1)
    world = make_world(discs(spots, headings, 0.6), walls)
    for _ in range(50):
        assert beyond_walls(run(world, 0.1), 0.5) < 0.003


def test_discs_piled_on_one_place_come_apart():
    random = np.random.default_rng(5)
    spots = random.uniform(-0.02, 0.02, (12, 2))
    world = make_world(discs(spots), outline(regular_polygon(6, 0.5)))
    assert overlaps(world) > 0.06
    assert overlaps(run(world, 20)) < 0.0005
    assert beyond_walls(world, 0.5) < 0.0005


def test_two_discs_on_the_very_same_place_come_apart():
    assert overlaps(run(make_world(discs([(0, 0), (0, 0)])), 5)) < 0.0005


@pytest.mark.parametrize("seed", [1, 2, 3])
def test_discs_of_different_sizes_and_weights_do_not_mix(seed):
    random = np.random.default_rng(seed)
    spots = [(x, y) for x in np.linspace(-0.3, 0.3, 5) for y in np.linspace(-0.3, 0.3, 5)]
    bodies = discs(spots, random.uniform(-3, 3, 25), 0.1, radius=random.uniform(0.02, 0.07, 25))
    bodies.mass = random.uniform(0.1, 1.0, 25)
    world = make_world(bodies, polygon_walls(regular_polygon(6, 0.6)))
    assert overlaps(run(world, 10)) < 0.002

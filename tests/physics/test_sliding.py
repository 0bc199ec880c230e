"""Discs that drive against each other slide on, nobody who stands is pushed, nobody gets farther than it drives."""

import math

import numpy as np
import pytest

from formicarium.physics.grid import find_neighbours
from formicarium.physics.sliding import TOLERANCE, drift, slide
from formicarium.physics.world import make_bodies, make_world

RADIUS = 0.085
SPEED = 0.15
FIELDS = {"radius": RADIUS, "mass": 1.6, "inertia": 0.006, "force_limit": 1.5, "torque_limit": 1.5}


def world_of(places, **fields):
    x, y, heading = np.array(places, float).T
    return make_world(make_bodies(len(places), x=x, y=y, heading=heading, **(FIELDS | fields)))


def run(world, cycles, advance=slide):
    for _ in range(cycles):
        advance(world)
        find_neighbours(world)


def deepest(bodies):
    gaps = np.hypot(*(np.subtract.outer(v, v) for v in (bodies.x, bodies.y))) + 10.0 * np.eye(len(bodies))
    return 2.0 * RADIUS - gaps.min()


def test_a_pair_that_overlaps_by_a_fraction_of_a_millimetre_slides_on():
    """What held two spiralling robots for the rest of a trial: 0.496 mm, one heads at the other, which drives along."""
    world = world_of([(0.0, 0.0, math.radians(80.0)), (2 * RADIUS - 0.000496, 0.0, math.radians(176.0))], forward=SPEED)
    run(world, 20)
    assert math.hypot(world.bodies.x[0], world.bodies.y[0]) > 0.15
    assert deepest(world.bodies) <= TOLERANCE


def test_head_on_a_small_offset_is_enough_to_pass():
    world = world_of([(0.0, 0.0, 0.0), (0.5, 0.005, math.pi)], forward=SPEED)
    run(world, 150)
    assert world.bodies.x[0] > 0.5 and world.bodies.x[1] < 0.0


def test_who_stands_is_not_pushed():
    """Not even by many, and not when overlap is there from the start."""
    ring = [(2.0 * RADIUS * math.cos(a), 2.0 * RADIUS * math.sin(a), a + math.pi) for a in np.arange(0.0, 6.2, 1.06)]
    world = world_of([(0.0, 0.0, 0.0), *((0.998 * x, 0.998 * y, a) for x, y, a in ring)])
    world.bodies.forward[1:] = SPEED
    run(world, 50)
    assert (world.bodies.x[0], world.bodies.y[0]) == (0.0, 0.0)
    assert deepest(world.bodies) <= TOLERANCE + 1e-9


@pytest.mark.parametrize("advance", [slide, drift])
def test_a_jam_keeps_its_limits_and_does_not_freeze(advance):
    """Forty robots that all want to the middle, and then out of it again."""
    draws = np.random.default_rng(4)
    places = [(0.2 * (k % 7) - 0.6, 0.2 * (k // 7) - 0.6, 0.0) for k in range(40)]
    world = world_of(places)
    for cycle in range(300):
        bodies = world.bodies
        way = np.arctan2(-bodies.y, -bodies.x) + (math.pi if cycle > 200 else 0.0) + draws.uniform(-0.1, 0.1, 40)
        bodies.heading, bodies.forward = way, SPEED
        bodies.speed_x, bodies.speed_y = SPEED * np.cos(way), SPEED * np.sin(way)
        before = bodies.copy()
        run(world, 1, advance)
        assert np.hypot(bodies.x - before.x, bodies.y - before.y).max() <= 0.1 * SPEED + 1e-12
        assert deepest(bodies) <= TOLERANCE + 1e-9
    assert np.hypot(world.bodies.x, world.bodies.y).min() > 0.5


def test_order_in_memory_does_not_matter():
    draws = np.random.default_rng(5)
    places = [(0.18 * (k % 5), 0.18 * (k // 5), draws.uniform(-3, 3)) for k in range(25)]
    worlds = []
    for order in (np.arange(25), draws.permutation(25)):
        bodies = make_bodies(25, **FIELDS, forward=SPEED)
        for name, column in zip(("x", "y", "heading"), np.array(places).T, strict=True):
            bodies[name] = column
        world = make_world(bodies[order])
        run(world, 60)
        worlds.append(world.bodies[np.argsort(world.bodies.key)])
    for name in ("x", "y", "heading"):
        assert np.array_equal(worlds[0][name], worlds[1][name])

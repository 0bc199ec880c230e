"""Motion without forces: exact arcs, sliding, and nobody is pushed (TP-65)."""

import math

import numpy as np
import pytest

from formicarium.physics.grid import find_neighbours
from formicarium.physics.kinematics import TOLERANCE, glide
from formicarium.physics.world import box, make_bodies, make_world

RADIUS = 0.035


def world_of(places, segments=None, **fields):
    x, y, heading = np.array(places, float).T
    defaults = {"radius": RADIUS, "mass": 0.4, "inertia": 1e-3, "force_limit": 1.5, "torque_limit": 1.5}
    return make_world(make_bodies(len(places), x=x, y=y, heading=heading, **(defaults | fields)), segments)


def run(world, cycles):
    for _ in range(cycles):
        glide(world)
        find_neighbours(world)


@pytest.mark.parametrize("turning", [0.0, 0.3, -1.32])
def test_a_free_robot_drives_the_exact_arc(turning):
    world = world_of([(0.0, 0.0, 0.4)], forward=0.035, turning=turning)
    run(world, 50)
    body, angle = world.bodies[0], turning * 5.0
    along = 5.0 * 0.035 * (math.sin(0.5 * angle) / (0.5 * angle) if angle else 1.0)
    assert body.x == pytest.approx(along * math.cos(0.4 + 0.5 * angle), abs=1e-9)
    assert body.y == pytest.approx(along * math.sin(0.4 + 0.5 * angle), abs=1e-9)
    assert body.heading == pytest.approx(0.4 + angle)


def test_against_a_wall_it_keeps_the_part_of_its_motion_that_runs_along():
    world = world_of([(0.0, 0.0, math.pi / 4)], box(0.06, 0.0, 0.0, 0.04, 4.0), forward=0.035)
    run(world, 200)
    body = world.bodies[0]
    assert body.x == pytest.approx(0.04 - RADIUS, abs=1e-6)
    assert body.y == pytest.approx(20.0 * 0.035 * math.sqrt(0.5), rel=0.01)


def test_nobody_is_pushed():
    world = world_of([(0.0, 0.0, 0.0), (0.1, 0.0, 0.0)], forward=np.array([0.035, 0.0]))
    run(world, 100)
    assert world.bodies[1].x == 0.1
    assert world.bodies[0].x == pytest.approx(0.1 - 2 * RADIUS, abs=1e-6)


def test_head_on_both_stop_half_way():
    world = world_of([(0.0, 0.0, 0.0), (0.2, 0.0, math.pi)], forward=0.035)
    run(world, 100)
    assert world.bodies.x == pytest.approx([0.1 - RADIUS, 0.1 + RADIUS], abs=1e-6)


@pytest.mark.parametrize("key", [0, 1])
def test_a_small_robot_and_a_large_one_meet_without_overlap(key):
    """Centres further apart than three radii of the small one, and within reach of each other in one cycle."""
    world = world_of([(0.0, 0.0, 0.0), (0.056, 0.0, math.pi)], forward=0.1, radius=[0.01, 0.04], key=[key, 1 - key])
    run(world, 1)
    assert world.bodies[1].x - world.bodies[0].x >= 0.05 - TOLERANCE


def test_a_crowd_in_a_box_never_overlaps_by_more_than_half_a_millimetre():
    draws = np.random.default_rng(3)
    grid = [(0.09 * i, 0.09 * j, draws.uniform(-3, 3)) for i in range(6) for j in range(6)]
    walls = np.concatenate([box(0.225, y, 0.0, 0.6, 0.02) for y in (-0.06, 0.51)])
    walls = np.concatenate([walls, *(box(x, 0.225, 0.0, 0.02, 0.6) for x in (-0.06, 0.51))])
    walls["group"] = 0
    world = world_of(grid, walls.view(np.recarray), forward=0.035)
    for _ in range(600):
        world.bodies.turning[:] = draws.uniform(-1.3, 1.3, len(grid))
        run(world, 1)
        bodies = world.bodies
        gaps = np.hypot(*(np.subtract.outer(v, v) for v in (bodies.x, bodies.y))) + np.eye(len(grid))
        assert gaps.min() > 2 * RADIUS - TOLERANCE - 1e-9
        assert min(bodies.x.min(), bodies.y.min()) > -0.05 + RADIUS - TOLERANCE - 1e-9
        assert max(bodies.x.max(), bodies.y.max()) < 0.50 - RADIUS + TOLERANCE + 1e-9

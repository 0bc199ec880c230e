"""The same world, stored, placed, run or watched differently, goes the same way."""

import math
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from formicarium.physics.rays import bodies_in_line_of_sight, cast, look_round
from formicarium.physics.records import BODY
from formicarium.physics.world import box, joined, make_world, outline, polygon_walls, regular_polygon
from physics.flat_scenes import discs, hexagon, places, run

FIELDS = ("x", "y", "heading", "speed_x", "speed_y", "turn_rate")


def scene(turn=0.0, shift=(0.0, 0.0)):
    """Return 14 driven discs, some touching, round a box in a hexagon, all turned and shifted."""
    random = np.random.default_rng(3)
    spots = np.array([(x, y) for x in (-0.14, -0.071, 0.072, 0.141) for y in (-0.1, -0.031, 0.038, 0.11)])[:14]
    turned = np.array([[math.cos(turn), math.sin(turn)], [-math.sin(turn), math.cos(turn)]])
    bodies = discs(spots @ turned + shift, random.uniform(-3, 3, 14) + turn, 0.1, turning=random.uniform(-1, 1, 14))
    corners = np.array(regular_polygon(6, 0.25)) @ turned + shift
    block = box(*(np.array([0.0, 0.05]) @ turned + shift), 0.4 + turn, 0.04, 0.06)
    return bodies, joined(outline(corners), block)


def test_storage_order_does_not_matter():
    bodies, segments = scene()
    order = np.random.default_rng(4).permutation(len(bodies))
    straight, mixed = run(make_world(bodies, segments), 20), run(make_world(bodies[order], segments), 20)
    for name in FIELDS:
        assert mixed.bodies[name].tolist() == straight.bodies[name][order].tolist()


def test_a_turned_and_shifted_world_takes_a_turned_and_shifted_step():
    turn, shift = 0.7, np.array([1.3, -0.4])
    plain, moved = (run(make_world(*scene(*how)), 0.1) for how in ((), (turn, shift)))
    turned = np.array([[math.cos(turn), math.sin(turn)], [-math.sin(turn), math.cos(turn)]])
    assert places(moved) == pytest.approx(places(plain) @ turned + shift, abs=1e-9)
    assert moved.bodies.heading == pytest.approx(plain.bodies.heading + turn, abs=1e-9)


def test_a_copy_of_the_bodies_is_a_snapshot():
    bodies, segments = scene()
    first = run(make_world(bodies, segments), 3)
    second = run(make_world(first.bodies, segments), 3)
    assert second.bodies.tobytes() == run(first, 3).bodies.tobytes()


def test_looking_changes_nothing():
    watched, unwatched = hexagon(12, 0.3), hexagon(12, 0.3)
    for _ in range(30):
        for i in range(12):
            cast(watched, i, 0.036, 0.05, np.ones(1), np.zeros(1), np.zeros(1))
            look_round(watched, i)
            for k in range(watched.neighbour_count[i]):
                bodies_in_line_of_sight(watched, i, k)
        run(watched, 0.1)
    assert watched.bodies.tobytes() == run(unwatched, 3).bodies.tobytes()


def a_crowds_story():
    """Run a crowd and return all it did and saw, as bytes in hexadecimal."""
    world = make_world(*scene())
    story, distances, angles = [], np.zeros(8), np.radians(11.25 + 45 * np.arange(8))
    for _ in range(10):
        run(world, 0.1)
        story.append(np.ascontiguousarray(world.bodies).tobytes())
        for i in range(len(world.bodies)):
            cast(world, i, 0.036, 0.05, np.cos(angles), np.sin(angles), distances)
            story.append(distances.tobytes())
            count = int(world.neighbour_count[i])
            look_round(world, i)
            story.append(bytes([bodies_in_line_of_sight(world, i, k) for k in range(count)]))
    return b"".join(story).hex()


def test_compiled_and_interpreted_runs_agree_to_the_last_bit():
    program = (
        "import sys; sys.path.insert(0, sys.argv[1]);"
        "from physics.test_sameness import a_crowds_story; print(a_crowds_story())"
    )
    done = subprocess.run(
        [sys.executable, "-c", program, str(Path(__file__).parents[1])],
        env=os.environ | {"FORMICARIUM_INTERPRETED": "1"}, capture_output=True, text=True, check=True,
    )  # fmt: skip
    compiled = a_crowds_story()
    assert len(compiled) > 2 * 10 * 14 * BODY.itemsize
    assert done.stdout.strip() == compiled


def test_gaps_leave_the_rest_of_the_wall():
    walls = polygon_walls([(0, 0), (2, 0), (2, 1), (0, 1)], gaps=[(0, 0.5, 0.7)])
    assert np.hypot(walls.bx - walls.ax, walls.by - walls.ay).sum() == pytest.approx(6 - 0.2)

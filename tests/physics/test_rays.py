"""Beams and lines of sight, against walking along them in small steps."""

import math

import numpy as np
import pytest

from formicarium.physics.rays import bodies_in_line_of_sight, cast, look_round, open_line
from formicarium.physics.world import box, chain, joined, make_world, outline, polygon_walls, regular_polygon
from physics.flat_scenes import discs

ANGLES = np.radians(11.25 + 45.0 * np.arange(8))
COSINES, SINES = np.cos(ANGLES), np.sin(ANGLES)


def beams(world, i=0, start=0.036, reach=0.05):
    distances = np.full(8, np.nan)
    cast(world, i, start, reach, COSINES, SINES, distances)
    return distances


def crowded(seed, count=30):
    """Return many discs and booths in a small hexagon; discs may overlap nothing."""
    random = np.random.default_rng(seed)
    walls = polygon_walls(regular_polygon(6, 0.5), tall=bool(seed % 2))
    booths = [box(*random.uniform(-0.3, 0.3, 2), random.uniform(-3, 3), 0.12, 0.03, group=k) for k in (1, 2, 3)]
    middles = [(b.ax.mean(), b.ay.mean()) for b in booths]
    spots = []
    for spot in random.uniform(-0.38, 0.38, (4000, 2)):
        free = all(math.dist(spot, other) > 0.072 for other in spots)
        if free and all(math.dist(spot, middle) > 0.1 for middle in middles) and len(spots) < count:
            spots.append(spot)
    bodies = discs(spots, random.uniform(-3, 3, len(spots)))
    return make_world(bodies, joined(walls, *booths))


def free_way(world, i, angle, start, reach, step=2e-5):
    """Walk along a beam until a place is inside a disc or behind a face; return the way (m)."""
    body = world.bodies[i]
    direction = np.array([math.cos(body.heading + angle), math.sin(body.heading + angle)])
    way = np.arange(0.0, reach, step)
    spots = np.array([body.x, body.y]) + (start + way)[:, None] * direction
    stopped = np.zeros(len(way), bool)
    for j, other in enumerate(world.bodies):
        if j != i:
            stopped |= np.hypot(*(spots - (other.x, other.y)).T) < other.radius
    for face in world.segments:
        a, along = np.array([face.ax, face.ay]), np.array([face.bx - face.ax, face.by - face.ay])
        side = along[0] * (spots[:, 1] - a[1]) - along[1] * (spots[:, 0] - a[0])
        own = along[0] * (body.y - a[1]) - along[1] * (body.x - a[0])
        # The face is passed where the side changes, if the line from the centre meets it between its ends.
        changed = np.flatnonzero(np.sign(side) != np.sign(own))
        if len(changed):
            place = (spots[changed[0]] - a) @ along / (along @ along)
            if 0.0 <= place <= 1.0:
                stopped[changed[0] :] = True
    return way[np.argmax(stopped)] if stopped.any() else reach


@pytest.mark.parametrize("seed", range(4))
def test_a_beam_goes_as_far_as_one_can_walk(seed):
    world = crowded(seed)
    hits = 0
    for i in range(len(world.bodies)):
        walked = [free_way(world, i, angle, 0.036, 0.05) for angle in ANGLES]
        hits += np.sum(np.array(walked) < 0.05)
        assert beams(world, i) == pytest.approx(walked, abs=1e-4)
    assert hits > 20


def test_a_beam_meets_a_disc_and_a_wall_where_geometry_says():
    world = make_world(discs([(0, 0), (0.1, 0)], -ANGLES[0]), chain([(-0.08, -1), (-0.08, 1)]))
    angles = ANGLES - ANGLES[0]
    expected = np.full(8, 0.05)
    expected[0] = 0.1 - 0.035 - 0.036
    expected[4] = 0.08 - 0.036
    assert math.cos(angles[4]) == pytest.approx(-1.0)
    assert beams(world) == pytest.approx(expected, abs=1e-12)


def test_a_beam_that_starts_inside_something_gets_nowhere():
    world = make_world(discs([(0, 0), (0.0705, 0)], -ANGLES[0]), chain([(-0.0355, -1), (-0.0355, 1)]))
    assert beams(world)[[0, 4]].tolist() == [0.0, 0.0]


def brute_sight(world, i, j):
    """Tell whether the line between two centres is free, by a thousand places on it."""
    a, b = (np.array([world.bodies.x[k], world.bodies.y[k]]) for k in (i, j))
    line = a + np.linspace(0, 1, 1001)[:, None] * (b - a)
    for k, other in enumerate(world.bodies):
        if k not in (i, j) and np.hypot(*(line - (other.x, other.y)).T).min() < other.radius:
            return False
    return brute_open(world, a, b)


def brute_open(world, a, b):
    for face in world.segments:
        c, d = np.array([face.ax, face.ay]), np.array([face.bx, face.by])
        matrix = np.array([b - a, c - d]).T
        if face.tall and abs(np.linalg.det(matrix)) > 1e-12:
            places = np.linalg.solve(matrix, c - a)
            if (places >= 0).all() and (places <= 1).all():
                return False
    return True


@pytest.mark.parametrize("seed", range(6))
def test_lines_of_sight_are_those_that_nothing_crosses(seed):
    world = crowded(seed, count=[8, 16, 30][seed % 3])
    seen, unlike = [], 0
    for i in range(len(world.bodies)):
        look_round(world, i)
        for k in range(world.neighbour_count[i]):
            answer = bodies_in_line_of_sight(world, i, k)
            seen.append(answer)
            unlike += answer != brute_sight(world, i, world.neighbours.index[i, k])
    assert 10 < sum(seen) < len(seen) - 10
    assert unlike <= 0.002 * len(seen)  # a thousand places miss a line that only just grazes a disc


def test_low_walls_and_low_boxes_hide_nothing():
    low = joined(chain([(0.2, -1), (0.2, 1)], tall=False), box(0.3, 0, 0, 0.05, 0.05, tall=False, group=1))
    world = make_world(discs([(0, 0)]), low)
    assert open_line(world, 0, 0, 0.5, 0)
    tall = make_world(discs([(0, 0)]), joined(chain([(0.2, -1), (0.2, 1)], tall=True)))
    assert not open_line(tall, 0, 0, 0.5, 0)
    assert open_line(tall, 0, 0, 0.1, 0)


def test_a_booth_hides_what_is_behind_it_only():
    world = make_world(discs([(0, 0)]), outline([(0.2, -0.1), (0.3, -0.1), (0.3, 0.1), (0.2, 0.1)], tall=True, group=1))
    assert not open_line(world, 0, 0, 0.5, 0)
    assert open_line(world, 0, 0, 0.19, 0)
    assert open_line(world, 0, 0.11, 0.5, 0.11)


def test_a_gap_in_a_wall_is_open():
    square = [(0, 0), (1, 0), (1, 1), (0, 1)]
    walls = polygon_walls(square, gaps=[(1, 0.4, 0.6), (1, 0.8, 1.0)], tall=True)
    assert len(walls) == 5
    world = make_world(discs([(0.5, 0.5)]), walls)
    assert open_line(world, 0.5, 0.5, 1.5, 0.5) and open_line(world, 0.5, 0.9, 1.5, 0.9)
    assert not open_line(world, 0.5, 0.7, 1.5, 0.7)
    with pytest.raises(ValueError, match="does not fit in wall 1"):
        polygon_walls(square, gaps=[(1, 0.4, 1.6)])

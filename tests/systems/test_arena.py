"""The arena against the derived geometry table of section 4 (TS-32 to TS-39)."""

import math

import numpy as np
import pytest

from formicarium.devices.booth import HALF
from formicarium.systems.sequencing.arena import build_arena, make_arena
from formicarium.systems.sequencing.parameters import ArenaTable, BehaviourTable

# m, setting, side, area, apothem, booth-booth, guardian-guardian: section 4, as derived there.
GEOMETRY = [
    (3, 0, 0.9000, 2.104, 0.779, 1.350, 1.021),
    (3, 1, 1.2728, 4.209, 1.102, 1.909, 1.580),
    (3, 2, 1.8000, 8.418, 1.559, 2.700, 2.371),
    (3, 3, 2.5456, 16.835, 2.204, 3.818, 3.489),
    (3, 4, 3.6000, 33.671, 3.118, 5.400, 5.071),
    (4, 0, 0.6600, 2.103, 0.797, 1.127, 0.858),
    (4, 1, 0.9334, 4.207, 1.127, 1.593, 1.325),
    (4, 2, 1.3200, 8.413, 1.593, 2.253, 1.985),
    (4, 3, 1.8668, 16.826, 2.253, 3.187, 2.918),
    (4, 4, 2.6400, 33.652, 3.187, 4.507, 4.238),
]
BASE = {3: 0.9, 4: 0.66}


def arena_of(tasks: int, setting: int, **fields):
    side = BASE[tasks] * math.sqrt(2.0) ** setting
    return make_arena(ArenaTable(tasks=tasks, sides=2 * tasks, side=side, **fields), 0.1)


def area(corners) -> float:
    x, y = corners.T
    return 0.5 * float(np.sum(x * np.roll(y, -1) - y * np.roll(x, -1)))


def mouths(arena):
    x, y, way = arena.booths.T
    return np.column_stack([x - HALF * np.cos(way), y - HALF * np.sin(way)])


@pytest.mark.parametrize(("tasks", "setting", "side", "size", "apothem", "between", "guardians"), GEOMETRY)
def test_the_geometry_is_the_derived_one(tasks, setting, side, size, apothem, between, guardians):
    arena = arena_of(tasks, setting)
    corners = arena.corners
    sides = np.hypot(*(np.roll(corners, -1, axis=0) - corners).T)
    assert len(corners) == 2 * tasks and sides == pytest.approx(side, abs=5e-5)
    assert area(corners) == pytest.approx(size, abs=6e-4)
    centre = corners.mean(axis=0)
    places = mouths(arena)
    assert np.hypot(*(places - centre).T) == pytest.approx(apothem, abs=6e-4)
    assert np.hypot(*(np.roll(places, -1, axis=0) - places).T) == pytest.approx(between, abs=6e-4)
    drive = BehaviourTable().exit_distance  # a future guardian starts in the booth's middle and drives straight out
    stand = arena.booths[:, :2] - drive * np.column_stack([np.cos(arena.booths[:, 2]), np.sin(arena.booths[:, 2])])
    assert np.hypot(*(np.roll(stand, -1, axis=0) - stand).T) == pytest.approx(guardians, abs=1.1e-3)


@pytest.mark.parametrize("tasks", [3, 4])
def test_booths_stand_in_the_middle_of_alternate_sides_facing_the_arena(tasks):
    """TS-35, TS-36: outside the wall line, mouth flush."""
    arena = arena_of(tasks, 0)
    for k, (x, y, way) in enumerate(arena.booths):
        a, b = arena.corners[2 * k], arena.corners[(2 * k + 1) % (2 * tasks)]
        outward = np.array([math.cos(way), math.sin(way)])
        assert np.dot(b - a, outward) == pytest.approx(0.0, abs=1e-12)
        assert tuple((a + b) / 2 + HALF * outward) == pytest.approx((x, y))
        assert np.dot((a + b) / 2 - arena.corners.mean(axis=0), outward) > 0


def test_the_neighbour_guardian_on_the_right_is_30_degrees_to_the_right_45_in_the_octagon():
    """TS-39."""
    for tasks, degrees in ((3, 30.0), (4, 45.0)):
        arena = arena_of(tasks, 0)
        places = mouths(arena)
        inward = arena.booths[0, 2] + math.pi
        line = places[1] - places[0]  # anticlockwise round the arena
        right = math.remainder(math.atan2(line[1], line[0]) - inward, math.tau)
        assert math.degrees(right) == pytest.approx(-degrees)


def wall_length(arena) -> float:
    walls = arena.segments[arena.segments.group == 0]
    return float(np.hypot(walls.bx - walls.ax, walls.by - walls.ay).sum())


@pytest.mark.parametrize("tasks", [3, 4])
def test_the_wall_has_a_gap_as_wide_as_the_booth_at_each_mouth(tasks):
    arena = arena_of(tasks, 0)
    assert wall_length(arena) == pytest.approx(2 * tasks * BASE[tasks] - tasks * 2 * HALF)
    walls = arena.segments[arena.segments.group == 0]
    ends = np.concatenate([np.column_stack([walls.ax, walls.ay]), np.column_stack([walls.bx, walls.by])])
    for mouth in mouths(arena):
        assert np.sort(np.hypot(*(ends - mouth).T))[:2] == pytest.approx([HALF, HALF])


def test_booths_may_stand_inside_the_arena():
    """TS-36: tam_offset is a parameter; with 0.12 m the wall is whole behind the booths."""
    inside = arena_of(3, 0, tam_offset=2 * HALF)
    assert wall_length(inside) == pytest.approx(6 * 0.9)
    apothem = 0.9 * math.sqrt(3) / 2
    assert np.hypot(*mouths(inside).T) == pytest.approx(apothem - 2 * HALF)
    assert np.hypot(*mouths(arena_of(3, 0, tam_offset=0.05)).T) == pytest.approx(apothem - 0.05)


def test_a_turned_and_shifted_arena_is_the_same_arena():
    plain, moved = arena_of(3, 0), arena_of(3, 0, turn=0.7, shift_x=1.0, shift_y=-2.0)
    turn = np.array([[math.cos(0.7), math.sin(0.7)], [-math.sin(0.7), math.cos(0.7)]])
    assert moved.corners == pytest.approx(plain.corners @ turn + (1.0, -2.0), abs=1e-12)
    assert moved.booths[:, :2] == pytest.approx(plain.booths[:, :2] @ turn + (1.0, -2.0), abs=1e-12)
    wrapped = np.remainder(moved.booths[:, 2] - plain.booths[:, 2] - 0.7 + math.pi, math.tau) - math.pi
    assert wrapped == pytest.approx(0.0, abs=1e-12)


def test_an_irregular_arena_has_its_booths_where_it_is_told():
    corners = np.array([(0.0, 0.0), (2.0, 0.0), (2.0, 1.0), (0.0, 1.5)])
    arena = build_arena(corners, [(0, 0.25), (1, 0.5), (3, 0.9)], 0.0, 0.1, 0.1)
    assert mouths(arena) == pytest.approx(np.array([(0.5, 0.0), (2.0, 0.5), (0.0, 0.15)]))
    into = np.column_stack([np.cos(arena.booths[:, 2]), np.sin(arena.booths[:, 2])])
    assert into == pytest.approx(np.array([(0.0, -1.0), (1.0, 0.0), (-1.0, 0.0)]), abs=1e-12)
    perimeter = float(np.hypot(*(np.roll(corners, -1, axis=0) - corners).T).sum())
    assert wall_length(arena) == pytest.approx(perimeter - 3 * 2 * HALF)


def test_tasks_need_two_sides_each():
    with pytest.raises(ValueError, match="6 sides"):
        ArenaTable(tasks=3, sides=8)

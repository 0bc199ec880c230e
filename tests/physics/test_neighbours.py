"""The grids find exactly what asking everybody finds."""

import math

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from formicarium.physics.grid import find_neighbours, scenery_cell
from formicarium.physics.world import box, joined, make_world, polygon_walls, regular_polygon
from physics.flat_scenes import discs

places_ = st.lists(
    st.tuples(st.floats(-3, 3, allow_subnormal=False), st.floats(-2, 5, allow_subnormal=False)),
    min_size=1,
    max_size=40,
)


@settings(max_examples=200)
@given(places_, st.floats(0.2, 2.0), places_)
def test_the_neighbours_are_all_others_within_reach(spots, reach, later):
    world = make_world(discs(spots), reach=reach)
    # Bodies may wander off the grid that was laid round their first places.
    for i, (x, y) in enumerate(later[: len(spots)]):
        world.bodies.x[i], world.bodies.y[i] = 2 * x, 2 * y
    find_neighbours(world)
    for i, body in enumerate(world.bodies):
        listed = world.neighbours[i, : world.neighbour_count[i]]
        expected = []
        for j, other in enumerate(world.bodies):
            dx, dy = other.x - body.x, other.y - body.y
            if i != j and dx * dx + dy * dy <= reach * reach:
                expected.append((j, dx, dy, math.sqrt(dx * dx + dy * dy)))
        assert sorted(listed.tolist()) == expected


@settings(max_examples=50)
@given(st.permutations(range(12)), st.integers(0, 1000))
def test_the_order_of_neighbours_does_not_depend_on_storage(order, seed):
    spots = np.random.default_rng(seed).uniform(-1, 1, (12, 2))
    bodies = discs(spots)
    straight, mixed = make_world(bodies), make_world(bodies[order])
    for at, i in enumerate(order):
        count = straight.neighbour_count[i]
        assert mixed.neighbour_count[at] == count
        mixed_keys = mixed.bodies.key[mixed.neighbours.index[at, :count]]
        assert mixed_keys.tolist() == straight.neighbours.index[i, :count].tolist()


@settings(max_examples=50)
@given(st.floats(-2.5, 2.5), st.floats(-2.5, 2.5))
def test_no_segment_within_reach_of_a_place_is_missing_from_its_cell(x, y):
    scenery = joined(polygon_walls(regular_polygon(6, 1.0, 0.2), gaps=[(0, 0.2, 0.3)]), box(0.2, 0.3, 1, 0.1, 0.2))
    world = make_world(discs([(0, 0)]), scenery)
    cell = scenery_cell(world.settings[0], x, y)
    listed = world.scenery[world.scenery[cell] : world.scenery[cell + 1]].tolist()
    assert listed == sorted(listed)
    for number, face in enumerate(scenery):
        spots = np.linspace((face.ax, face.ay), (face.bx, face.by), 400)
        if np.hypot(*(spots - (x, y)).T).min() < 0.11:
            assert number in listed

"""How a trial begins: everybody in a place of their own, with a name and a random stream of their own."""

import math

import numpy as np
import pytest
from pydantic import ValidationError

from formicarium.physics.scenery import regular_polygon
from formicarium.robots.epuck import Epuck
from formicarium.systems.sequencing.loop import run
from formicarium.systems.sequencing.parameters import mark_i3_parameters
from formicarium.systems.sequencing.setup import begin
from formicarium.trial.setup import NoRoom, inside_convex, make_crew, random_places

HEXAGON = np.array(regular_polygon(6, 0.9))
NOWHERE = np.zeros((0, 2))


def distance_to_sides(x, y):
    """Return how far a place is from the nearest side of the hexagon, m."""
    apothem = 0.9 * math.sqrt(0.75)
    return min(apothem - x * math.cos(a) - y * math.sin(a) for a in np.radians(30.0 + 60.0 * np.arange(6)))


@pytest.mark.parametrize("seed", range(20))
def test_robots_start_apart_from_each_other_walls_and_mouths(seed):
    mouths = np.array([[0.0, 0.779], [0.6, -0.3]])
    places = random_places(40, HEXAGON, mouths, 0.15, seed)
    x, y = places[:, 0], places[:, 1]
    gaps = np.hypot(x[:, None] - x, y[:, None] - y)[~np.eye(40, dtype=bool)]
    assert gaps.min() >= 0.08
    assert min(distance_to_sides(*place) for place in places[:, :2]) >= 0.06 - 1e-9
    assert np.hypot(x[:, None] - mouths[:, 0], y[:, None] - mouths[:, 1]).min() >= 0.15
    assert (np.abs(places[:, 2]) <= math.pi).all()


def test_robots_start_anywhere_and_look_anywhere():
    places = np.concatenate([random_places(20, HEXAGON, NOWHERE, 0.0, seed) for seed in range(100)])
    count = len(places)
    for angles in (np.arctan2(places[:, 1], places[:, 0]), places[:, 2]):
        sixths = np.bincount(np.floor((angles + math.pi) / (math.pi / 3)).astype(int) % 6, minlength=6)
        assert ((sixths - count / 6) ** 2).sum() / (count / 6) < 25.7  # chi square, 5 degrees, p = 0.0001
    inner = np.mean(np.hypot(places[:, 0], places[:, 1]) < 0.4)
    assert inner == pytest.approx(math.pi * 0.4**2 / (2.598 * (0.9 - 0.06 / math.sqrt(0.75)) ** 2), abs=0.05)


def test_three_hundred_robots_have_no_room_and_are_told_so():
    with pytest.raises(NoRoom, match=r"300 robots do not fit into the arena: there is room for about \d+"):
        random_places(300, HEXAGON, NOWHERE, 0.0, 1)


def test_a_tiny_arena_has_no_room():
    with pytest.raises(NoRoom, match="5 robots do not fit"):
        random_places(5, HEXAGON / 10.0, NOWHERE, 0.0, 1)
    with pytest.raises(ValueError, match="room"):  # refused with the parameters, or when they are placed
        begin(mark_i3_parameters(robots=255), 1)


@pytest.mark.parametrize("robots", [0, -1, 256, 300])
def test_a_swarm_of_no_robot_or_of_more_than_a_byte_can_name_is_refused(robots):
    with pytest.raises(ValidationError, match=r"swarm\.robots"):
        mark_i3_parameters(robots=robots)


def test_inside_a_polygon_is_as_far_from_its_sides_as_asked():
    draws = np.random.default_rng(1)
    for x, y in draws.uniform(-0.9, 0.9, (500, 2)):
        for margin in (0.0, 0.06, 0.3):
            if abs(distance_to_sides(x, y) - margin) > 1e-9:
                assert inside_convex(HEXAGON, x, y, margin) == (distance_to_sides(x, y) > margin)


# names and streams


def crew(count, seed=1, storage=None, rate=0.0):
    places = np.zeros((count, 3))
    places[:, 0] = np.arange(count)
    return make_crew(places, Epuck(), seed, rate, 0.1, storage=storage)


@pytest.mark.parametrize("count", [1, 20, 255])
def test_identities_are_distinct_bytes_and_zero_is_nobody(count):
    identities = crew(count).robots.identity
    assert len(set(identities.tolist())) == count
    assert identities.min() >= 1 and identities.max() <= 255


def test_identities_go_with_the_robot_and_not_with_its_place_in_memory():
    storage = np.random.default_rng(1).permutation(20)
    plain, mixed = crew(20), crew(20, storage=storage)
    assert mixed.robots[storage].tobytes() == plain.robots.tobytes()
    assert mixed.bodies[storage].tobytes() == plain.bodies.tobytes()


def test_identities_tell_nothing_about_the_order_of_robots():
    ranks = np.array([crew(20, seed).robots.identity for seed in range(400)])
    likeness = [np.corrcoef(np.arange(20), row)[0, 1] for row in ranks]
    assert abs(np.mean(likeness)) < 4 / math.sqrt(19 * 400)
    assert ranks.mean(axis=0) == pytest.approx([128.0] * 20, abs=5 * 73.6 / math.sqrt(400))


def test_every_robot_has_a_noise_stream_of_its_own():
    noise = np.concatenate([crew(100, seed).robots.noise for seed in range(20)])
    assert len(np.unique(noise)) == len(noise)


def test_one_robot_more_changes_nothing_for_the_others():
    fewer, more = crew(20, rate=1e-4), crew(21, rate=1e-4)
    assert more.robots[:20].tobytes() == fewer.robots.tobytes()
    places = [random_places(count, HEXAGON, NOWHERE, 0.0, 3) for count in (20, 21)]
    assert np.array_equal(places[1][:20], places[0])


def test_a_stranger_beyond_the_wall_changes_no_draw_of_the_others():
    """Six robots, the sixth walking ten metres off: five live as if they were alone (T29)."""
    alone, accompanied = (begin(mark_i3_parameters(robots=count), 6) for count in (5, 6))
    accompanied.world.bodies[5].x = 10.0
    for state in (alone, accompanied):
        run(state, 1500)
    assert accompanied.world.bodies[5].x != 10.0
    for part in ("robots", "memories", "commands", "readings"):
        assert getattr(accompanied, part)[:5].tobytes() == getattr(alone, part).tobytes()
    assert accompanied.world.bodies[:5].tobytes() == alone.world.bodies.tobytes()

"""The omnidirectional camera: coloured lights, near ones, over the heads of the others."""

import math

import numpy as np
import pytest

from formicarium.devices.booth import booth_outline
from formicarium.physics.world import chain
from formicarium.robots.records import BLOBS, Colour
from robots.stage import QUIET, Stage, around


def lit(places, headings=0.0, colour=Colour.CYAN, **rest):
    """Return a stage whose robots but the first show a colour."""
    stage = Stage([(0, 0), *places], headings, **rest)
    stage.commands.colour[1:] = colour
    return stage


@pytest.mark.parametrize("distance, seen", [(0.08, 1), (0.3319, 1), (0.3321, 0), (0.6, 0)])
def test_lights_are_seen_within_the_range_only(distance, seen):
    assert len(lit([(0.0, distance)], **QUIET).look()) == seen
    device = Stage([(0, 0)], 0.0, lights=[(distance, 0.0, Colour.RED)], **QUIET)
    assert len(device.look()) == seen


@pytest.mark.parametrize("colour", list(Colour)[1:])
def test_a_light_is_seen_in_its_colour_where_it_is(colour):
    stage = lit([(0.0, 0.2)], [0.5, 0.0], colour, **QUIET)
    blob = stage.look()[0]
    assert (blob.colour, blob.distance, blob.bearing) == pytest.approx((colour, 0.2, math.pi / 2 - 0.5))


def test_a_light_that_is_off_is_not_seen():
    assert len(lit([(0.2, 0)], colour=Colour.OFF, **QUIET).look()) == 0
    assert len(Stage([(0, 0)], lights=[(0.2, 0.0, Colour.OFF)], **QUIET).look()) == 0


def test_a_robot_does_not_see_its_own_light():
    stage = Stage([(0, 0)], **QUIET)
    stage.commands[0].colour = Colour.CYAN
    assert len(stage.look()) == 0


def test_robots_do_not_hide_robots():
    stage = lit([(0.1, 0), (0.2, 0), (0.3, 0)], **QUIET)
    assert stage.look().distance.tolist() == pytest.approx([0.1, 0.2, 0.3])


def test_booth_walls_hide_lights_and_arena_walls_do_not():
    low = lit([(0.3, 0)], segments=chain([(0.15, -1), (0.15, 1)]), **QUIET)
    booth = lit([(0.3, 0)], segments=booth_outline(0.15, 0.0, math.pi / 2, 0.1, 1), **QUIET)
    assert (len(low.look()), len(booth.look())) == (1, 0)


def test_a_booths_own_lights_shine_out_of_its_mouth_only():
    walls = booth_outline(0.0, 0.0, 0.0, 0.1, 1)  # its mouth is at x = -0.06
    stage = Stage([(-0.2, 0)], segments=walls, lights=[(0.035, 0.0, Colour.RED)], **QUIET)
    assert len(stage.look()) == 1
    for x, y in ((0.0, 0.2), (0.2, 0.0), (0.0, -0.2)):
        stage.put(0, x, y)
        assert len(stage.look()) == 0


def test_blobs_come_nearest_first():
    random = np.random.default_rng(5)
    lights = [(*place, 1 + n % 4) for n, place in enumerate(random.uniform(-0.22, 0.22, (20, 2)))]
    stage = Stage([(0, 0)], lights=lights)
    for cycle in range(50):
        distances = stage.look(cycle=cycle).distance
        assert len(distances) > 10 and (np.diff(distances) >= 0).all()


def test_what_does_not_fit_is_counted_and_the_farthest_are_left_out():
    lights = [(0.1 + 0.005 * n, 0.0, 1 + n % 4) for n in range(BLOBS + 8)]
    stage = Stage([(0, 0)], lights=[lights[n] for n in np.random.default_rng(6).permutation(len(lights))], **QUIET)
    blobs = stage.look()
    assert len(blobs) == BLOBS
    assert blobs.distance.tolist() == pytest.approx([light[0] for light in lights[:BLOBS]])
    assert blobs.colour.tolist() == [light[2] for light in lights[:BLOBS]]
    assert stage.robots[0].blobs_dropped == 8


def test_one_light_in_twenty_is_missed():
    stage = lit(around(8, 0.2))
    seen = np.array([len(stage.look(cycle=cycle)) for cycle in range(2000)])
    assert 1.0 - seen.mean() / 8 == pytest.approx(0.05, abs=4 * math.sqrt(0.05 * 0.95 / 16000))


@pytest.mark.parametrize("distance", [0.08, 0.3])
def test_distance_is_off_by_thirteen_millimetres_and_bearing_by_two_degrees(distance):
    stage = Stage([(0, 0), (-distance, 0)], camera_miss=0.0)
    stage.commands[1].colour = Colour.YELLOW
    blobs = np.array([stage.look(cycle=cycle)[0] for cycle in range(4000)]).view(np.recarray)
    assert blobs.distance.mean() == pytest.approx(distance, abs=4 * 0.013 / math.sqrt(4000))
    assert blobs.distance.std() == pytest.approx(0.013, rel=0.05)
    assert (blobs.bearing > -math.pi).all() and (blobs.bearing <= math.pi).all()
    off = blobs.bearing % (2 * math.pi) - math.pi
    assert off.mean() == pytest.approx(0.0, abs=4 * math.radians(2) / math.sqrt(4000))
    assert off.std() == pytest.approx(math.radians(2), rel=0.05)


def test_two_lights_are_missed_and_misjudged_apart():
    stage = Stage([(0, 0), (0.2, 0.0)], lights=[(-0.2, 0.0, Colour.RED)])
    stage.commands[1].colour = Colour.CYAN
    rows = []
    for cycle in range(4000):
        blobs = {int(blob.colour): blob for blob in stage.look(cycle=cycle)}
        rows.append([blobs[colour].distance if colour in blobs else np.nan for colour in (Colour.CYAN, Colour.RED)])
    rows = np.array(rows)
    missed = np.isnan(rows)
    assert 0 < missed.all(axis=1).sum() < 30  # one in four hundred, not one in twenty
    both = rows[~missed.any(axis=1)]
    assert abs(np.corrcoef(both.T)[0, 1]) < 4 / math.sqrt(len(both))

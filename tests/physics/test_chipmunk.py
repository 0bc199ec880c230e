"""Chipmunk, the engine of the reference simulator, as an oracle on the same scenes."""

import math

import numpy as np
import pytest

from formicarium.physics.world import box, chain, joined, make_world, outline
from physics.flat_scenes import Chipmunk, discs, places, run, speeds

WALL = chain([(0.3, -2.0), (0.3, 2.0)])
BOX = box(0.25, 0.0, 0.3, 0.12, 0.08)
BAY = joined(box(0.0, 0.055, 0.0, 0.12, 0.01), box(0.0, -0.055, 0.0, 0.12, 0.01), box(0.048, 0, 0, 0.024, 0.1))

SCENES = {
    # Symmetric or driven against something fixed: small differences stay small.
    "free": (discs([(0, 0)], 0.3, 0.1, turning=0.4), ()),
    "wall": (discs([(0.1, 0)], 0.0, 0.1), WALL),
    "slide along a wall": (discs([(0.1, 0)], 0.8, 0.1), WALL),
    "head-on": (discs([(0, 0), (0.2, 0)], [0, math.pi], 0.1), ()),
    "pusher": (discs([(0, 0), (0.1, 0)], 0.0, [0.1, 0.0]), ()),
    "pinned": (discs([(0.1, 0), (0.2, 0)], 0.0, [0.1, 0.0]), WALL),
    "train of four against a wall": (discs([(0.08 * k - 0.1, 0) for k in range(4)], 0.0, 0.1), WALL),
    "glancing": (discs([(0, 0), (0.2, 0.05)], [0, math.pi], 0.1), ()),
    "side push": (discs([(0, 0), (0.0, -0.1)], [0, math.pi / 2], 0.1), ()),
    "box": (discs([(0.1, 0.03)], 0.0, 0.1), BOX),
    "into a booth": (discs([(-0.12, 0.012)], 0.0, 0.1), BAY),
    "passive disc pushed": (discs([(0, 0), (0.1, 0.01)], 0.0, [0.1, 0.0], force_limit=[1.5, 0.2]), ()),
    "overlap mended": (discs([(0, 0), (0.06, 0)]), ()),
}


@pytest.mark.parametrize("name", SCENES)
def test_after_two_seconds_discs_are_where_chipmunk_has_them(name):
    bodies, segments = SCENES[name]
    world = run(make_world(bodies, segments if len(segments) else None), 2.0)
    oracle = Chipmunk(bodies, segments).run(2.0)
    assert places(world) == pytest.approx(oracle.places, abs=0.002)
    assert speeds(world) == pytest.approx(oracle.speeds, rel=0.05, abs=0.002)


def random_scene(seed):
    """Return 2 to 6 driven discs, apart from each other and a box, in a square of 0.5 m."""
    random = np.random.default_rng(seed)
    walls = outline([(0, 0), (0.5, 0), (0.5, 0.5), (0, 0.5)])
    where = random.uniform(0.2, 0.3, 2)
    obstacle = box(*where, random.uniform(-3, 3), 0.08, 0.06)
    spots, count = [], 2 + seed % 5
    while len(spots) < count:
        spot = random.uniform(0.04, 0.46, 2)
        if math.dist(spot, where) > 0.09 and all(math.dist(spot, other) > 0.075 for other in spots):
            spots.append(spot)
    headings = np.arctan2(*(0.25 - np.array(spots)).T[::-1]) + random.uniform(-1, 1, count)
    forward = random.choice([0.0, 0.05, 0.1, 0.1], count)
    bodies = discs(spots, headings, forward, turning=random.uniform(-0.3, 0.3, count))
    return bodies, joined(walls, obstacle)


def test_random_crowds_end_where_chipmunk_has_them_unless_chipmunk_itself_is_undecided():
    """A scene counts if Chipmunk's own outcome does not hang on 0.1 mm or on the number of iterations."""
    decided, pressed, apart, quick = 0, 0, [], []
    for seed in range(60):
        bodies, segments = random_scene(seed)
        oracle = Chipmunk(bodies, segments).run(2.0)
        nudged = bodies.copy()
        nudged.x += np.where(np.arange(len(bodies)) % 2, 1e-4, -1e-4)
        others = [Chipmunk(nudged, segments).run(2.0), Chipmunk(bodies, segments, iterations=40).run(2.0)]
        if max(np.abs(other.places - oracle.places).max() for other in others) > 0.0005:
            continue
        if max(np.abs(other.speeds - oracle.speeds).max() for other in others) > 0.002:
            continue
        decided += 1
        world = run(make_world(bodies, segments), 2.0)
        pressed += np.any(np.hypot(*speeds(world).T) < 0.99 * np.abs(bodies.forward))
        apart.append(np.abs(places(world) - oracle.places).max())
        quick.append(np.abs(speeds(world) - oracle.speeds).max())
    assert decided >= 30 and pressed >= 25
    assert max(apart) < 0.002
    assert max(quick) < 0.05 * 0.1

"""The world: discs with drives among static scenery, as arrays of records."""

from typing import NamedTuple

import numpy as np

from formicarium.physics.contacts import SLACK
from formicarium.physics.grid import find_neighbours, lists_of_scenery
from formicarium.physics.records import (
    BODY,
    CONTACT,
    LISTS,
    MOTION,
    NEIGHBOUR,
    OBSTACLE,
    SEGMENT,
    SETTINGS,
    copied,
    records,
)
from formicarium.physics.scenery import (
    box,
    chain,
    joined,
    obstacles_of,
    outline,
    polygon_walls,
    regular_polygon,
)

__all__ = [
    "BODY",
    "NEIGHBOUR",
    "OBSTACLE",
    "SEGMENT",
    "SETTINGS",
    "World",
    "box",
    "chain",
    "joined",
    "make_bodies",
    "make_world",
    "outline",
    "polygon_walls",
    "regular_polygon",
]

# What a caller may set, with the values of the reference simulator (docs/choices.md) except for slop,
# whose 0.1 m there lets overlapping bodies overlap for ever.
ADJUSTABLE = {
    "cycle_time": 0.1,
    "substeps": 10,
    "iterations": 10,
    "slop": 0.0001,
    "bias": (1.0 - 0.1) ** 60,
    "friction": 0.7,
    "reach": 0.82,
    "scenery_reach": 0.11,
    "margin": 0.0,
}
FIELDS = BODY.names or ()
TOP_SPEED = 0.6  # m/s, up to which nothing can be missed: twice an e-puck's wheels at their limit
MOST_CELLS = 64  # along one side of the body grid
SCENERY_CELL = 0.1  # m
PAIRS_ALWAYS = 50_000  # room for all pairs of 300 bodies
PAIRS_PER_BODY = 32  # three times what a packed crowd can have within a cycle's travel


class Solver(NamedTuple):
    """What only lives within one cycle."""

    motions: np.recarray  # MOTION (N + 1,)
    contacts: np.recarray  # CONTACT: pairs that can touch in this cycle, by keys
    outlines: np.ndarray  # (3, N): dx, dy and radius (m) of the neighbours of the body that looked round last


class World(NamedTuple):
    """Everything physics knows. Only bodies are state; neighbours and what follows them are found from it.

    The fewer arrays, the better: handing a World to a function that is not inlined costs 10 ns for each.
    """

    bodies: np.recarray  # BODY (N,)
    segments: np.recarray  # SEGMENT (S,)
    obstacles: np.recarray  # OBSTACLE (K,)
    settings: np.recarray  # SETTINGS (1,)
    neighbours: np.recarray  # NEIGHBOUR (N, N - 1 or more): row i holds the neighbours of body i
    neighbour_count: np.ndarray  # (N,): how many of row i are valid
    scenery: np.ndarray  # segments near each scenery cell, see grid.lists_of_scenery
    lists: np.recarray  # LISTS (N,)
    cell_first: np.ndarray  # (cells + 1,): first member of each cell of the body grid
    solver: Solver


def make_bodies(count: int, **fields: object) -> np.recarray:
    """Return ``count`` bodies with keys 0, 1, ... and with the given fields (numbers or sequences)."""
    bodies = records(BODY, count)
    bodies.key = np.arange(count)
    for name, values in fields.items():
        if name not in FIELDS:
            raise ValueError(f"a body has no {name}; it has {', '.join(FIELDS)}")
        bodies[name] = values
    return bodies


def _check(bodies: np.recarray, segments: np.recarray, settings: np.recarray) -> None:
    for kind, array in (("bodies", bodies), ("segments", segments), ("settings", settings)):
        for name in array.dtype.names or ():
            if not np.isfinite(array[name]).all():
                raise ValueError(f"{kind}: {name} must be finite")
    for name in ("radius", "mass", "inertia"):
        if not (bodies[name] > 0).all():
            raise ValueError(f"bodies: {name} must be positive")
    for name in ("force_limit", "torque_limit"):
        if not (bodies[name] >= 0).all():
            raise ValueError(f"bodies: {name} must not be negative")
    if len(np.unique(bodies.key)) != len(bodies):
        raise ValueError("bodies: every key must be different")
    if ((segments.ax == segments.bx) & (segments.ay == segments.by)).any():
        raise ValueError("segments: a segment must have a length")
    if not (segments.friction >= 0).all():
        raise ValueError("segments: friction must not be negative")
    for name in ("cycle_time", "substeps", "iterations", "reach", "scenery_reach"):
        if not settings[name][0] > 0:
            raise ValueError(f"settings: {name} must be positive")
    if not (settings.slop[0] >= 0 and settings.friction[0] >= 0 and 0 < settings.bias[0] <= 1):
        raise ValueError("settings: slop and friction must not be negative, bias must be in (0, 1]")


def make_world(
    bodies: np.ndarray,
    segments: np.ndarray | None = None,
    obstacles: np.ndarray | None = None,
    **settings: float,
) -> World:
    """Return a world with these bodies and this scenery; its neighbour lists are filled.

    Obstacles are found from the segments' groups if not given. Settings are those named in ADJUSTABLE.
    """
    if len(bodies) == 0:
        raise ValueError("bodies: a world needs at least one")
    bodies = copied(bodies, BODY)
    segments = copied(joined() if segments is None else segments, SEGMENT)
    unknown = sorted(set(settings) - set(ADJUSTABLE))
    if unknown:
        raise ValueError(f"no setting is called {', '.join(unknown)}; there are {', '.join(ADJUSTABLE)}")
    chosen = records(SETTINGS, 1)
    for name, value in (ADJUSTABLE | settings).items():
        chosen[name] = value
    _check(bodies, segments, chosen)
    travel = TOP_SPEED * chosen.cycle_time[0] + SLACK
    if chosen.reach[0] < 2.0 * (bodies.radius.max() + travel):
        raise ValueError("settings: reach must cover two bodies and their travel in a cycle")
    chosen.scenery_reach = max(chosen.scenery_reach[0], bodies.radius.max() + travel)
    obstacles = copied(obstacles_of(segments) if obstacles is None else obstacles, OBSTACLE)
    if ((obstacles.first < 0) | (obstacles.first + obstacles["count"] > len(segments))).any():
        raise ValueError("obstacles: first and count must name existing segments")

    xs = np.concatenate([segments.ax, segments.bx, bodies.x])
    ys = np.concatenate([segments.ay, segments.by, bodies.y])
    set_ = chosen[0]
    margin = max(2.0 * set_.scenery_reach, set_.margin)
    set_.low_x, set_.low_y = xs.min() - margin, ys.min() - margin
    width, height = xs.max() + margin - set_.low_x, ys.max() + margin - set_.low_y
    set_.cell = max(set_.reach, width / MOST_CELLS, height / MOST_CELLS)
    set_.columns, set_.rows = int(width / set_.cell) + 1, int(height / set_.cell) + 1
    set_.scenery_cell = max(SCENERY_CELL, width / 512, height / 512)
    set_.scenery_columns = int(width / set_.scenery_cell) + 1
    set_.scenery_rows = int(height / set_.scenery_cell) + 1
    time = set_.cycle_time / set_.substeps
    set_.mending = (1.0 - set_.bias**time) / time
    set_.tall_walls = int(((segments.group == 0) & (segments.tall != 0)).any())
    scenery = lists_of_scenery(segments, set_)

    count = len(bodies)
    lists = records(LISTS, count)
    lists.order = np.argsort(bodies.key, kind="stable")
    lists.rank[lists.order] = np.arange(count)
    pairs = min(count * (count - 1) // 2, max(PAIRS_ALWAYS, PAIRS_PER_BODY * count))
    room = pairs + count * int(np.diff(scenery[: scenery[0]]).max(initial=0))
    world = World(
        bodies=bodies,
        segments=segments,
        obstacles=obstacles,
        settings=chosen,
        neighbours=records(NEIGHBOUR, (count, max(1, count - 1))),
        neighbour_count=np.zeros(count, np.int64),
        scenery=scenery,
        lists=lists,
        cell_first=np.zeros(set_.columns * set_.rows + 1, np.int64),
        solver=Solver(
            motions=records(MOTION, count + 1), contacts=records(CONTACT, max(1, room)), outlines=np.zeros((3, count))
        ),
    )
    find_neighbours(world)
    return world

"""Static scenery: walls, boxes and outlines as lists of segments. Used once, before a trial."""

import math
from collections.abc import Iterable, Sequence

import numpy as np

from formicarium.physics.records import OBSTACLE, SEGMENT, copied, records

Point = tuple[float, float]

WALL_FRICTION = 0.1  # of walls, boxes and booths; docs/choices.md


def joined(*pieces: np.ndarray) -> np.recarray:
    """Return all segments as one array, in the order given."""
    return np.concatenate([np.zeros(0, SEGMENT), *pieces]).view(np.recarray)


def chain(points: Sequence[Point], friction: float = WALL_FRICTION, tall: bool = False, group: int = 0) -> np.recarray:
    """Return the open line through the points (m)."""
    segments = records(SEGMENT, len(points) - 1)
    corners = np.asarray(points, float)
    segments.ax, segments.ay = corners[:-1].T
    segments.bx, segments.by = corners[1:].T
    segments.friction, segments.tall, segments.group = friction, int(tall), group
    return segments


def outline(
    points: Sequence[Point], friction: float = WALL_FRICTION, tall: bool = False, group: int = 0
) -> np.recarray:
    """Return the closed line through the points (m)."""
    return chain([*points, points[0]], friction, tall, group)


def box(
    x: float,
    y: float,
    heading: float,
    length: float,
    width: float,
    friction: float = WALL_FRICTION,
    tall: bool = True,
    group: int = 1,
) -> np.recarray:
    """Return the four faces of a box: length along the heading, width across it (m, rad)."""
    ahead = (0.5 * length * math.cos(heading), 0.5 * length * math.sin(heading))
    aside = (-0.5 * width * math.sin(heading), 0.5 * width * math.cos(heading))
    signs = ((-1, -1), (1, -1), (1, 1), (-1, 1))
    corners = [(x + a * ahead[0] + b * aside[0], y + a * ahead[1] + b * aside[1]) for a, b in signs]
    return outline(corners, friction, tall, group)


def regular_polygon(sides: int, side: float, heading: float = 0.0) -> list[Point]:
    """Return the corners of a regular polygon round the origin, counter-clockwise, the first at heading."""
    radius = 0.5 * side / math.sin(math.pi / sides)
    angles = [heading + 2.0 * math.pi * corner / sides for corner in range(sides)]
    return [(radius * math.cos(angle), radius * math.sin(angle)) for angle in angles]


def polygon_walls(
    points: Sequence[Point],
    gaps: Iterable[tuple[int, float, float]] = (),
    friction: float = WALL_FRICTION,
    tall: bool = False,
) -> np.recarray:
    """Return the walls of an arena with these corners (m) and with gaps to set booths into.

    A gap is (wall, start, end): wall k runs from corner k to corner k + 1, start and end are metres along it.
    """
    gaps = sorted(gaps)
    pieces = []
    for wall, (ax, ay) in enumerate(points):
        bx, by = points[(wall + 1) % len(points)]
        length = math.hypot(bx - ax, by - ay)
        at = 0.0
        for start, end in [(start, end) for which, start, end in gaps if which == wall] + [(length, length)]:
            if not at <= start <= end <= length:
                raise ValueError(f"gap {start}..{end} m does not fit in wall {wall} of {length:.3f} m")
            if start > at:
                ends = [(ax + (bx - ax) * s / length, ay + (by - ay) * s / length) for s in (at, start)]
                pieces.append(chain(ends, friction, tall))
            at = end
    return joined(*pieces)


def obstacles_of(segments: np.recarray) -> np.recarray:
    """Return the bounding circles of groups 1, 2, ...: obstacle k - 1 has the segments of group k."""
    obstacles = records(OBSTACLE, int(segments.group.max(initial=0)))
    for k in range(len(obstacles)):
        members = np.flatnonzero(segments.group == k + 1)
        if not len(members) or members[-1] - members[0] + 1 != len(members):
            raise ValueError(f"the segments of group {k + 1} must exist and stand together")
        own = copied(segments[members], SEGMENT)
        xs, ys = np.append(own.ax, own.bx), np.append(own.ay, own.by)
        x, y = 0.5 * (xs.min() + xs.max()), 0.5 * (ys.min() + ys.max())
        radius = np.sqrt(np.max((xs - x) ** 2 + (ys - y) ** 2))
        obstacles[k] = (x, y, radius, members[0], len(members))
    return obstacles

"""The arena: a regular polygon with a booth in the middle of every second side (Fig. 3, TS-32 to TS-37)."""

import math
from typing import NamedTuple

import numpy as np

from formicarium.devices.booth import HALF, booth_outline
from formicarium.physics.scenery import joined, polygon_walls, regular_polygon
from formicarium.systems.sequencing.parameters import ArenaTable


class Arena(NamedTuple):
    """Walls and booths."""

    corners: np.ndarray  # (K, 2) m, counter-clockwise
    booths: np.ndarray  # (M, 3): x, y (m) of each booth's middle and the direction into its bay (rad)
    segments: np.recarray  # SEGMENT: walls, then booth k as group k + 1


def make_arena(table: ArenaTable, friction: float) -> Arena:
    """Return the regular arena of a table; booth 0 on side 0."""
    corners = np.array(regular_polygon(table.sides, table.side, table.turn)) + (table.shift_x, table.shift_y)
    places = [(2 * booth, 0.5) for booth in range(table.tasks)]
    return build_arena(corners, places, table.tam_offset, table.wall_friction, friction)


def build_arena(
    corners: np.ndarray,
    places: list[tuple[int, float]],
    tam_offset: float,
    wall_friction: float,
    friction: float,
) -> Arena:
    """Return the arena of any convex polygon.

    Args:
        corners: (K, 2) m, counter-clockwise.
        places: for each booth the side it stands on and where, 0 at the side's first corner, 1 at its second.
        tam_offset: m, how far the mouths stand inside the wall line.
        wall_friction: coefficient of the walls.
        friction: coefficient of the booths.
    """
    booths, gaps = [], []
    for side, share in places:
        a, b = corners[side], corners[(side + 1) % len(corners)]
        length = math.dist(a, b)
        along = (b - a) / length
        outward = np.array([along[1], -along[0]])
        mouth = a + share * (b - a) - tam_offset * outward
        booths.append((*(mouth + HALF * outward), math.atan2(outward[1], outward[0])))
        if tam_offset < 2 * HALF:
            gaps.append((side, share * length - HALF, share * length + HALF))
    outlines = [booth_outline(x, y, way, friction, k + 1) for k, (x, y, way) in enumerate(booths)]
    walls = polygon_walls([tuple(corner) for corner in corners], gaps, wall_friction)
    return Arena(corners, np.array(booths), joined(walls, *outlines))

"""The arena of Fig. 6: walls, booths, cache, floor and lamp."""

import math
from typing import Any, NamedTuple

import numpy as np

from formicarium.devices.booth import HALF, booth_outline
from formicarium.devices.depot import Place
from formicarium.physics.floor import patches
from formicarium.physics.scenery import chain, joined, outline
from formicarium.systems.partitioning.parameters import ArenaTable

Box = tuple[float, float, float, float]  # left, bottom, right, top (m)


class Arena(NamedTuple):
    """What stands still. Booths in the order source, nest, cache towards the source, cache towards the nest."""

    corners: np.ndarray  # (4, 2) m
    booths: np.ndarray  # (B, 3): x, y (m) of each booth's middle and the direction into its bay (rad)
    places: tuple[int, ...]  # (B,) Place
    pairs: tuple[int, ...]  # (B,) number of the cache pair, -1 for none
    segments: np.recarray  # SEGMENT: walls, then booth k as group k + 1, then block and cache
    solids: tuple[np.ndarray, ...]  # outlines of the block and of the cache's column
    floor: np.recarray  # PATCH
    lamp: tuple[float, float]  # m
    source_area: Box
    nest_area: Box


def make_arena(table: ArenaTable) -> Arena:
    """Return the arena of a table."""
    t = table
    width, height = t.width, t.height
    corners = np.array([(0.0, 0.0), (width, 0.0), (width, height), (0.0, height)])
    booths, places, pairs = _booths(t)
    left, right = 0.5 * (width - t.cache_depth), 0.5 * (width + t.cache_depth)
    block = [
        (t.leg_width, t.bottom_width),
        (width - t.leg_width, t.bottom_width),
        (width - t.leg_width, t.block_top),
        (t.leg_width, t.block_top),
    ]
    column = _column(t, left, right)
    count = len(booths)
    outlines = [booth_outline(x, y, way, t.friction, k + 1) for k, (x, y, way) in enumerate(booths)]
    segments = joined(
        outline([(float(x), float(y)) for x, y in corners], t.friction),
        *outlines,
        outline(block, t.friction, True, count + 1),
        *(chain(line, t.friction, True, count + 2) for line in column),
    )
    whole = np.array([(left, t.block_top), (right, t.block_top), (right, height), (left, height)])
    return Arena(
        corners=corners,
        booths=np.array(booths),
        places=tuple(places),
        pairs=tuple(pairs),
        segments=segments,
        solids=(np.array(block), whole),
        floor=_floor(t, left, right),
        lamp=(0.5 * width, 0.0),
        source_area=(2 * HALF, t.block_top, left, height),
        nest_area=(right, t.block_top, width - 2 * HALF, height),
    )


def _booths(t: ArenaTable) -> tuple[list[tuple[float, float, float]], list[int], list[int]]:
    terminal = [t.height - t.terminal_top - k * t.booth_pitch for k in range(t.terminal_booths)]
    cache = [t.height - t.cache_top - k * t.booth_pitch for k in range(t.cache_pairs)]
    middle, apart = 0.5 * t.width, 0.5 * t.cache_depth - HALF
    rows = [
        *((HALF, y, math.pi, Place.SOURCE, -1) for y in terminal),
        *((t.width - HALF, y, 0.0, Place.NEST, -1) for y in terminal),
        *((middle - apart, y, 0.0, Place.CACHE_DROP, k) for k, y in enumerate(cache)),
        *((middle + apart, y, math.pi, Place.CACHE_PICK, k) for k, y in enumerate(cache)),
    ]
    return [row[:3] for row in rows], [int(row[3]) for row in rows], [row[4] for row in rows]


def _column(t: ArenaTable, left: float, right: float) -> list[list[tuple[float, float]]]:
    """Return the faces of the solid that holds the cache: between the booths on both sides, and below."""
    lines = []
    for x in (left, right):
        top = t.height
        for k in range(t.cache_pairs):
            middle = t.height - t.cache_top - k * t.booth_pitch
            if top - (middle + HALF) > 1e-9:
                lines.append([(x, top), (x, middle + HALF)])
            top = middle - HALF
        lines.append([(x, top), (x, t.block_top)])
    return lines


def _floor(t: ArenaTable, left: float, right: float) -> Any:
    """Return the shades: areas, the cache's access zones, the corridor's three parts, and the path on top."""
    width, middle = t.width, 0.5 * t.width
    half, below = 0.5 * t.path_width, 0.5 * t.bottom_width
    near, far = 0.5 * t.leg_width, width - 0.5 * t.leg_width
    return patches(
        [
            (0.0, t.bottom_width, t.leg_width, t.block_top, t.left_leg_shade),
            (width - t.leg_width, t.bottom_width, width, t.block_top, t.right_leg_shade),
            (0.0, 0.0, width, t.bottom_width, t.bottom_shade),
            (0.0, t.block_top, middle, t.height, t.source_shade),
            (middle, t.block_top, width, t.height, t.nest_shade),
            (left - t.zone_depth, t.block_top, left, t.height, t.drop_zone_shade),
            (right, t.block_top, right + t.zone_depth, t.height, t.pick_zone_shade),
            (near - half, below - half, near + half, t.block_top, t.path_shade),
            (far - half, below - half, far + half, t.block_top, t.path_shade),
            (near - half, below - half, far + half, below + half, t.path_shade),
        ]
    )

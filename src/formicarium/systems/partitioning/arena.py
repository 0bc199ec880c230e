"""The arena of Fig. 6: walls, booths, cache, floor and lamp."""

import itertools
import math
from typing import Any, NamedTuple

import numpy as np

from formicarium.devices.booth import HALF, booth_outline
from formicarium.devices.depot import Place
from formicarium.physics.floor import patches
from formicarium.physics.scenery import chain, joined, outline
from formicarium.systems.partitioning.memory import Ground
from formicarium.systems.partitioning.parameters import ArenaTable

DARKEST = 0.02  # shade of the nest area in a row of three areas
# Parts of the floor of three areas, from light to dark.
LEFT_TO_RIGHT = (
    *(Ground.SOURCE_AREA, Ground.DROP_ZONE, Ground.LEFT_LEG, Ground.BOTTOM, Ground.MIDDLE_PICK_ZONE),
    *(Ground.MIDDLE_AREA, Ground.MIDDLE_LEG, Ground.CROSSING, Ground.MIDDLE_DROP_ZONE),
    *(Ground.RIGHT_LEG, Ground.PICK_ZONE, Ground.NEST_AREA),
)

Box = tuple[float, float, float, float]  # left, bottom, right, top (m)


class Arena(NamedTuple):
    """What stands still. Booths in the order source, nest, cache towards the source, cache towards the nest."""

    corners: np.ndarray  # (4, 2) m
    booths: np.ndarray  # (B, 3): x, y (m) of each booth's middle and the direction into its bay (rad)
    places: tuple[int, ...]  # (B,) Place
    pairs: tuple[int, ...]  # (B,) number of the cache pair, -1 for none
    caches: tuple[int, ...]  # (B,) number of the cache, 0 for none
    segments: np.recarray  # SEGMENT: walls, then booth k as group k + 1, then block and cache
    solids: tuple[np.ndarray, ...]  # outlines of the block and of the cache's column
    floor: np.recarray  # PATCH
    lamp: tuple[float, float]  # m
    source_area: Box
    nest_area: Box
    middle_area: Box | None  # with three areas only


def make_arena(table: ArenaTable) -> Arena:
    """Return the arena of a table."""
    t = table
    width, height = total_width(t), t.height
    corners = np.array([(0.0, 0.0), (width, 0.0), (width, height), (0.0, height)])
    booths, places, pairs = _booths(t)
    columns = columns_of(t)
    legs = legs_of(t)
    blocks = [
        [(left, t.bottom_width), (right, t.bottom_width), (right, t.block_top), (left, t.block_top)]
        for (_, left), (right, _) in itertools.pairwise(legs)
    ]
    count = len(booths)
    outlines = [booth_outline(x, y, way, t.friction, k + 1) for k, (x, y, way) in enumerate(booths)]
    segments = joined(
        outline([(float(x), float(y)) for x, y in corners], t.friction),
        *outlines,
        *(outline(block, t.friction, True, count + 1 + k) for k, block in enumerate(blocks)),
        *(
            chain(line, t.friction, True, count + 1 + len(blocks) + k)
            for k, (left, right) in enumerate(columns)
            for line in _column(t, left, right)
        ),
    )
    whole = [
        np.array([(left, t.block_top), (right, t.block_top), (right, height), (left, height)])
        for left, right in columns
    ]
    middle = (columns[0][1], t.block_top, columns[1][0], height) if t.subtasks == 3 else None
    return Arena(
        corners=corners,
        booths=np.array(booths),
        places=tuple(places),
        pairs=tuple(pairs),
        caches=tuple(max(0, pair) // t.cache_pairs for pair in pairs),
        segments=segments,
        solids=(*(np.array(block) for block in blocks), *whole),
        floor=_floor(t),
        lamp=(0.5 * width, 0.0),
        source_area=(2 * HALF, t.block_top, columns[0][0], height),
        nest_area=(columns[-1][1], t.block_top, width - 2 * HALF, height),
        middle_area=middle,
    )


def total_width(t: ArenaTable) -> float:
    """Return the width (m): with three areas the middle one and a second cache are put in."""
    return t.width if t.subtasks == 2 else t.width + t.middle_width + t.cache_depth


def columns_of(t: ArenaTable) -> list[tuple[float, float]]:
    """Return left and right (m) of each cache."""
    left, right = 0.5 * (t.width - t.cache_depth), 0.5 * (t.width + t.cache_depth)
    shift = t.middle_width + t.cache_depth
    return [(left, right)] if t.subtasks == 2 else [(left, right), (left + shift, right + shift)]


def legs_of(t: ArenaTable) -> list[tuple[float, float]]:
    """Return left and right (m) of the corridor's upright parts."""
    width = total_width(t)
    outer = [(0.0, t.leg_width), (width - t.leg_width, width)]
    if t.subtasks == 3:
        outer.insert(1, (0.5 * (width - t.leg_width), 0.5 * (width + t.leg_width)))
    return outer


def shades_of(t: ArenaTable) -> dict[Ground, float]:
    """Return the shade of each part of the floor; with three areas all twelve are spread evenly."""
    if t.subtasks == 2:
        return {
            Ground.SOURCE_AREA: t.source_shade,
            Ground.DROP_ZONE: t.drop_zone_shade,
            Ground.LEFT_LEG: t.left_leg_shade,
            Ground.BOTTOM: t.bottom_shade,
            Ground.RIGHT_LEG: t.right_leg_shade,
            Ground.PICK_ZONE: t.pick_zone_shade,
            Ground.NEST_AREA: t.nest_shade,
        }
    return dict(zip(LEFT_TO_RIGHT, np.linspace(t.source_shade, DARKEST, len(LEFT_TO_RIGHT)).tolist(), strict=True))


def _booths(t: ArenaTable) -> tuple[list[tuple[float, float, float]], list[int], list[int]]:
    terminal = [t.height - t.terminal_top - k * t.booth_pitch for k in range(t.terminal_booths)]
    cache = [t.height - t.cache_top - k * t.booth_pitch for k in range(t.cache_pairs)]
    rows = [
        *((HALF, y, math.pi, Place.SOURCE, -1) for y in terminal),
        *((total_width(t) - HALF, y, 0.0, Place.NEST, -1) for y in terminal),
    ]
    for number, (left, right) in enumerate(columns_of(t)):
        middle, apart = 0.5 * (left + right), 0.5 * t.cache_depth - HALF
        first = number * t.cache_pairs
        rows += [(middle - apart, y, 0.0, Place.CACHE_DROP, first + k) for k, y in enumerate(cache)]
        rows += [(middle + apart, y, math.pi, Place.CACHE_PICK, first + k) for k, y in enumerate(cache)]
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


def _floor(t: ArenaTable) -> Any:
    """Return the shades: areas, the caches' access zones, the corridor's parts, and the path on top."""
    width, height, shades, columns = total_width(t), t.height, shades_of(t), columns_of(t)
    half, below = 0.5 * t.path_width, 0.5 * t.bottom_width
    near, far = 0.5 * t.leg_width, width - 0.5 * t.leg_width
    (left, _), (_, right) = columns[0], columns[-1]
    parts = [
        (0.0, t.bottom_width, t.leg_width, t.block_top, shades[Ground.LEFT_LEG]),
        (width - t.leg_width, t.bottom_width, width, t.block_top, shades[Ground.RIGHT_LEG]),
        (0.0, 0.0, width, t.bottom_width, shades[Ground.BOTTOM]),
    ]
    if t.subtasks == 2:
        middle = 0.5 * width
        parts += [
            (0.0, t.block_top, middle, height, shades[Ground.SOURCE_AREA]),
            (middle, t.block_top, width, height, shades[Ground.NEST_AREA]),
        ]
    else:
        (start, end), (one, other) = legs_of(t)[1], (columns[0][1], columns[1][0])
        parts += [
            (start, t.bottom_width, end, t.block_top, shades[Ground.MIDDLE_LEG]),
            (start, 0.0, end, t.bottom_width, shades[Ground.CROSSING]),
            (0.0, t.block_top, left, height, shades[Ground.SOURCE_AREA]),
            (one, t.block_top, other, height, shades[Ground.MIDDLE_AREA]),
            (right, t.block_top, width, height, shades[Ground.NEST_AREA]),
            (one, t.block_top, one + t.zone_depth, height, shades[Ground.MIDDLE_PICK_ZONE]),
            (other - t.zone_depth, t.block_top, other, height, shades[Ground.MIDDLE_DROP_ZONE]),
            (0.5 * width - half, below, 0.5 * width + half, t.block_top, t.path_shade),
        ]
    parts += [
        (left - t.zone_depth, t.block_top, left, height, shades[Ground.DROP_ZONE]),
        (right, t.block_top, right + t.zone_depth, height, shades[Ground.PICK_ZONE]),
        (near - half, below - half, near + half, t.block_top, t.path_shade),
        (far - half, below - half, far + half, t.block_top, t.path_shade),
        (near - half, below - half, far + half, below + half, t.path_shade),
    ]
    return patches(parts)

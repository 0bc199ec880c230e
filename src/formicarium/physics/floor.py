"""The floor: grey rectangles, each lying on those before it."""

import math
from typing import Any

import numpy as np

from formicarium.compiled import compiled
from formicarium.physics.records import records

# A rectangle of one shade.
PATCH = np.dtype(
    [
        ("x", "f8"),  # m, of the middle
        ("y", "f8"),  # m
        ("cosine", "f8"),  # of the direction of its length
        ("sine", "f8"),
        ("half_length", "f8"),  # m
        ("half_width", "f8"),  # m
        ("shade", "f8"),  # 0 black .. 1 white
    ],
    align=True,
)

BARE = 0.0  # shade where no patch lies


def patches(rectangles: list[tuple[float, float, float, float, float]]) -> Any:
    """Return patches from (left, bottom, right, top, shade) in metres, the later ones on top."""
    floor = records(PATCH, len(rectangles))
    for patch, (left, bottom, right, top, shade) in zip(floor, rectangles, strict=True):
        patch.x, patch.y = 0.5 * (left + right), 0.5 * (bottom + top)
        patch.half_length, patch.half_width = 0.5 * (right - left), 0.5 * (top - bottom)
        patch.cosine, patch.shade = 1.0, shade
    return floor


def corners(patch: Any) -> np.ndarray:
    """Return the four corners (m) of a patch, counter-clockwise."""
    ahead = np.array([patch.cosine, patch.sine]) * patch.half_length
    aside = np.array([-patch.sine, patch.cosine]) * patch.half_width
    middle = np.array([patch.x, patch.y])
    return np.array([middle + a * ahead + b * aside for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1))])


@compiled
def shade_at(floor, x, y):
    """Return the shade of the floor at a place (m): that of the topmost patch there."""
    for number in range(len(floor) - 1, -1, -1):
        patch = floor[number]
        dx = x - patch.x
        dy = y - patch.y
        along = math.fabs(patch.cosine * dx + patch.sine * dy)
        across = math.fabs(patch.cosine * dy - patch.sine * dx)
        if along <= patch.half_length and across <= patch.half_width:
            return patch.shade
    return BARE

"""Arenas side by side, to one scale, with the robots where they start."""

from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

import numpy as np
from matplotlib.collections import EllipseCollection

from formicarium.trial.record import Scene
from formicarium.views.figure import new_figure, save
from formicarium.views.outlines import hull
from formicarium.views.style import FLOOR, INK, NAMED, PALE_INK, colour

SCALE = 0.62  # inches a metre
EDGE = 0.03  # m round an arena
GAP, TITLE, TOP, BOTTOM = 0.3, 0.6, 0.5, 0.45  # inches


class Ground(NamedTuple):
    """An arena with its robots."""

    title: str
    note: str
    scene: Scene
    places: np.ndarray  # (N, 2) m


def draw_arenas(title: str, rows: Sequence[Sequence[Ground]], path: Path) -> Path:
    """Draw rows of arenas and return the path.

    Raises:
        StoreError: if the file cannot be written.
    """
    sizes = [[(np.ptp(_points(ground.scene), axis=0) + 2 * EDGE) * SCALE for ground in row] for row in rows]
    width = max(sum(max(size[0], 1.5) + GAP for size in row) for row in sizes) + GAP
    height = TOP + sum(max(size[1] for size in row) + TITLE for row in sizes) + BOTTOM
    figure = new_figure(width, height)
    low = height - TOP
    for row, row_sizes in zip(rows, sizes):
        low -= max(size[1] for size in row_sizes) + TITLE
        left = GAP
        for ground, (wide, high) in zip(row, row_sizes):
            axes = figure.add_axes((left / width, low / height, wide / width, high / height))
            axes.set_axis_off()
            _draw(axes, ground)
            figure.text(left / width, (low + high + 0.25) / height, ground.title, size=10, color=INK)
            figure.text(left / width, (low + high + 0.08) / height, ground.note, size=9, color=PALE_INK)
            left += max(wide, 1.5) + GAP
    figure.text(GAP / width, 1 - 0.25 / height, title, size=13, color=INK, weight="bold", va="center")
    scale = figure.add_axes((GAP / width, 0.15 / height, SCALE / width, 0.02 / height), facecolor=INK)
    scale.set(xticks=[], yticks=[])
    figure.text((GAP + SCALE + 0.1) / width, 0.12 / height, "1 m", size=9.5, color=INK)
    return save(figure, path)


def _points(scene: Scene) -> np.ndarray:
    return np.concatenate([polygon.points for polygon in scene.polygons])


def _draw(axes, ground: Ground) -> None:
    points = _points(ground.scene)
    for polygon in ground.scene.polygons:
        wall = polygon.colour == "wall"
        outline, fill = (polygon.points, FLOOR) if wall else (hull(polygon.points), colour(polygon.colour))
        axes.fill(*outline.T, facecolor=fill, edgecolor=NAMED["wall"] if wall else fill, linewidth=1.2)
    size = [2 * ground.scene.radius]
    axes.add_collection(
        EllipseCollection(
            size, size, [0], units="xy", offsets=ground.places, offset_transform=axes.transData,
            facecolors=INK, linewidths=0,
        )
    )  # fmt: skip
    low, high = points.min(axis=0) - EDGE, points.max(axis=0) + EDGE
    axes.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]))

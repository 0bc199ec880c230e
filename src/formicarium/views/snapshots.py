"""Several frames from above side by side, with one legend."""

from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.lines import Line2D

from formicarium.trial.record import Frames, Scene
from formicarium.views.figure import new_figure, save
from formicarium.views.overhead import HEIGHT, WIDTH, Overhead
from formicarium.views.style import INK, PALE_INK, clock, role_styles

SIDE, GAP, TITLE, TOP, BOTTOM = 2.7, 0.2, 0.5, 0.5, 0.55  # inches


class Snapshot(NamedTuple):
    """One frame of a trial with its title."""

    title: str
    scene: Scene
    frames: Frames
    number: int


def draw_snapshots(title: str, rows: Sequence[Sequence[Snapshot]], path: Path) -> Path:
    """Draw rows of frames and return the path.

    Raises:
        StoreError: if the file cannot be written.
    """
    width = max(len(row) for row in rows) * (SIDE + GAP) + GAP
    height = TOP + len(rows) * (SIDE + TITLE) + BOTTOM
    figure = new_figure(width, height)
    for r, row in enumerate(rows):
        for c, shot in enumerate(row):
            left, low = GAP + c * (SIDE + GAP), height - TOP - (r + 1) * (SIDE + TITLE)
            axes = figure.add_axes((left / width, low / height, SIDE / width, SIDE / height))
            axes.set_axis_off()
            axes.imshow(_picture(shot), interpolation="antialiased")
            time = clock(shot.frames.cycle[shot.number] * shot.scene.cycle_time)
            figure.text(left / width, (low + SIDE + 0.22) / height, shot.title, size=10, color=INK)
            figure.text(left / width, (low + SIDE + 0.05) / height, time, size=9, color=PALE_INK)
    figure.text(GAP / width, 1 - 0.25 / height, title, size=13, color=INK, weight="bold", va="center")
    scene = rows[0][0].scene
    marks = [
        Line2D([], [], ls="", marker="o", ms=11, mfc=style.fill, mec=INK, label=role)
        for role, style in zip(scene.roles, role_styles(scene.roles))
    ]
    place = (0.5 * GAP / width, 0.12 / height)
    figure.legend(handles=marks, loc="lower left", bbox_to_anchor=place, ncols=len(marks), frameon=False, fontsize=10)
    note = "number on a runner: tasks done so far; time in minutes : seconds"
    figure.text(1 - GAP / width, 0.27 / height, note, size=9, color=PALE_INK, ha="right")
    return save(figure, path)


def _picture(shot: Snapshot) -> np.ndarray:
    """Return a frame as an image, without the column beside the arena."""
    overhead = Overhead(shot.scene)
    overhead.show(shot.frames, shot.number)
    canvas = overhead.figure.canvas
    assert isinstance(canvas, FigureCanvasAgg)
    canvas.draw()
    image = np.asarray(canvas.buffer_rgba())
    return image[:, : round(image.shape[1] * HEIGHT / WIDTH)].copy()

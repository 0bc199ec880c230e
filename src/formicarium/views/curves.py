"""Figures of curves, drawn from their description."""

from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.ticker import FuncFormatter

from formicarium.studies.curves import CurvePanel, CurveSheet
from formicarium.views.figure import new_figure, plain, save
from formicarium.views.style import CURVES, INK, PALE_INK


def draw_curves(sheet: CurveSheet, path: Path) -> Path:
    """Draw a figure and return the path.

    Raises:
        StoreError: if the file cannot be written.
    """
    rows, columns = len(sheet.panels), max(len(row) for row in sheet.panels)
    width, height = 0.9 + max(6.3, 4.3 * columns), 1.2 + max(3.7, 3.1 * rows)
    figure = new_figure(width, height)
    grid = figure.subplots(rows, columns, squeeze=False)
    for axes_row, panels in zip(grid, sheet.panels, strict=True):
        for axes, panel in zip(axes_row, panels, strict=False):
            _draw(axes, panel)
        for axes in axes_row[len(panels) :]:
            axes.set_visible(False)
    figure.subplots_adjust(
        left=0.8 / width, right=1 - 0.2 / width, bottom=0.55 / height, top=1 - 0.95 / height, wspace=0.27, hspace=0.42
    )
    figure.text(0.8 / width, 1 - 0.25 / height, sheet.title, size=12.5, color=INK, weight="bold", va="center")
    figure.text(0.8 / width, 1 - 0.5 / height, sheet.note, size=9, color=PALE_INK, va="center")
    return save(figure, path)


def _draw(axes: Axes, panel: CurvePanel) -> None:
    plain(axes, grid="y")
    axes.set_title(panel.title, loc="left", size=10.5, color=INK)
    axes.set_xlabel(panel.across, size=9.5)
    axes.set_ylabel(panel.up, size=9.5)
    for line in panel.lines:
        colour = CURVES[line.shade % len(CURVES)]
        axes.plot(line.across, _finite(line.up), color=colour, lw=1.4, label=line.label or None)
        if line.band is not None:
            axes.fill_between(line.across, _finite(line.band[0]), _finite(line.band[1]), color=colour, alpha=0.15, lw=0)
    for marks in panel.marks:
        colour = CURVES[marks.shade % len(CURVES)]
        few = slice(None, None, max(1, len(marks.across) // 40))
        axes.plot(
            marks.across[few], marks.up[few], "o", ms=3.2, mfc="none", mec=colour, mew=0.8, label=marks.label or None
        )
    if panel.logarithmic:
        axes.set_yscale("log")
        axes.yaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    if panel.span:
        axes.set_ylim(*panel.span)
    for level, label in panel.limits:
        axes.axhline(level, color=PALE_INK, ls=(0, (4, 3)), lw=0.9)
        axes.annotate(label, (1.0, level), (-3, 2), xycoords=("axes fraction", "data"), textcoords="offset points",
                      ha="right", size=8, color=PALE_INK)  # fmt: skip
    if any(line.label for line in panel.lines):
        axes.legend(frameon=False, fontsize=8.5, loc="best")


def _finite(values: np.ndarray) -> np.ndarray:
    return np.where(np.isfinite(values), values, np.nan)

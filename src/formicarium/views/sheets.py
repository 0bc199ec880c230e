"""Figures of studies, drawn from their description."""

from itertools import cycle
from pathlib import Path
from typing import Any

import matplotlib
import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.ticker import MaxNLocator, NullFormatter, PercentFormatter, StrMethodFormatter

from formicarium.studies.sheet import Box, Curve, Panel, Sheet
from formicarium.views.figure import new_figure, plain, save
from formicarium.views.style import CURVES, GRID, INK, PALE_INK, PAPER, colour

TOP, BOTTOM, LEFT, RIGHT = 0.95, 0.6, 0.75, 0.35  # inches around the panels
ACROSS, UP = 0.7, 0.95  # inches between two panels
FLAG = CURVES[1]


def draw_sheet(sheet: Sheet, path: Path) -> Path:
    """Draw a figure and return the path; panels without data say so.

    Raises:
        StoreError: if the file cannot be written.
    """
    rows, columns = len(sheet.panels), max(len(row) for row in sheet.panels)
    wide, high = {1: (6.6, 4.4), 2: (5.2, 3.9), 3: (4.3, 3.1)}.get(columns, (3.0, 2.35))
    shades = [colour(name) for name in sheet.colours] or [
        matplotlib.colormaps["viridis_r"](x) for x in np.linspace(0.08, 1.0, max(len(sheet.shades), 1))
    ]
    keys = _keys(sheet, shades)
    width = LEFT + columns * wide + (columns - 1) * ACROSS + RIGHT
    height = TOP + (0.4 if keys else 0.0) + rows * high + (rows - 1) * UP + BOTTOM
    figure = new_figure(width, height)
    for r, row in enumerate(sheet.panels):
        for c, panel in enumerate(row):
            x = LEFT + c * (wide + ACROSS)
            y = BOTTOM + (rows - 1 - r) * (high + UP)
            axes = figure.add_axes((x / width, y / height, wide / width, high / height))
            _draw_panel(axes, panel, shades, names_up=c == 0 or row[c - 1].up != panel.up)
    figure.text(LEFT / width, 1 - 0.24 / height, sheet.title, size=13, color=INK, weight="bold", va="center")
    if keys:
        style: dict[str, Any] = {"frameon": False, "fontsize": 9.5, "columnspacing": 1.5, "borderaxespad": 0.0}
        place = ((LEFT - 0.05) / width, 1 - 0.45 / height)
        figure.legend(handles=keys, loc="upper left", bbox_to_anchor=place, ncols=len(keys), **style)
    return save(figure, path)


def _keys(sheet: Sheet, shades: list) -> list[Artist]:
    keys: list[Artist] = [Line2D([], [], color=INK, lw=1.8, ls=style, label=label) for style, label in sheet.styles]
    keys += [Line2D([], [], color=shades[k], lw=4, label=label) for k, label in enumerate(sheet.shades)]
    if any(curve.band for row in sheet.panels for panel in row for curve in panel.curves):
        keys.append(Patch(color=CURVES[0], alpha=0.13, lw=0, label=f"95 % band of {sheet.styles[-1][1]}"))
    if sheet.flag:
        keys.append(Line2D([], [], color=FLAG, lw=0, marker="x", markersize=5, label=sheet.flag))
    return keys


def _draw_panel(axes: Axes, panel: Panel, shades: list, *, names_up: bool) -> None:
    plain(axes, grid="both" if panel.curves else "y")
    axes.set_title(panel.title, loc="left", size=10.5, color=INK, pad=20 if panel.title else 6)
    axes.annotate(panel.note, (0, 1), (0, 6), "axes fraction", textcoords="offset points", size=9, color=PALE_INK)
    axes.set_xlabel(panel.across, size=10)
    if names_up:
        axes.set_ylabel(panel.up, size=10)
    for place, label in panel.limits:
        axes.axvline(place, color=PALE_INK, lw=1, ls=(0, (4, 3)))
        axes.annotate(label, (place, 0.02), (5, 0), textcoords="offset points", size=9, color=PALE_INK)
    for curve in panel.curves:
        tint = INK if curve.shade is None else shades[curve.shade]
        _draw_curve(axes, curve, (panel.start, panel.end or curve.times.end), tint)
    for place, share, label in panel.ratios:
        reach = [[share.value - share.low], [share.high - share.value]]
        axes.errorbar([place], [share.value], reach, fmt="D", color=FLAG, ms=5, capsize=4, lw=1.6, zorder=5)
        axes.plot([], [], "D", color=FLAG, ms=5, label=label)
        axes.legend(loc="lower right", bbox_to_anchor=(1, 0.08), facecolor=PAPER, edgecolor="none", fontsize=9)
    for box in panel.boxes:
        _draw_box(axes, box, panel, INK if box.shade is None else shades[box.shade])
    if panel.line and panel.boxes:
        line, label = panel.line
        ends = [0.95 * min(box.place for box in panel.boxes), 1.03 * max(box.place for box in panel.boxes)]
        axes.plot(ends, [line.at(x) for x in ends], color=FLAG, lw=1.6, label=label, zorder=1)
        axes.legend(loc="upper left", frameon=False, fontsize=9.5)
    if panel.boxes and not panel.ticks:
        axes.set_xticks([box.place for box in panel.boxes], [f"{box.place:.2f}" for box in panel.boxes])
    if panel.ticks:
        axes.set_xticks(range(len(panel.ticks)), panel.ticks)
        axes.set_xlim(-0.6, len(panel.ticks) - 0.4)
    if panel.boxes:
        axes.set_ylim(0, 1.08 * max(1.0, *(max(box.values) for box in panel.boxes)))
        axes.yaxis.set_major_locator(MaxNLocator(6, integer=True))
    elif panel.end is not None:
        axes.set(xlim=(panel.start, panel.end * (1.25 if panel.start else 1.0)), ylim=(0, 1.03))
        if panel.start:
            axes.set_xscale("log")
            axes.xaxis.set_minor_formatter(NullFormatter())
        else:
            axes.xaxis.set_major_locator(MaxNLocator(4))
        axes.xaxis.set_major_formatter(StrMethodFormatter("{x:,.0f}"))
        axes.yaxis.set_major_formatter(PercentFormatter(1.0, decimals=0))
    if not panel.curves and not panel.boxes:
        axes.set_yticks([])
        axes.text(0.5, 0.5, "no runs yet", transform=axes.transAxes, ha="center", color=PALE_INK)


def _draw_curve(axes: Axes, curve: Curve, ends: tuple[float, float], tint: Any) -> None:
    times = curve.times
    x = np.concatenate([[ends[0]], times.times, [ends[1]]])
    axes.step(x, [0.0, *times.share, times.share[-1]], where="post", color=tint, lw=1.8, ls=curve.style)
    if curve.band:
        low, high = [0.0, *times.low, times.low[-1]], [np.nan, *times.high, times.high[-1]]
        axes.fill_between(x, low, high, step="post", color=CURVES[0], alpha=0.13, lw=0)


def _draw_box(axes: Axes, box: Box, panel: Panel, tint: Any) -> None:
    width = 0.55 if panel.ticks else 0.12
    axes.boxplot(
        [box.values], positions=[box.place], widths=width, manage_ticks=False, patch_artist=True,
        boxprops={"facecolor": GRID, "edgecolor": tint, "linewidth": 1.4},
        whiskerprops={"color": tint, "linewidth": 1.2}, capprops={"color": tint, "linewidth": 1.2},
        medianprops={"color": tint, "linewidth": 2},
        whis=(0, 100),
    )  # fmt: skip
    beside = cycle((-0.12, 0.0, 0.12))
    places = [box.place + width * (0.5 + next(beside)) for _ in box.flagged]
    axes.plot(places, sorted(box.flagged), "x", color=FLAG, ms=4, mew=1.1, zorder=4)

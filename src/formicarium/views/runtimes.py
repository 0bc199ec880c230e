"""Run-time distributions of a set, with the published runs drawn over them."""

from collections.abc import Mapping
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from matplotlib.ticker import PercentFormatter

from formicarium.statistics.runtimes import RunTimes
from formicarium.views.figure import new_figure, plain, save
from formicarium.views.style import CURVES, INK, PALE_INK


def draw_run_times(
    measured: Mapping[str, RunTimes],
    published: Mapping[str, RunTimes],
    path: Path,
    *,
    title: str = "",
    published_label: str = "published",
) -> Path:
    """Draw the share of runs that had reached each target by time t, and return the path.

    Args:
        measured: label of the target -> distribution of the runs of the set; drawn solid with its band.
        published: label of the target -> distribution of the published runs; drawn dashed with points.
        path: of the picture.
        title: above the picture.
        published_label: what the published runs are.

    Raises:
        StoreError: if the file cannot be written.
    """
    figure = new_figure(8.0, 5.6)
    axes = figure.add_axes((0.095, 0.11, 0.875, 0.665))
    colours = dict(zip(dict.fromkeys([*measured, *published]), CURVES * 3))
    end = max((d.end for d in [*measured.values(), *published.values()]), default=1.0)
    for label, distribution in measured.items():
        _draw_measured(axes, distribution, end, colours[label])
    for label, distribution in published.items():
        _draw_published(axes, distribution, end, colours[label])
    axes.set(xlim=(0, end), ylim=(0, 1.03))
    axes.set_xlabel("simulated time (s)", size=10.5)
    axes.set_ylabel("runs that have reached the target", size=10.5)
    axes.yaxis.set_major_formatter(PercentFormatter(1.0, decimals=0))
    plain(axes, grid="both")
    runs = max((d.runs for d in measured.values()), default=0)
    targets = [Line2D([], [], color=colours[label], linewidth=3, label=label) for label in colours]
    counted = f"{runs} simulated run{'s' * (runs != 1)}"
    sources = [
        Line2D([], [], color=PALE_INK, linewidth=2, label=f"{counted}, 95 % band"),
        Line2D(
            [],
            [],
            color=PALE_INK,
            linewidth=1.4,
            linestyle="--",
            marker="o",
            markersize=4,
            label=f"published: {published_label}",
        ),
    ]
    figure.text(0.095, 0.958, title, size=12, color=INK, weight="bold", va="center")
    style = {"frameon": False, "fontsize": 9.5, "columnspacing": 1.6, "borderaxespad": 0.0}
    figure.legend(handles=targets, loc="upper left", bbox_to_anchor=(0.087, 0.93), ncols=len(targets), **style)
    figure.legend(
        handles=sources[: 2 if published else 1],
        loc="upper left",
        bbox_to_anchor=(0.087, 0.885),
        ncols=1,
        **style,
    )
    return save(figure, path)


def _draw_measured(axes: Axes, distribution: RunTimes, end: float, colour: str) -> None:
    times, share = _steps(distribution, distribution.share, 0.0, end)
    axes.step(times, share, where="post", color=colour, linewidth=2.2)
    _, low = _steps(distribution, distribution.low, np.nan, end)
    _, high = _steps(distribution, distribution.high, np.nan, end)
    axes.fill_between(times, low, high, step="post", color=colour, alpha=0.13, linewidth=0)


def _draw_published(axes: Axes, distribution: RunTimes, end: float, colour: str) -> None:
    axes.step(*_steps(distribution, distribution.share, 0.0, end), where="post", color=colour, lw=1.4, ls="--")
    new = np.diff(np.concatenate([[0.0], distribution.share])) > 0
    axes.plot(distribution.times[new], distribution.share[new], "o", color=colour, markersize=4, clip_on=False)


def _steps(distribution: RunTimes, values: np.ndarray, before: float, end: float) -> tuple[np.ndarray, np.ndarray]:
    """Corners of a step curve from its first rise to the end of its runs, or of the axis if all are there."""
    last = end if distribution.reached == distribution.runs else distribution.end
    times = np.concatenate([distribution.times[:1], distribution.times, [last]])
    return times, np.concatenate([[before], values, values[-1:]])

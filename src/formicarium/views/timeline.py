"""Who was what when, what happened, and what was achieved: one trial on one page."""

from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import PolyCollection
from matplotlib.patches import Patch
from matplotlib.ticker import MaxNLocator

from formicarium.trial.record import Timeline
from formicarium.views.figure import new_figure, plain, save
from formicarium.views.style import CURVES, INK, PALE_INK, clock, role_styles

LANE = 0.14  # inches a robot
MARK_ROW = 0.2  # inches a kind of mark
LABELLED = 25  # with more lanes than this only some get a label


def draw_timeline(
    timeline: Timeline, roles: tuple[str, ...], path: Path, title: str = "", counted: str = "sequences done"
) -> Path:
    """Draw lanes of roles, rows of marks and the curve of what was counted; return the path.

    Args:
        timeline: what to draw.
        roles: names of the role numbers.
        path: of the picture.
        title: above the picture.
        counted: label of the curve.

    Raises:
        StoreError: if the file cannot be written.
    """
    kinds = list(dict.fromkeys(label for _, label in timeline.marks))
    heights = [max(LANE * len(timeline.lanes), 1.2), MARK_ROW * max(len(kinds), 1), 1.5]
    figure = new_figure(9.6, sum(heights) + 1.6)
    lanes, marks, curve = figure.subplots(
        3, 1, sharex=True, gridspec_kw={"height_ratios": heights, "hspace": 0.09 / (sum(heights) / 5)}
    )
    _draw_lanes(lanes, timeline, roles)
    _draw_marks(marks, timeline, kinds)
    _draw_counts(curve, timeline, counted)
    marks.set_visible(bool(kinds))
    total = figure.get_figheight()
    figure.subplots_adjust(left=0.155, right=0.965, top=1 - 0.75 / total, bottom=0.55 / total)
    figure.text(0.155, 1 - 0.25 / total, title, size=12, color=INK, weight="bold", va="center")
    return save(figure, path)


def _draw_lanes(axes: Axes, timeline: Timeline, roles: tuple[str, ...]) -> None:
    styles = role_styles(roles)
    boxes = [
        [(s.start, s.lane - 0.4), (s.end, s.lane - 0.4), (s.end, s.lane + 0.4), (s.start, s.lane + 0.4)]
        for s in timeline.spans
    ]
    fills = [styles[span.role].fill for span in timeline.spans]
    axes.add_collection(PolyCollection(boxes, facecolors=fills, linewidths=0), autolim=False)
    axes.set(xlim=(0, timeline.duration), ylim=(-0.7, len(timeline.lanes) - 0.3))
    step = 1 if len(timeline.lanes) <= LABELLED else 5
    shown = range(0, len(timeline.lanes), step)
    axes.set_yticks(list(shown), [timeline.lanes[lane] for lane in shown])
    plain(axes)
    axes.tick_params(labelsize=8, length=0, labelbottom=False)
    axes.spines[["left", "bottom"]].set_visible(False)
    present = sorted({span.role for span in timeline.spans})
    handles = [
        Patch(facecolor=styles[role].fill, edgecolor=PALE_INK, linewidth=0.5, label=roles[role]) for role in present
    ]
    axes.legend(
        handles=handles,
        loc="lower right",
        bbox_to_anchor=(1, 1),
        ncols=len(handles),
        frameon=False,
        fontsize=9.5,
        handlelength=1.2,
        handleheight=0.9,
        columnspacing=1.4,
        borderaxespad=0.2,
    )


def _draw_marks(axes: Axes, timeline: Timeline, kinds: list[str]) -> None:
    for row, kind in enumerate(kinds):
        times = [time for time, label in timeline.marks if label == kind]
        axes.vlines(times, row - 0.36, row + 0.36, color=INK, linewidth=1.1)
    axes.set_ylim(max(len(kinds), 1) - 0.4, -0.6)
    axes.set_yticks(range(len(kinds)), kinds)
    plain(axes, grid="y")
    axes.tick_params(labelsize=8.5, length=0, labelbottom=False)
    axes.spines[["left", "bottom"]].set_visible(False)


def _draw_counts(axes: Axes, timeline: Timeline, counted: str) -> None:
    times = np.sort(np.array([0.0, *timeline.counts, timeline.duration]))
    numbers = np.append(np.arange(len(times) - 1), len(times) - 2)
    axes.step(times, numbers, where="post", color=CURVES[0], linewidth=2)
    axes.fill_between(times, numbers, step="post", color=CURVES[0], alpha=0.12, linewidth=0)
    axes.set_ylim(0, max(len(timeline.counts), 1) * 1.12)
    axes.yaxis.set_major_locator(MaxNLocator(5, integer=True, steps=[1, 2, 5, 10]))
    axes.set_xlabel("time (minutes : seconds)", size=10.5)
    axes.set_ylabel(counted, size=10.5)
    step = next((s for s in (10, 30, 60, 120, 300, 600, 1800, 3600) if timeline.duration / s <= 12), 7200)
    axes.set_xticks(np.arange(0, timeline.duration + 1e-9, step))
    axes.xaxis.set_major_formatter(lambda seconds, _: clock(seconds))
    plain(axes, grid="both")

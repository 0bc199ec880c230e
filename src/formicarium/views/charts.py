"""Charts of studies, drawn from their description."""

from pathlib import Path
from typing import Any

from matplotlib.axes import Axes
from matplotlib.patches import Patch

from formicarium.studies.chart import Chart, Panel
from formicarium.views.figure import new_figure, plain, save
from formicarium.views.style import CURVES, GRID, INK, PALE_INK

MARKERS = "osD^v"
SHADES = ("#4a4f57", "#b9bec5", "#ffffff", "#7d848d")  # parts of a bar, from the bottom (three as in Fig. 8)
LONG_TICKS = 60  # letters of all ticks of a panel; with more they stand on end


def draw_chart(chart: Chart, path: Path) -> Path:
    """Draw a chart and return the path.

    Raises:
        StoreError: if the file cannot be written.
    """
    columns = len(chart.panels)
    figure = new_figure(1.2 + 5.2 * columns, 4.9)
    found = figure.subplots(1, columns, squeeze=False)[0]
    for axes, panel in zip(found, chart.panels, strict=True):
        _draw_panel(axes, panel)
    width = figure.get_figwidth()
    room = 0.42 if any(map(_stand_on_end, chart.panels)) else 0.15
    figure.subplots_adjust(left=0.75 / width, right=1 - 0.2 / width, bottom=room, top=0.8, wspace=0.22)
    figure.text(0.75 / width, 0.95, chart.title, size=12.5, color=INK, weight="bold", va="center")
    figure.text(0.75 / width, 0.9, chart.note, size=9, color=PALE_INK, va="center")
    if chart.keys:
        handles = [
            Patch(facecolor=shade, edgecolor=PALE_INK, label=key)
            for key, shade in zip(chart.keys, SHADES, strict=False)
        ]
        figure.legend(handles=handles, loc="upper right", ncols=len(handles), frameon=False, fontsize=9.5)
    return save(figure, path)


def _draw_panel(axes: Axes, panel: Panel) -> None:
    plain(axes, grid="y")
    axes.set_title(panel.title, loc="left", size=10.5, color=INK)
    axes.set_xlabel(panel.across, size=10)
    axes.set_ylabel(panel.up, size=10)
    for number, trace in enumerate(panel.traces):
        values = [mean.value for mean in trace.means]
        below = [mean.value - mean.low for mean in trace.means]
        above = [mean.high - mean.value for mean in trace.means]
        style: dict[str, Any] = {
            "color": CURVES[number % len(CURVES)],
            "marker": MARKERS[number % len(MARKERS)],
            "ms": 5,
            "lw": 1.6,
        }
        axes.errorbar(trace.across, values, [below, above], capsize=3, label=trace.label, **style)
    if panel.traces:
        axes.legend(frameon=False, fontsize=9.5)
        axes.set_ylim(bottom=0)
    for place, stack in enumerate(panel.stacks):
        bottom = 0.0
        for part, shade in zip(stack.parts, SHADES, strict=False):
            axes.bar(place, part, bottom=bottom, color=shade, edgecolor=PALE_INK, width=0.7)
            bottom += part
    for place, spread in enumerate(panel.spreads):
        low, first, middle, third, high = spread.percentiles
        axes.plot([place, place], [low, high], color=INK, lw=1.2)
        axes.bar(place, third - first, bottom=first, color=GRID, edgecolor=INK, width=0.55)
        axes.plot([place - 0.27, place + 0.27], [middle, middle], color=CURVES[1], lw=2)
    ticks = _ticks(panel)
    if ticks:
        axes.set_xticks(range(len(ticks)), ticks, rotation=90 if _stand_on_end(panel) else 0)
    if panel.limit:
        axes.axvline(panel.limit[0], color=PALE_INK, ls=(0, (4, 3)), lw=1)
        axes.annotate(panel.limit[1], (panel.limit[0], 0.02), (5, 0), textcoords="offset points", size=9)


def _ticks(panel: Panel) -> list[str]:
    return [stack.tick for stack in panel.stacks] + [spread.tick for spread in panel.spreads]


def _stand_on_end(panel: Panel) -> bool:
    return sum(map(len, _ticks(panel))) > LONG_TICKS

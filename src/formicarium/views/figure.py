"""Figures without global state, written whole."""

from pathlib import Path
from warnings import catch_warnings, filterwarnings

from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from formicarium.campaigns.files import replacing
from formicarium.views.style import GRID, INK, PALE_INK, PAPER

DOTS_PER_INCH = 125


def new_figure(width: float, height: float) -> Figure:
    """Return an empty figure with its own Agg canvas; width and height in inches."""
    figure = Figure(figsize=(width, height), dpi=DOTS_PER_INCH, facecolor=PAPER)
    FigureCanvasAgg(figure)
    return figure


def save(figure: Figure, path: Path) -> Path:
    """Write a figure in the format of the path's suffix; the file appears whole or not at all."""
    with replacing(path) as temporary, catch_warnings():
        filterwarnings("ignore", "Glyph")  # a letter that the font lacks is drawn as a box
        # No software version or date inside, so that equal figures are equal bytes.
        figure.savefig(temporary, metadata={"Software": None} if path.suffix == ".png" else None)
    return path


def plain(axes: Axes, *, grid: str = "") -> None:
    """Give axes the house look: no box, quiet ticks, a grid along "x", "y" or "both" if asked for."""
    for side in ("top", "right"):
        axes.spines[side].set_visible(False)
    for side in ("left", "bottom"):
        axes.spines[side].set_color(PALE_INK)
    axes.tick_params(colors=INK, labelsize=9.5, length=3, color=PALE_INK)
    axes.xaxis.label.set_color(INK)
    axes.yaxis.label.set_color(INK)
    axes.set_axisbelow(True)
    if grid:
        axes.grid(axis=grid, color=GRID, linewidth=0.8)  # type: ignore[arg-type]

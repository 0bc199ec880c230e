"""A tree of permutations with the list of its leaves, as all guardians or one of them see it."""

from collections.abc import Callable, Sequence
from pathlib import Path

from matplotlib.axes import Axes
from matplotlib.patches import Circle, Rectangle

from formicarium.views.figure import new_figure, save
from formicarium.views.style import GRID, INK, NAMED, PALE_INK, PAPER

RADIUS, STEP, LEVEL, TOP = 0.17, 0.46, 0.8, 0.75  # inches
OWN = NAMED["green"]


def draw_tree(
    title: str, leaves: Sequence[tuple[int, ...]], name: Callable[[int], str], path: Path, own: int | None = None
) -> Path:
    """Draw the tree whose leaves, left to right, are these orders of labels; return the path.

    Args:
        title: above the picture.
        leaves: orders of the labels, in the order in which they are tried.
        name: writes a label.
        path: of the picture.
        own: the only label that the guardian who looks at the tree knows; None: everything is known.

    Raises:
        StoreError: if the file cannot be written.
    """
    tasks = len(leaves[0])
    width = max(len(leaves) * STEP + 1.3, 4.6)
    list_high = 0.3 * (tasks + 1 + (own is not None))
    height = TOP + LEVEL * tasks + 0.5 + list_high + 0.2
    figure = new_figure(width, height)
    axes = figure.add_axes((0, 0, 1, 1))
    axes.set(xlim=(0, width), ylim=(0, height))
    axes.set_axis_off()
    left = (width - len(leaves) * STEP) / 2 + 0.75 * STEP
    _draw_nodes(axes, leaves, (left, height - TOP), name, own)
    below = height - TOP - LEVEL * tasks - 0.45
    for upi, leaf in enumerate(leaves):
        x = left + upi * STEP
        axes.text(x, below, str(upi), ha="center", va="center", size=9.5, color=PALE_INK)
        for place, label in enumerate(leaf):
            _box(axes, (x, below - 0.3 * (place + 1)), name(label), known=own is None or label == own, own=label == own)
        if own is not None:
            axes.text(x, below - 0.3 * (tasks + 1), str(leaf.index(own)), ha="center", va="center", size=9.5, color=OWN)
    rows = ["UPI", *(f"{place + 1}." for place in range(tasks)), *(["CND"] if own is not None else [])]
    for k, text in enumerate(rows):
        axes.text(left - 0.45, below - 0.3 * k, text, ha="right", va="center", size=9.5, color=PALE_INK)
    axes.text(0.2, height - 0.28, title, size=12, color=INK, weight="bold", va="center")
    return save(figure, path)


def _draw_nodes(
    axes: Axes, leaves: Sequence[tuple[int, ...]], start: tuple[float, float], name: Callable, own: int | None
) -> None:
    left, top = start
    places: dict[tuple[int, ...], float] = {}
    for depth in range(len(leaves[0]) + 1):
        for prefix in dict.fromkeys(leaf[:depth] for leaf in leaves):
            below = [left + k * STEP for k, leaf in enumerate(leaves) if leaf[:depth] == prefix]
            places[prefix] = sum(below) / len(below)
    for prefix, x in places.items():
        y = top - LEVEL * len(prefix)
        if prefix:
            axes.plot([places[prefix[:-1]], x], [y + LEVEL, y], color=PALE_INK, lw=1, zorder=1)
            known, mine = own is None or prefix[-1] == own, prefix[-1] == own
            axes.add_patch(Circle((x, y), RADIUS, facecolor=OWN if mine else PAPER, edgecolor=INK, lw=1, zorder=2))
            ink = PAPER if mine else INK
            axes.text(x, y, name(prefix[-1]) if known else "?", ha="center", va="center", color=ink, size=10, zorder=3)
        else:
            axes.add_patch(Circle((x, y), 0.06, facecolor=INK, lw=0, zorder=2))


def _box(axes: Axes, place: tuple[float, float], text: str, *, known: bool, own: bool) -> None:
    x, y = place
    fill = OWN if own else GRID
    axes.add_patch(Rectangle((x - 0.14, y - 0.13), 0.28, 0.26, facecolor=fill, lw=0))
    axes.text(x, y, text if known else "?", ha="center", va="center", size=10, color=PAPER if own else INK)

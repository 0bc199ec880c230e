"""Diagrams of states and plans of places, drawn from their description."""

import math
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import Circle, FancyArrowPatch, FancyBboxPatch

from formicarium.studies.diagram import Area, Disc, Machine, Plan, Plans
from formicarium.trial.record import FLOOR as FLOOR_SHADE
from formicarium.views.figure import new_figure, save
from formicarium.views.style import FLOOR, INK, NAMED, PALE_INK, PAPER, colour

BOX = (1.5, 0.5)  # inches, of a state
TOP, EDGE = 0.75, 0.25  # inches


def draw_machine(machine: Machine, path: Path) -> Path:
    """Draw a diagram of states and return the path.

    Raises:
        StoreError: if the file cannot be written.
    """
    places = np.array(list(machine.places.values()))
    width, height = places.max(axis=0) + np.array([BOX[0] / 2 + EDGE, BOX[1] / 2 + EDGE + TOP])
    figure = new_figure(width, height)
    axes = figure.add_axes((0, 0, 1, 1))
    axes.set(xlim=(0, width), ylim=(0, height))
    axes.set_axis_off()
    boxes = {}
    for name, (x, y) in machine.places.items():
        left = (x - BOX[0] / 2, y - BOX[1] / 2)
        box = FancyBboxPatch(
            left, *BOX, boxstyle="round,pad=0,rounding_size=0.16", facecolor=machine.colours[name], edgecolor=INK, lw=1
        )
        boxes[name] = axes.add_patch(box)
        words = name.replace("_", " ").lower()
        axes.text(x, y, words.replace(" to ", "\nto ") if len(words) > 14 else words, size=9.5, color=INK,
                  ha="center", va="center", linespacing=1.1)  # fmt: skip
    for arc in machine.arcs:
        chosen, bend = bool(arc.label), machine.bends.get((arc.start, arc.end), 0.0)
        ink = INK if chosen else PALE_INK
        start, end = machine.places[arc.start], machine.places[arc.end]
        axes.add_patch(
            FancyArrowPatch(
                start, end, patchA=boxes[arc.start], patchB=boxes[arc.end], connectionstyle=f"arc3,rad={bend}",
                arrowstyle="-|>", mutation_scale=12, shrinkA=1, shrinkB=2, color=ink, lw=1.5 if chosen else 1.1,
                ls="-" if chosen else (0, (4, 2)), zorder=0,
            )
        )  # fmt: skip
        if chosen:
            x, y = 0.5 * (start[0] + end[0]), 0.5 * (start[1] + end[1])
            paper = {"facecolor": PAPER, "edgecolor": "none", "pad": 1.2}
            axes.text(x, y, f"${arc.label}$", size=11, color=INK, ha="center", va="center", bbox=paper)
    axes.text(EDGE, height - 0.28, machine.title, size=12.5, color=INK, weight="bold", va="center")
    axes.text(EDGE, height - 0.52, machine.note, size=9, color=PALE_INK, va="center")
    return save(figure, path)


def draw_plans(plans: Plans, path: Path) -> Path:
    """Draw plans side by side and return the path.

    Raises:
        StoreError: if the file cannot be written.
    """
    boxes = [np.array(plan.box) for plan in plans.plans]
    sizes = [(box[2:] - box[:2]) * plans.scale for box in boxes]
    width = max(sum(size[0] + EDGE for size in sizes) + EDGE, 5.5)
    high = max(size[1] for size in sizes)
    caption = 0.25 if any(plan.title for plan in plans.plans) else 0.0
    height = high + TOP + caption + 0.1
    figure = new_figure(width, height)
    left = EDGE
    for plan, box, size in zip(plans.plans, boxes, sizes, strict=True):
        axes = figure.add_axes((left / width, 0.1 / height, size[0] / width, size[1] / height))
        axes.set(xlim=(box[0], box[2]), ylim=(box[1], box[3]))
        axes.set_axis_off()
        _draw_plan(axes, plan, plans.radius)
        figure.text(left / width, (high + 0.2) / height, plan.title, size=9, color=INK)
        left += size[0] + EDGE
    figure.text(EDGE / width, 1 - 0.28 / height, plans.title, size=12.5, color=INK, weight="bold", va="center")
    figure.text(EDGE / width, 1 - 0.52 / height, plans.note, size=8.5, color=PALE_INK, va="center")
    return save(figure, path)


def _draw_plan(axes: Axes, plan: Plan, radius: float) -> None:
    for area in plan.areas:
        axes.fill(*area.points.T, facecolor=_fill(area), edgecolor=NAMED["wall"] if area.colour == "arena" else "none",
                  linewidth=2.0 if area.colour == "arena" else 0.0)  # fmt: skip
    for points, ink in plan.lines:
        axes.plot(*points.T, color=ink, lw=1, ls=(0, (3, 2)))
    for x, y, ink in plan.dots:
        axes.plot([x], [y], ls="", marker="o", ms=6, mfc=colour(ink), mec=INK, mew=0.8, clip_on=False, zorder=5)
    for disc in plan.discs:
        _draw_disc(axes, disc, radius)
    for mark in plan.marks:
        (x, y), (right, up) = (mark.x, mark.y), mark.shift
        axes.annotate(
            mark.text, (x, y), (x + right, y + up), size=9, color=INK, ha="center", va="center", zorder=7,
            arrowprops={"arrowstyle": "-", "color": PALE_INK, "lw": 0.8, "shrinkA": 0, "shrinkB": 0},
            bbox={"facecolor": PAPER, "edgecolor": "none", "pad": 1.0},
        )  # fmt: skip


def _draw_disc(axes: Axes, disc: Disc, radius: float) -> None:
    fill = INK if disc.loaded else PAPER
    axes.add_patch(Circle((disc.x, disc.y), radius, facecolor=fill, edgecolor=INK, lw=1, zorder=6))
    forward = np.array([math.cos(disc.heading), math.sin(disc.heading)]) * radius
    (x, y), (dx, dy) = (disc.x, disc.y), forward
    axes.annotate(
        "", (x + 0.85 * dx, y + 0.85 * dy), (x - 0.6 * dx, y - 0.6 * dy), zorder=7,
        arrowprops={"arrowstyle": "-|>", "color": PAPER if disc.loaded else INK, "lw": 1.2, "shrinkA": 0, "shrinkB": 0},
    )  # fmt: skip


def _fill(area: Area) -> str:
    if area.colour.startswith(FLOOR_SHADE):
        return str(0.55 + 0.45 * float(area.colour.removeprefix(FLOOR_SHADE)))
    return FLOOR if area.colour == "arena" else colour(area.colour)

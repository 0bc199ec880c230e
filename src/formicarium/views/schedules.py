"""Schedules on paper: a map of deployment points, arms and slots (as the paper's Fig. 6), and a chart over time."""

import itertools
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import Rectangle

from formicarium.scheduling.instance import Instance
from formicarium.scheduling.schedule import Answer, Schedule, Slot
from formicarium.views.figure import new_figure, plain, save
from formicarium.views.style import CURVES, FLOOR, GRID, INK, PALE_INK, PAPER

NAMED = 40  # tasks: more have no room for their names
LONGEST = 17  # letters of a name beside the chart over time


def draw_map(instance: Instance, answer: Answer, path: Path) -> Path:
    """Draw where the swarm deploys, which arms it stretches out, and the way between; return the path.

    Raises:
        StoreError: if the file cannot be written.
    """
    schedule = answer.schedule or Schedule(())
    x0, y0, x1, y1 = instance.region
    figure = new_figure(8.2, 8.6)
    axes = figure.add_axes((0.09, 0.09, 0.88, 0.82))
    plain(axes)
    pad = 0.03 * max(x1 - x0, y1 - y0, 1e-9)
    axes.set_xlim(x0 - pad, x1 + pad)
    axes.set_ylim(y0 - pad, y1 + pad)
    axes.set_aspect("equal")
    axes.add_patch(Rectangle((x0, y0), x1 - x0, y1 - y0, facecolor=FLOOR, edgecolor=GRID, zorder=0))
    axes.set_xlabel("x, m", size=10)
    axes.set_ylabel("y, m", size=10)
    points = [instance.start, *((slot.x, slot.y) for slot in schedule.slots)]
    for number, (one, other) in enumerate(itertools.pairwise(points)):
        style: dict[str, Any] = {"arrowstyle": "-|>", "color": PALE_INK, "lw": 1.1, "shrinkA": 9, "shrinkB": 9}
        style |= {"ls": (0, (2, 3))} if number == 0 else {}
        axes.annotate("", other, one, arrowprops=style, zorder=1)
    axes.plot(*instance.start, marker="s", ms=17, color="none", mec=INK, zorder=4.5)
    for number, slot in enumerate(schedule.slots):
        _draw_slot(axes, instance, slot, number, named=len(instance.tasks) <= NAMED)
    _number_slots(axes, schedule, 0.02 * (x1 - x0 + y1 - y0) / 2)
    figure.text(0.09, 0.02, "diamond: master; circle: task, as large as its team; dots: relays; square: start",
                size=8.5, color=PALE_INK)  # fmt: skip
    figure.text(0.09, 0.965, f"{instance.name or 'schedule'}: {len(schedule.slots)} slots", size=12.5, weight="bold",
                color=INK, va="center")  # fmt: skip
    figure.text(0.09, 0.935, _note(answer, schedule), size=9, color=PALE_INK, va="center")
    return save(figure, path)


def draw_gantt(instance: Instance, answer: Answer, path: Path) -> Path:
    """Draw which task is done when; a pale bar is a slot, a full one its task. Raises as ``draw_map``."""
    schedule = answer.schedule or Schedule(())
    tasks = {task.name: task for task in instance.tasks}
    rows = sum(len(slot.arms) for slot in schedule.slots)
    figure = new_figure(8.6, 1.5 + 0.2 * min(rows, 150))
    height = figure.get_figheight()
    axes = figure.add_axes((0.14, 0.55 / height, 0.74, 1 - 1.25 / height))
    plain(axes, grid="x")
    begin, line, names = 0.0, 0, []
    for number, slot in enumerate(schedule.slots):
        shade = CURVES[number % len(CURVES)]
        axes.add_patch(Rectangle((begin, line - 0.5), slot.duration, len(slot.arms), color=shade, alpha=0.13, lw=0))
        for arm in slot.arms:
            task = tasks[arm.task]
            axes.barh(line, task.duration, left=begin, height=0.62, color=shade)
            if rows <= NAMED:
                axes.text(1.01, line, f"{task.robots} + {arm.relays}", transform=axes.get_yaxis_transform(), size=7.5,
                          va="center", color=INK)  # fmt: skip
            names.append(arm.task if len(arm.task) <= LONGEST else arm.task[: LONGEST - 1] + "…")
            line += 1
        begin += slot.duration
    axes.set_yticks(range(line), names, fontsize=7.5 if rows <= 60 else 5)
    axes.set_ylim(line - 0.4, -0.6)
    axes.set_xlim(0, max(begin, 1e-9))
    axes.set_xlabel("time; travel and eruption are not counted", size=9.5)
    if rows <= NAMED:
        axes.text(1.01, -0.9, "team + relays", transform=axes.get_yaxis_transform(), size=7.5, color=PALE_INK)
    figure.text(0.14, 1 - 0.3 / height, f"{instance.name or 'schedule'}: {len(schedule.slots)} slots", size=12.5,
                weight="bold", color=INK, va="center")  # fmt: skip
    figure.text(0.14, 1 - 0.53 / height, _note(answer, schedule), size=9, color=PALE_INK, va="center")
    return save(figure, path)


def _draw_slot(axes: Axes, instance: Instance, slot: Slot, number: int, named: bool) -> None:
    shade = CURVES[number % len(CURVES)]
    tasks = {task.name: task for task in instance.tasks}
    for arm in slot.arms:
        task = tasks[arm.task]
        hops = arm.relays // instance.paths + 1
        along = np.linspace(0.0, 1.0, hops + 1)
        xs, ys = slot.x + along * (task.x - slot.x), slot.y + along * (task.y - slot.y)
        axes.plot(xs, ys, color=shade, lw=1.2, zorder=2)
        if hops <= 60:
            axes.plot(xs[1:-1], ys[1:-1], ".", color=shade, ms=3, zorder=2)
        axes.plot(task.x, task.y, "o", ms=4 + 1.1 * min(task.robots, 12), color=PAPER, mec=shade, mew=1.6, zorder=3)
        if named:
            axes.annotate(task.name, (task.x, task.y), (6, 5), textcoords="offset points", size=8, color=INK)
    axes.plot(slot.x, slot.y, "D", ms=13, color=shade, mec=PAPER, zorder=4)


def _number_slots(axes: Axes, schedule: Schedule, near: float) -> None:
    """Write the numbers of slots; slots at the same place share a label."""
    left = list(enumerate(schedule.slots, 1))
    while left:
        first = left[0][1]
        here = [number for number, slot in left if abs(slot.x - first.x) + abs(slot.y - first.y) <= near]
        left = [(number, slot) for number, slot in left if number not in here]
        style: dict[str, Any] = {
            "ha": "center",
            "va": "center",
            "size": 8,
            "color": PAPER,
            "weight": "bold",
            "zorder": 5,
        }
        box = {"boxstyle": "round,pad=0.25", "fc": INK, "ec": PAPER} if len(here) > 1 else None
        axes.annotate(", ".join(map(str, here)), (first.x, first.y), bbox=box, **style)


def _note(answer: Answer, schedule: Schedule) -> str:
    known = "proven best" if answer.proven else answer.excess_in_words
    return f"time {schedule.time:g}, trip {schedule.trip:.1f} m, {schedule.relays} relays; {known}"

"""The paper's slot-indexed models as they are printed, completed where the paper omits rows: the reference.

Numbers in brackets are the paper's equations; A1 to A8 are the rows that it leaves out "due to space limitations".
Slow: in a minute it closes instances of a handful of tasks. The exact method is held against it.
"""

from math import sqrt
from typing import NamedTuple

from formicarium.scheduling.clock import Clock
from formicarium.scheduling.highs import INFINITY, Mixed
from formicarium.scheduling.instance import Instance
from formicarium.scheduling.reach import INNER, Reach
from formicarium.scheduling.schedule import Arm, Schedule, Slot


class Modelled(NamedTuple):
    """What HiGHS says about the paper's model."""

    value: float  # infinite if it found nothing
    bound: float
    schedule: Schedule | None


class _Columns(NamedTuple):
    x: dict  # (task, slot): binary
    h: dict  # (task, slot): relays on one path, w = Omega h (A8)
    z: list  # slot: duration
    theta: list  # slot: (X, Y)


def solve_model(
    instance: Instance, reach: Reach, clock: Clock, slots: int | None = None, time: float | None = None,
    charge_first: bool = False, fixed: tuple[tuple[str, int], ...] = (),
) -> Modelled:  # fmt: skip
    """Solve TCTM (4) to (13), or TDSM (14) if a completion time is given.

    Args:
        instance: with N robots and T tasks.
        reach: PRINTED or INSCRIBED.
        clock: time limit.
        slots: |S|, T if not given: more are never needed.
        time: Lambda, that TDSM may take; None for TCTM.
        charge_first: TDSM charges the way from the start (A7).
        fixed: (task, slot) pairs that are given.
    """
    model = Mixed()
    columns = _columns(model, instance, slots or len(instance.tasks), travels=time is not None)
    _assignment(model, instance, columns)
    _arms(model, instance, reach, columns)
    _capabilities(model, instance, columns)
    if time is not None:
        model.row(-INFINITY, [(z, 1.0) for z in columns.z], time + 1e-6 if time < INFINITY else INFINITY)  # A6
        _travel(model, instance, columns, charge_first)
    index = {task.name: number for number, task in enumerate(instance.tasks)}
    for name, slot in fixed:
        model.row(1.0, [(columns.x[index[name], slot], 1.0)], 1.0)
    value, amounts, bound = model.solve(clock, relative_gap=1e-4 if time is not None else 1e-9, absolute_gap=1e-7)
    return Modelled(value, bound, None if amounts is None else _schedule(instance, columns, amounts))


def _columns(model: Mixed, instance: Instance, slots: int, travels: bool) -> _Columns:
    tasks, backbone = range(len(instance.tasks)), instance.robots - 1
    x0, y0, x1, y1 = instance.region
    arm_cost = instance.spacing if travels else 0.0  # (14): Gamma / Omega * w = Gamma * h
    return _Columns(
        x={(t, s): model.column(0.0, 0, 1, whole=True) for t in tasks for s in range(slots)},
        h={(t, s): model.column(arm_cost, 0, backbone // instance.paths, True) for t in tasks for s in range(slots)},
        z=[model.column(0.0 if travels else 1.0, 0.0, INFINITY) for _ in range(slots)],
        theta=[(model.column(0.0, x0, x1), model.column(0.0, y0, y1)) for _ in range(slots)],  # A2
    )


def _assignment(model: Mixed, instance: Instance, columns: _Columns) -> None:
    tasks, slots, backbone = instance.tasks, range(len(columns.z)), instance.robots - 1
    everyone = range(len(tasks))
    index = {task.name: number for number, task in enumerate(tasks)}
    for t, task in enumerate(tasks):
        model.row(1.0, [(columns.x[t, s], 1.0) for s in slots], 1.0)  # (6)
        for s in slots:
            model.row(0.0, [(columns.z[s], 1.0), (columns.x[t, s], -task.duration)], INFINITY)  # (5)
            most = float(backbone // instance.paths)
            model.row(-INFINITY, [(columns.h[t, s], 1.0), (columns.x[t, s], -most)], 0.0)  # (11)
    for s in slots:
        robots = [(columns.h[t, s], float(instance.paths)) for t in everyone]
        robots += [(columns.x[t, s], float(task.robots)) for t, task in enumerate(tasks)]
        model.row(-INFINITY, robots, float(backbone))  # (10)
        if s:
            used = [(columns.x[t, s], 1.0) for t in everyone]
            earlier = [(columns.x[t, s - 1], -float(len(tasks))) for t in everyone]
            model.row(-INFINITY, used + earlier, 0.0)  # (12), for all slots but the first
    for first, second in instance.priorities:
        a, b = index[first], index[second]
        places = [(columns.x[a, s], float(s + 1)) for s in slots] + [(columns.x[b, s], -float(s + 1)) for s in slots]
        model.row(-INFINITY, places, -1.0)  # (13), with a_s = 1, 2, ...


def _arms(model: Mixed, instance: Instance, reach: Reach, columns: _Columns) -> None:
    if reach is Reach.EUCLID:
        raise ValueError("the paper's model is linear: it has no circle, only printed or inscribed octagons")
    scale = INNER if reach is Reach.INSCRIBED else 1.0
    hop = instance.spacing * scale
    x0, y0, x1, y1 = instance.region
    for t, task in enumerate(instance.tasks):
        most_x, most_y = max(task.x - x0, x1 - task.x), max(task.y - y0, y1 - task.y)
        slack = max(0.0, most_x + most_y - sqrt(2.0) * hop)  # A5
        slacks = (max(0.0, most_x - hop), max(0.0, most_y - hop))
        for s, theta in enumerate(columns.theta):
            x, h = columns.x[t, s], columns.h[t, s]
            away = (model.column(0.0, 0.0, INFINITY), model.column(0.0, 0.0, INFINITY))
            for axis, place in enumerate((task.x, task.y)):
                model.row(-place, [(away[axis], 1.0), (theta[axis], -1.0)], INFINITY)  # A1
                model.row(place, [(away[axis], 1.0), (theta[axis], 1.0)], INFINITY)
                side = [(away[axis], 1.0), (h, -hop), (x, slacks[axis])]
                model.row(-INFINITY, side, hop + slacks[axis])  # (8), (9)
            corner = [(away[0], 1.0), (away[1], 1.0), (h, -sqrt(2.0) * hop), (x, slack)]
            model.row(-INFINITY, corner, sqrt(2.0) * hop + slack)  # (7)


def _capabilities(model: Mixed, instance: Instance, columns: _Columns) -> None:
    for s in range(len(columns.z)):
        used: list[list[int]] = [[] for _ in instance.teams]
        for t, task in enumerate(instance.tasks):
            crew = []
            for team in instance.able(task):
                crew.append(model.column(0.0, 0.0, float(task.robots), whole=True))
                used[team].append(crew[-1])
            model.row(0.0, [(u, 1.0) for u in crew] + [(columns.x[t, s], -float(task.robots))], 0.0)  # A3
        for group, busy in zip(instance.teams, used):
            if busy:
                model.row(-INFINITY, [(u, 1.0) for u in busy], float(group.robots))  # A4


def _travel(model: Mixed, instance: Instance, columns: _Columns, charge_first: bool) -> None:
    for axis in (0, 1):
        if charge_first:  # A7
            step, start = model.column(float(instance.robots), 0.0, INFINITY), instance.start[axis]
            model.row(start, [(step, 1.0), (columns.theta[0][axis], 1.0)], INFINITY)
            model.row(-start, [(step, 1.0), (columns.theta[0][axis], -1.0)], INFINITY)
        for one, other in zip(columns.theta, columns.theta[1:]):  # A6; an unused slot stays where the last one was
            step = model.column(float(instance.robots), 0.0, INFINITY)
            model.row(0.0, [(step, 1.0), (one[axis], 1.0), (other[axis], -1.0)], INFINITY)
            model.row(0.0, [(step, 1.0), (one[axis], -1.0), (other[axis], 1.0)], INFINITY)


def _schedule(instance: Instance, columns: _Columns, amounts) -> Schedule:
    slots = []
    for s, (x, y) in enumerate(columns.theta):
        present = [t for t in range(len(instance.tasks)) if amounts[columns.x[t, s]] > 0.5]
        arms = [Arm(instance.tasks[t].name, instance.paths * round(amounts[columns.h[t, s]])) for t in present]
        if present:
            longest = max(instance.tasks[t].duration for t in present)
            slots.append(Slot(float(amounts[x]), float(amounts[y]), longest, tuple(arms)))
    return Schedule(tuple(slots))

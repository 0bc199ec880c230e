"""The least dislocation in the true circle lies between those in a polygon around it and in one inside it.

Every ordered partition is solved by scipy; nothing here comes from the solvers.
"""

from itertools import combinations, pairwise

import numpy as np
from scipy.optimize import Bounds, LinearConstraint, milp

from formicarium.scheduling.exhaustive import orders

SIDES = 96


def travel_in_polygons(instance, time, charge_first):
    """Return what the least dislocation within a completion time is at least and at most."""
    found = []
    for scale in (1.0, np.cos(np.pi / SIDES)):
        costs = [
            _cost(instance, order, scale, charge_first)
            for order in orders(instance)
            if sum(max(instance.tasks[t].duration for t in group) for group in order) <= time + 1e-9
            and all(_manned(instance, group) for group in order)
        ]
        found.append(min(costs))
    return found


def _manned(instance, group):
    """Whether any of the tasks together find the robots that can do one of them (Hall)."""
    tasks = [instance.tasks[t] for t in group]
    return all(
        sum(task.robots for task in some)
        <= sum(team.robots for team in instance.teams if any(task.needs <= team.abilities for task in some))
        for count in range(1, len(tasks) + 1)
        for some in combinations(tasks, count)
    )


def _cost(instance, order, scale, charge_first):
    placed = [(slot, instance.tasks[t]) for slot, group in enumerate(order) for t in group]
    slots, tasks, steps = len(order), len(placed), len(order) - 1 + charge_first
    cost = np.concatenate([np.zeros(2 * slots), np.full(tasks, instance.spacing), np.full(2 * steps, instance.robots)])
    rows, most = [], []

    def at_most(limit, **terms):
        row = np.zeros(len(cost))
        for name, factor in terms.items():
            row[int(name[1:])] += factor
        rows.append(row)
        most.append(limit)

    for number, (slot, task) in enumerate(placed):
        for angle in 2 * np.pi * np.arange(SIDES) / SIDES:
            a, b = np.cos(angle), np.sin(angle)
            hop = scale * instance.spacing
            terms = {f"_{2 * slot}": a, f"_{2 * slot + 1}": b, f"_{2 * slots + number}": -hop}
            at_most(hop + a * task.x + b * task.y, **terms)
    for slot in range(slots):
        own = {f"_{2 * slots + number}": instance.paths for number, (other, _) in enumerate(placed) if other == slot}
        at_most(instance.robots - 1 - sum(task.robots for other, task in placed if other == slot), **own)
    ways = [(None, 0)] * charge_first + list(pairwise(range(slots)))
    for number, (one, other) in enumerate(ways):
        for axis in (0, 1):
            for sign in (1.0, -1.0):
                terms = {f"_{2 * other + axis}": sign, f"_{2 * slots + tasks + 2 * number + axis}": -1.0}
                if one is not None:
                    terms[f"_{2 * one + axis}"] = -sign
                at_most(sign * instance.start[axis] if one is None else 0.0, **terms)
    low, high = np.zeros(len(cost)), np.full(len(cost), np.inf)
    low[: 2 * slots], high[: 2 * slots] = np.tile(instance.region[:2], slots), np.tile(instance.region[2:], slots)
    whole = np.zeros(len(cost))
    whole[2 * slots : 2 * slots + tasks] = 1
    rows = LinearConstraint(np.array(rows), -np.inf, np.array(most))
    answer = milp(cost, constraints=rows, bounds=Bounds(low, high), integrality=whole, options={"mip_rel_gap": 1e-9})
    return answer.fun if answer.status == 0 else np.inf

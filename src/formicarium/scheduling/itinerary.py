"""Sets in a given order: the cheapest deployment points and arms, (14), as a small mixed-integer programme."""

from collections.abc import Sequence
from math import cos, pi, sin
from typing import NamedTuple

import numpy as np

from formicarium.scheduling.clock import Clock
from formicarium.scheduling.highs import INFINITY, Mixed
from formicarium.scheduling.problem import Problem
from formicarium.scheduling.reach import EUCLID, INNER, INSCRIBED, SQRT_HALF, TOLERANCE

ROUND_ENOUGH = 2e-7  # of the spacing: how far a point may lie outside of a circle
MOST_ROUNDS = 30


class Itinerary(NamedTuple):
    """Where the swarm deploys, slot by slot."""

    cost: float  # (14), m
    points: np.ndarray  # (S, 2), m
    hops: list[np.ndarray]  # relays of each path to each task, slot by slot


def facets(reach: int) -> list[tuple[float, float]]:
    """Return (a, b) with a |dx| + b |dy| <= length of the arm; of a circle only some of its tangents."""
    octagon = [(1.0, 0.0), (0.0, 1.0), (SQRT_HALF, SQRT_HALF)]
    if reach == INSCRIBED:
        return [(a / INNER, b / INNER) for a, b in octagon]
    if reach == EUCLID:
        return [(cos(k * pi / 16), sin(k * pi / 16)) for k in range(9)]
    return octagon


def cheapest(
    problem: Problem, slots: Sequence[Sequence[int]], charge_first: bool, clock: Clock, cutoff: float | None = None
) -> Itinerary | None:
    """Return the cheapest itinerary through slots in this order; None if there is none (below the cutoff).

    Args:
        problem: that the tasks belong to.
        slots: tasks of each slot.
        charge_first: whether the way from the start to the first point counts.
        clock: of the whole work.
        cutoff: costs that are not below are of no interest.
    """
    planes = {(slot, task): facets(problem.reach) for slot, tasks in enumerate(slots) for task in tasks}
    for _ in range(MOST_ROUNDS):
        found = _solve(problem, slots, planes, charge_first, clock, cutoff)
        if found is None or problem.reach != EUCLID or not _add_tangents(problem, slots, planes, found):
            return found
    return None


def _solve(problem, slots, planes, charge_first, clock, cutoff) -> Itinerary | None:
    model = Mixed()
    x0, y0, x1, y1 = problem.region
    points = [(model.column(0.0, x0, x1), model.column(0.0, y0, y1)) for _ in slots]
    for axis in (0, 1):
        for one, next_one in zip(points, points[1:]):
            step = model.column(float(problem.swarm), 0.0, INFINITY)
            model.row(0.0, [(step, 1.0), (one[axis], 1.0), (next_one[axis], -1.0)], INFINITY)
            model.row(0.0, [(step, 1.0), (one[axis], -1.0), (next_one[axis], 1.0)], INFINITY)
        if charge_first and points:
            step, start = model.column(float(problem.swarm), 0.0, INFINITY), float(problem.start[axis])
            model.row(start, [(step, 1.0), (points[0][axis], 1.0)], INFINITY)
            model.row(-start, [(step, 1.0), (points[0][axis], -1.0)], INFINITY)
    hops: dict[tuple[int, int], int] = {}
    for slot, tasks in enumerate(slots):
        spare = int(problem.limits[0] - problem.robots[list(tasks)].sum()) // problem.paths
        for task in tasks:
            hops[slot, task] = model.column(problem.spacing, 0.0, float(spare), whole=True)
            away = []
            for axis in (0, 1):
                place = float(problem.places[task, axis])
                column = model.column(0.0, 0.0, INFINITY)
                model.row(-place, [(column, 1.0), (points[slot][axis], -1.0)], INFINITY)
                model.row(place, [(column, 1.0), (points[slot][axis], 1.0)], INFINITY)
                away.append(column)
            for a, b in planes[slot, task]:
                reached = problem.spacing * (1.0 + TOLERANCE)
                model.row(-INFINITY, [(away[0], a), (away[1], b), (hops[slot, task], -problem.spacing)], reached)
        model.row(-INFINITY, [(hops[slot, task], 1.0) for task in tasks], float(spare))
    value, amounts, _ = model.solve(clock, cutoff=cutoff)
    if amounts is None:
        return None
    found = np.array([[amounts[x], amounts[y]] for x, y in points]).reshape(-1, 2)
    whole = [np.array([round(amounts[hops[slot, task]]) for task in tasks]) for slot, tasks in enumerate(slots)]
    return Itinerary(value, found, whole)


def _add_tangents(problem, slots, planes, found: Itinerary) -> bool:
    """Add a tangent wherever an arm sticks out of its circle, and tell whether one did."""
    added = False
    for slot, tasks in enumerate(slots):
        for place, task in enumerate(tasks):
            dx, dy = np.abs(problem.places[task] - found.points[slot])
            length = float(np.sqrt(dx * dx + dy * dy))
            if length > (found.hops[slot][place] + 1 + ROUND_ENOUGH) * problem.spacing:
                planes[slot, task].append((dx / length, dy / length))
                added = True
    return added

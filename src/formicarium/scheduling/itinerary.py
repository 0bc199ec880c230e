"""Sets in a given order: the cheapest deployment points and arms, (14), as a small mixed-integer programme.

An arm that ends (dx, dy) from the master is long enough if a dx + b dy <= length for all tangents (a, b) of the unit
reach: eight for an octagon; of the circle sixteen, and more where a solution sticks out.
"""

import itertools
from collections.abc import Sequence
from math import pi
from typing import NamedTuple

import numpy as np

from formicarium.scheduling.clock import Clock
from formicarium.scheduling.highs import INFINITY, Small
from formicarium.scheduling.problem import Problem
from formicarium.scheduling.reach import EUCLID, INNER, INSCRIBED, TOLERANCE

ROUND_ENOUGH = 2e-7  # hops: how far a point may lie outside of a circle
STILL = 1e-8  # hops: a shorter step is none
ALIKE = 1e-6  # relative: tours whose costs differ by less
MOST_ROUNDS = 1000  # of tangents, or of relays that are tried


class Itinerary(NamedTuple):
    """Where the swarm deploys, slot by slot."""

    cost: float  # (14), hops
    points: np.ndarray  # (S, 2), hops from the corner
    hops: list[np.ndarray]  # relays of each path to each task, slot by slot


def itinerary(problem: Problem, points: np.ndarray, hops: list[np.ndarray], charge_first: bool) -> Itinerary:
    """Return an itinerary with its cost added up from points and relays; steps of a solver's noise are none."""
    stops = np.vstack([problem.start, points])
    for before, here in itertools.pairwise(stops):
        still = np.abs(here - before) < STILL
        here[still] = before[still]
    trip = float(np.abs(np.diff(stops if charge_first else stops[1:], axis=0)).sum())
    return Itinerary(problem.swarm * trip + float(sum(h.sum() for h in hops)), stops[1:], hops)


def tangents(reach: int) -> np.ndarray:
    """Return (n, 2) directions (a, b) with a dx + b dy <= length of the arm."""
    count = 16 if reach == EUCLID else 8
    angles = 2 * pi * np.arange(count) / count
    return np.column_stack([np.cos(angles), np.sin(angles)]) / (INNER if reach == INSCRIBED else 1.0)


class Itineraries:
    """Answers for one problem; owns the solver that gives them."""

    def __init__(self, problem: Problem, charge_first: bool, clock: Clock):
        """Prepare for a problem; ``charge_first``: the way from the start to the first point counts."""
        self._problem, self._charge_first = problem, charge_first
        self._tangents = tangents(problem.reach)
        self._solver = Small(clock, precise=problem.reach == EUCLID)
        self._middle = Small(clock, precise=True, interior=True)

    def bound(self, slots: Sequence[Sequence[int]], cutoff: float = INFINITY) -> float:
        """Return a lower bound of the cost of slots in this order: arms of any length, not whole numbers of hops."""
        value, _ = self._solver.solve(self._programme(slots, []), None, cutoff)
        return value

    def cheapest(self, slots: Sequence[Sequence[int]], cutoff: float = INFINITY) -> Itinerary | None:
        """Return the cheapest itinerary through slots in this order; None if there is none below the cutoff.

        Raises:
            ArithmeticError: if arms go on sticking out of their circles.
        """
        more: list[tuple[int, float, float]] = []
        best: Itinerary | None = None
        for _ in range(MOST_ROUNDS):
            way = self._solved(slots, more, None, cutoff)
            if way is None:
                return best
            if self._problem.reach != EUCLID or not self._add_tangents(slots, way, more):
                return way
            if way := self._in_circles(slots, more, np.concatenate(way.hops), cutoff):
                best, cutoff = way, way.cost * (1.0 - ALIKE)
        raise ArithmeticError(f"a tour of {len(slots)} slots has too many ways to be measured")

    def _in_circles(self, slots, more, hops: np.ndarray, cutoff: float) -> Itinerary | None:
        """Return the cheapest itinerary with so many relays, each arm in its circle.

        Corners of tangents always stick out, so it looks for an answer amidst the best. Its tangents hold for other
        numbers of relays too.
        """
        for _ in range(MOST_ROUNDS):
            way = self._solved(slots, more, hops, cutoff)
            if way is None or not self._add_tangents(slots, way, more):
                return way
        raise ArithmeticError(f"an arm of a tour of {len(slots)} slots sticks out after {MOST_ROUNDS} rounds")

    def _solved(self, slots, more, given: np.ndarray | None, cutoff: float) -> Itinerary | None:
        """Solve the programme with some more tangents, and with these relays if they are given."""
        programme, count = self._programme(slots, more), sum(map(len, slots))
        whole = 2 * len(slots) + np.arange(count)
        if given is not None:
            programme[1][whole] = programme[2][whole] = given
            value, amounts = self._middle.solve(programme, None, cutoff)
        else:
            value, amounts = self._solver.solve(programme, whole, cutoff)
        if amounts is None or value >= cutoff:
            return None
        ends = np.cumsum([len(slot) for slot in slots])
        hops = np.split(np.rint(amounts[whole]).astype(np.int64), ends[:-1])
        return itinerary(self._problem, amounts[: 2 * len(slots)].reshape(-1, 2), hops, self._charge_first)

    def _programme(self, slots, more):
        """Return costs, column bounds and rows: the points, the relays to each task, the steps between points."""
        problem, count = self._problem, len(slots)
        tasks = np.array([task for slot in slots for task in slot], np.int64)
        at = np.repeat(np.arange(count), [len(slot) for slot in slots])
        n, first_hop, first_step = len(tasks), 2 * count, 2 * count + len(tasks)
        steps = 2 * (count - 1 + self._charge_first)
        cost = np.zeros(first_step + steps)
        cost[first_hop:first_step] = 1.0
        cost[first_step:] = problem.swarm
        low, high = np.zeros(len(cost)), np.full(len(cost), INFINITY)
        low[:first_hop], high[:first_hop] = np.tile(problem.region[:2], count), np.tile(problem.region[2:], count)
        # arms: a x + b y - h <= 1 + a X + b Y
        kinds = len(self._tangents)
        task_of, tangent_of = np.repeat(np.arange(n), kinds), np.tile(np.arange(kinds), n)
        a, b = self._tangents[tangent_of].T
        if more:
            task_of = np.concatenate([task_of, [task for task, _, _ in more]]).astype(np.int64)
            a, b = np.concatenate([a, [x for _, x, _ in more]]), np.concatenate([b, [y for _, _, y in more]])
        x, y = problem.places[tasks[task_of]].T
        index = np.column_stack([2 * at[task_of], 2 * at[task_of] + 1, first_hop + task_of])
        value = np.column_stack([a, b, np.full(len(a), -1.0)])
        limit = 1.0 + TOLERANCE + a * x + b * y
        # steps: |x' - x| <= g, twice for each axis
        rows, values, limits = [index], [value], [limit]
        chain = np.arange(2 * (count - 1))
        for sign in (1.0, -1.0):
            rows.append(np.column_stack([chain, chain + 2, first_step + chain]))
            values.append(np.tile([sign, -sign, -1.0], (len(chain), 1)))
            limits.append(np.zeros(len(chain)))
        starts = [3] * sum(map(len, limits))
        flat_index, flat_value = np.concatenate(rows).reshape(-1), np.concatenate(values).reshape(-1)
        limits = np.concatenate(limits)
        if self._charge_first:
            own = np.array([[0, len(cost) - 2], [1, len(cost) - 1]] * 2).reshape(-1)
            flat_index = np.concatenate([flat_index, own])
            flat_value = np.concatenate([flat_value, [1.0, -1.0] * 2, [-1.0, -1.0] * 2])
            limits = np.concatenate([limits, problem.start, -problem.start])
            starts += [2] * 4
        # robots of each slot
        sums = np.bincount(at, problem.robots[tasks], count)
        flat_index = np.concatenate([flat_index, first_hop + np.arange(n)])
        flat_value = np.concatenate([flat_value, np.ones(n)])
        limits = np.concatenate([limits, (problem.limits[0] - sums) // problem.paths])
        starts += [len(slot) for slot in slots]
        return cost, low, high, np.concatenate([[0], np.cumsum(starts)]), flat_index, flat_value, limits

    def _add_tangents(self, slots, way: Itinerary, more) -> bool:
        """Add a tangent wherever an arm sticks out of its circle, and tell whether one did."""
        before, number = len(more), 0
        for point, tasks, relays in zip(way.points, slots, way.hops):
            for task, hops in zip(tasks, relays):
                dx, dy = point - self._problem.places[task]
                length = float(np.sqrt(dx * dx + dy * dy))
                if length > hops + 1 + ROUND_ENOUGH:
                    more.append((number, dx / length, dy / length))
                number += 1
        return len(more) > before

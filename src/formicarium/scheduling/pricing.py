"""The most valuable set of tasks that one slot can hold: branch and bound over boxes for the deployment point.

In a box every task needs at least the relays from the nearest point of the box, so the best set at these prices
bounds what any point of the box allows. A box is closed when that set can be done from one of its points. What
cannot be in a better set of a box cannot be in one of its parts: if there are many tasks, it hands on the others only.
"""

from typing import NamedTuple

import numpy as np

from formicarium.compiled import compiled
from formicarium.scheduling.deployment import meet
from formicarium.scheduling.knapsack import fill, move_multipliers
from formicarium.scheduling.problem import Problem
from formicarium.scheduling.reach import EUCLID, apart, distance, relays

WAITING = 100_000  # boxes
DEEPEST = 100  # times that a box is halved: from MOST_HOPS to SMALLEST it takes 88
NODES_A_BOX = 1_000  # of a knapsack take as long as a box: a call ends in time, however hard its knapsacks are
MOST_SETS = 64  # handed back by one call, the best ones last
SMALLEST = 1e-9  # hops
EPSILON = 1e-9


class Priced(NamedTuple):
    """What pricing finds."""

    sets: list[np.ndarray]  # tasks of sets that are worth more than asked for, the best one last
    bound: float  # no set is worth more


class Prices:
    """Pricing for one problem; owns the memory that it works in."""

    def __init__(self, problem: Problem, many: bool = False):
        """Prepare for a problem; ``many``: of tasks a box hands on only those that can be in a better set."""
        self.problem, self._many = problem, many
        size, rows = problem.size, len(problem.limits)
        self._boxes = np.empty((WAITING, 6))
        self._reals = np.empty((6, size + 1))
        self._rows = np.empty((3, rows))
        self._weights = np.empty((2, rows, size))
        self._whole = np.empty((4, size), np.int64)
        self._open = np.empty((DEEPEST, size), np.int64)
        self._counts = np.empty(DEEPEST, np.int64)
        self._flags = np.empty((4, size), np.bool_)
        self._sets = np.empty((MOST_SETS, size), np.bool_)
        self._point = np.empty(2)

    def best(self, gains: np.ndarray, allowed: np.ndarray, worth: float, boxes: int, region: np.ndarray) -> Priced:
        """Return sets of the allowed tasks that gain more than ``worth`` together, and a bound on all.

        Args:
            gains: (T,) of the tasks.
            allowed: (T,) bool.
            worth: of no interest at or below.
            boxes: to look at, at most, or as long in their knapsacks; if they are used up the bound is weaker.
            region: (4,) x0, y0, x1, y1 for the deployment point.
        """
        problem = self.problem
        tasks = np.flatnonzero(allowed & (gains > 1e-12))
        if not len(tasks):
            return Priced([], 0.0)
        found, bound = search(
            gains[tasks], problem.places[tasks], problem.demands[:, tasks].astype(float), problem.limits.astype(float),
            problem.paths, problem.reach, region, worth, boxes, self._many, self._boxes, self._reals,
            self._rows, self._weights, self._whole, self._open, self._counts, self._flags, self._sets, self._point,
        )  # fmt: skip
        return Priced([tasks[flags[: len(tasks)]] for flags in self._sets[:found]], float(bound))


@compiled
def search(
    gains, places, demands, limits, paths, reach, region, worth, budget, many,
    boxes, reals, row_space, weight_space, whole, open_tasks, counts, flags, sets, point,
):  # fmt: skip
    """Return (number of sets found, bound); the sets are rows of ``sets``, each better than the one before.

    Args:
        gains: (n,) of the tasks.
        places: (n, 2) hops.
        demands: (R, n) robots of each row that a task takes, without relays.
        limits: (R,) robots that there are.
        paths: to each task.
        reach: a value of Reach.
        region: (4,) for the deployment point.
        worth: only sets above it.
        budget: boxes.
        many: whether a box hands on only the tasks that can be in a better set.
        boxes: memory to work in, like all that follows.
        reals: memory.
        row_space: memory.
        weight_space: memory.
        whole: memory.
        open_tasks: memory.
        counts: memory.
        flags: memory.
        sets: memory, and the answer.
        point: memory.
    """
    count, rows = len(gains), len(limits)
    some, keys, above = reals[0], reals[1], reals[2]
    multipliers, slopes, best_row = row_space[0], row_space[1], row_space[2]
    weights, middle_weights = weight_space[0], weight_space[1]
    items, hops, order = whole[0], whole[1], whole[2]
    chosen, taken = flags[0], flags[1]
    for row in range(rows):
        multipliers[row] = 0.0
    multipliers[0] = 1.0 / limits[0]
    found, best, bound = 0, worth, worth
    boxes[0, 0], boxes[0, 1], boxes[0, 2], boxes[0, 3], boxes[0, 4] = region[0], region[1], region[2], region[3], 1e300
    boxes[0, 5] = 1
    waiting, depth = 1, 0
    counts[0] = count
    for task in range(count):
        open_tasks[0, task] = task
    while waiting:
        waiting -= 1
        x0, y0, x1, y1 = boxes[waiting, 0], boxes[waiting, 1], boxes[waiting, 2], boxes[waiting, 3]
        if boxes[waiting, 4] <= best + EPSILON:
            continue
        if budget <= 0:
            bound = max(bound, boxes[waiting, 4])
            continue
        budget -= 1
        if many:
            depth = int(boxes[waiting, 5])
        parent = max(0, depth - 1)
        kept = weigh(x0, y0, x1, y1, open_tasks[parent], counts[parent], gains, places, demands, limits, paths,
                     reach, some, weights, items, hops)  # fmt: skip
        least = move_multipliers(some, weights, limits, kept, best + EPSILON, multipliers, slopes, best_row)
        if least <= best + EPSILON:
            continue
        if many:
            kept = sift(some, weights, items, limits, kept, multipliers, best + EPSILON - least)
            counts[depth] = kept
            for item in range(kept):
                open_tasks[depth, item] = items[item]
        value, most, nodes = fill(
            some, weights, limits, kept, best, multipliers, order, keys, above, slopes, taken, chosen
        )
        budget -= nodes // NODES_A_BOX
        if most <= best + EPSILON:
            continue
        if value > best + EPSILON:
            whole_set = 0
            for item in range(kept):
                if chosen[item]:
                    reals[3][whole_set], reals[4][whole_set] = places[items[item], 0], places[items[item], 1]
                    whole[3][whole_set] = hops[items[item]]
                    whole_set += 1
            point_like = max(x1 - x0, y1 - y0) <= SMALLEST
            if point_like or (
                reach != EUCLID and meet(reals[3], reals[4], whole[3], whole_set, reach, x0, y0, x1, y1, point)
            ):
                found, best = keep(sets, found, count, kept, items, chosen), value
                if most <= value + EPSILON:
                    continue
        x, y = 0.5 * (x0 + x1), 0.5 * (y0 + y1)
        kept = weigh(x, y, x, y, open_tasks[depth], counts[depth], gains, places, demands, limits, paths, reach, some,
                     middle_weights, items, hops)  # fmt: skip
        here, _, nodes = fill(
            some, middle_weights, limits, kept, best, multipliers, order, keys, above, slopes, taken, chosen
        )
        budget -= nodes // NODES_A_BOX
        if here > best + EPSILON:
            found, best = keep(sets, found, count, kept, items, chosen), here
        if max(x1 - x0, y1 - y0) <= SMALLEST or most <= best + EPSILON:
            continue
        if waiting + 2 > len(boxes):
            bound = max(bound, most)
            continue
        for side in range(2):
            boxes[waiting, 0], boxes[waiting, 1], boxes[waiting, 2], boxes[waiting, 3] = x0, y0, x1, y1
            boxes[waiting, 4], boxes[waiting, 5] = most, depth + 1
            if x1 - x0 >= y1 - y0:
                boxes[waiting, 0 if side else 2] = x
            else:
                boxes[waiting, 1 if side else 3] = y
            waiting += 1
    return found, max(bound, best)


@compiled
def weigh(
    x0, y0, x1, y1, tasks, count, gains, places, demands, limits, paths, reach, some, weights, items, hops,
):  # fmt: skip
    """Fill in what tasks take when the master stands in a box, and return how many can be done at all."""
    kept = 0
    for number in range(count):
        task = tasks[number]
        dx, dy = apart(places[task, 0], x0, x1), apart(places[task, 1], y0, y1)
        hops[task] = relays(distance(dx, dy, reach))
        whole = demands[0, task] + paths * hops[task]
        if whole <= limits[0]:
            weights[0, kept] = whole
            for row in range(1, len(limits)):
                weights[row, kept] = demands[row, task]
            some[kept] = gains[task]
            items[kept] = task
            kept += 1
    return kept


@compiled
def sift(gains, weights, items, limits, count, multipliers, least):
    """Keep the tasks whose gain beyond their price is more than ``least``, and return how many those are.

    The sets that a task is in are bounded by the Lagrange bound of all sets and, if it is below 0, that gain.
    """
    kept = 0
    for place in range(count):
        left = gains[place]
        for row in range(len(limits)):
            left -= multipliers[row] * weights[row, place]
        if left > least:
            gains[kept], items[kept] = gains[place], items[place]
            for row in range(len(limits)):
                weights[row, kept] = weights[row, place]
            kept += 1
    return kept


@compiled
def keep(sets, found, count, kept, items, chosen):
    """Note a set and return how many there are; when there is no room the oldest gives way."""
    if found == len(sets):
        for row in range(len(sets) - 1):
            for task in range(count):
                sets[row, task] = sets[row + 1, task]
        found -= 1
    for task in range(count):
        sets[found, task] = False
    for item in range(kept):
        if chosen[item]:
            sets[found, items[item]] = True
    return found + 1

"""Where the master may stand for a set of tasks: exact search by boxes (the slot oracle).

In a box every task gets the relays that it needs from the nearest point of the box; fewer are impossible. With
octagons it is decided in closed form whether one point of the box needs no more than these.
"""

from typing import NamedTuple

import numpy as np

from formicarium.compiled import compiled
from formicarium.scheduling.problem import Problem
from formicarium.scheduling.reach import EUCLID, INNER, INSCRIBED, SQRT_HALF, TOLERANCE, apart, distance, relays

SMALLEST = 1e-9  # hops: a box of that size is a point
DEPTH = 4096  # boxes that wait


class Deployment(NamedTuple):
    """A point and the relays of each path to each task of a set."""

    x: float  # hops from the corner of the region
    y: float
    hops: np.ndarray  # (n,) relays on one path


class Places:
    """Answers for one problem; owns the memory that the search works in."""

    def __init__(self, problem: Problem):
        """Prepare for a problem."""
        self.problem = problem
        self._boxes = np.empty((DEPTH, 5))
        self._found = np.empty(2)
        self._hops = np.empty(problem.size, np.int64)
        self._known: dict[bytes, Deployment | None] = {}

    def spare(self, tasks: np.ndarray) -> int:
        """Return how many relays a path of these tasks may have together; negative if they cannot be manned."""
        left = self.problem.limits - self.problem.demands[:, tasks].sum(axis=1)
        return int(left[0] // self.problem.paths) if (left >= 0).all() else -1

    def deploy(self, tasks: np.ndarray) -> Deployment | None:
        """Return a point from which these tasks can be done at the same time, or None if there is none."""
        key = tasks.tobytes()
        if key not in self._known:
            self._known[key] = self.within(tasks, self.spare(tasks))
        return self._known[key]

    def within(self, tasks: np.ndarray, most: int) -> Deployment | None:
        """Return a point of the region from which the tasks need at most so many relays a path, or None."""
        problem = self.problem
        if most < 0:
            return None
        places = problem.places[tasks]
        found = find_place(places, problem.reach, problem.region, most, self._boxes, self._hops, self._found)
        if found < 0:
            raise MemoryError("the search for a deployment point does not end")
        if not found:
            return None
        x, y = (float(value) for value in self._found)
        hops = [relays(distance(px - x, py - y, problem.reach) * (1.0 + SMALLEST)) for px, py in places]
        return Deployment(x, y, self._hops[: len(tasks)].copy() if sum(hops) > most else np.array(hops))


@compiled
def find_place(places, reach, region, most, boxes, hops, found):
    """Find a point from which all tasks need at most ``most`` relays a path together.

    Returns:
        1 and the point in ``found`` and the relays in ``hops``; 0 if there is none; -1 if boxes run out.
    """
    count = len(places)
    boxes[0, 0], boxes[0, 1], boxes[0, 2], boxes[0, 3] = region[0], region[1], region[2], region[3]
    waiting = 1
    while waiting:
        waiting -= 1
        x0, y0, x1, y1 = boxes[waiting, 0], boxes[waiting, 1], boxes[waiting, 2], boxes[waiting, 3]
        total = 0
        for task in range(count):
            dx, dy = apart(places[task, 0], x0, x1), apart(places[task, 1], y0, y1)
            hops[task] = relays(distance(dx, dy, reach))
            total += hops[task]
        if total > most:
            continue
        if reach != EUCLID:
            if meet(places[:, 0], places[:, 1], hops, count, reach, x0, y0, x1, y1, found):
                return 1
            if total == most:
                continue
        wide = max(x1 - x0, y1 - y0)
        middle_x, middle_y = 0.5 * (x0 + x1), 0.5 * (y0 + y1)
        if reach == EUCLID:
            here = 0
            for task in range(count):
                here += relays(distance(places[task, 0] - middle_x, places[task, 1] - middle_y, reach))
            if here <= most:
                for task in range(count):
                    away = distance(places[task, 0] - middle_x, places[task, 1] - middle_y, reach)
                    hops[task] = relays(away)
                found[0], found[1] = middle_x, middle_y
                return 1
            # three octagons around the circles: what they leave empty, the circles do too
            if total == most and not meet(places[:, 0], places[:, 1], hops, count, 0, x0, y0, x1, y1, found):
                continue
        if wide <= SMALLEST:
            found[0], found[1] = middle_x, middle_y
            return 1
        if waiting + 2 > len(boxes):
            return -1
        for side in range(2):
            boxes[waiting, 0], boxes[waiting, 1], boxes[waiting, 2], boxes[waiting, 3] = x0, y0, x1, y1
            if x1 - x0 >= y1 - y0:
                boxes[waiting, 0 if side else 2] = middle_x
            else:
                boxes[waiting, 1 if side else 3] = middle_y
            waiting += 1
    return 0


@compiled
def meet(xs, ys, hops, count, reach, x0, y0, x1, y1, found):
    """Tell whether octagons around tasks, ``hops`` + 1 steps wide, share a point with a box, and give one."""
    plus_low, plus_high, minus_low, minus_high = x0 + y0, x1 + y1, x0 - y1, x1 - y0
    for task in range(count):
        radius = hops[task] + 1 + TOLERANCE
        if reach == INSCRIBED:
            radius *= INNER
        x, y = xs[task], ys[task]
        x0, x1, y0, y1 = max(x0, x - radius), min(x1, x + radius), max(y0, y - radius), min(y1, y + radius)
        slant = radius / SQRT_HALF
        plus_low, plus_high = max(plus_low, x + y - slant), min(plus_high, x + y + slant)
        minus_low, minus_high = max(minus_low, x - y - slant), min(minus_high, x - y + slant)
    if x0 > x1 or y0 > y1 or plus_low > plus_high or minus_low > minus_high:
        return False
    # x for which some y is left: every lower limit of y below every upper one
    low = max(x0, y0 + minus_low, plus_low - y1, 0.5 * (plus_low + minus_low))
    high = min(x1, plus_high - y0, y1 + minus_high, 0.5 * (plus_high + minus_high))
    if low > high:
        return False
    x = 0.5 * (low + high)
    found[0] = x
    found[1] = 0.5 * (max(y0, plus_low - x, x - minus_high) + min(y1, plus_high - x, x - minus_low))
    return True

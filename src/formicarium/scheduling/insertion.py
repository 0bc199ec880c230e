"""What it costs at least to add a set to a tour of sets, for every place in the order."""

import numpy as np

from formicarium.compiled import compiled
from formicarium.scheduling.lattice import NEVER, Lattice, spread, stand
from formicarium.scheduling.problem import Problem


class Insertions:
    """Lower bounds for one problem; owns the memory that they are computed in."""

    def __init__(self, problem: Problem, lattice: Lattice):
        """Prepare for an optimistic lattice."""
        self.problem, self.lattice = problem, lattice
        cells, most = lattice.side**2, problem.size + 2
        self._ahead = np.empty((most, cells), np.float32)
        self._behind = np.empty((most, cells), np.float32)
        self._places = np.empty((most, cells), np.float32)
        self._own = np.empty((most, cells), np.float32)
        self._moved = np.empty(cells, np.float32)
        self._sums = np.empty(cells, np.int16)
        self._line = np.empty(lattice.side, np.float32)

    def bounds(self, tour: np.ndarray, sets: np.ndarray, left: int, goal: float) -> tuple[np.ndarray, np.ndarray]:
        """Return (n, len(tour) + 1) lower bounds of all schedules in which a set stands at a place of the tour.

        Args:
            tour: (m,) sets in order.
            sets: (n,) that might be added.
            left: tasks that are in no set of the tour.
            goal: bounds at or above are of no interest.

        Returns:
            The bounds, NEVER for what is of no interest, and (T,) what each arm that is left costs at least.
        """
        found = np.full((len(sets), len(tour) + 1), np.float32(NEVER), np.float32)
        lattice, problem = self.lattice, self.problem
        least_arms = np.empty(problem.size)
        insert(
            tour, sets, left, np.float32(goal), lattice.hops, lattice.first, lattice.side, np.float32(lattice.step[0]),
            np.float32(lattice.step[1]), lattice.free, problem.robots, problem.limits[0],
            problem.paths, self._ahead, self._behind, self._places, self._own, self._moved, self._sums, self._line,
            least_arms, found,
        )  # fmt: skip
        return found, least_arms


@compiled
def spare_of(mask, robots, limit, paths):
    """Return how many relays a path the set may have."""
    used = 0
    for task in range(len(robots)):
        if mask >> task & 1:
            used += robots[task]
    return (limit - used) // paths


@compiled
def insert(
    tour, sets, left, goal, hops, first, side, step_x, step_y, free, robots, limit, paths,
    ahead, behind, places, own, moved, sums, line, least_arm, found,
):  # fmt: skip
    """Fill ``found`` and ``least_arm``; see ``Insertions.bounds``."""
    count, cells, size = len(tour), len(first), len(robots)
    for place in range(count):
        stand(tour[place], hops, spare_of(tour[place], robots, limit, paths), sums, own[place])
    # ahead[k]: cost of being in a cell on the way to set k, all sets before it done; behind[k]: of all after k - 1
    for cell in range(cells):
        ahead[0, cell] = first[cell]
        behind[count, cell] = np.float32(0.0)
    for place in range(count):
        for cell in range(cells):
            moved[cell] = ahead[place, cell] + own[place, cell]
        spread(moved, side, step_x, step_y, free, ahead[place + 1], line)
    for place in range(count - 1, -1, -1):
        for cell in range(cells):
            moved[cell] = behind[place + 1, cell] + own[place, cell]
        spread(moved, side, step_x, step_y, free, behind[place], line)
    for place in range(count + 1):
        for cell in range(cells):
            places[place, cell] = ahead[place, cell] + behind[place, cell]
    # a task that is left must be done from a cell that some slot can stand in without exceeding the goal
    outside = np.float32(0.0)
    for task in range(size):
        least_arm[task] = 0.0
        if left >> task & 1:
            least = NEVER
            for cell in range(cells):
                away = np.float32(hops[task, cell])
                if away < least:
                    cheapest = NEVER
                    for place in range(count + 1):
                        cheapest = min(cheapest, places[place, cell])
                    if cheapest + away < goal:
                        least = away
            least_arm[task] = least
            outside += np.float32(min(least, NEVER))
    if outside >= NEVER:
        return
    for number in range(len(sets)):
        mask = sets[number]
        others = outside
        for task in range(size):
            if mask >> task & 1:
                others -= np.float32(least_arm[task])
        stand(mask, hops, spare_of(mask, robots, limit, paths), sums, moved)
        for place in range(count + 1):
            least = NEVER
            for cell in range(cells):
                value = places[place, cell] + moved[cell]
                least = min(least, value)
            if least + others < goal:
                found[number, place] = least + others

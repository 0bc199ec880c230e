"""All sets of tasks that may be done at once, as bits of whole numbers; only for a few dozen tasks.

Optimistic: a set is in when some cell of a lattice may do. Task 0 is the longest one, so that the lowest bit of a
set tells its duration.
"""

import numpy as np

from formicarium.compiled import compiled
from formicarium.scheduling.problem import Problem

MOST_TASKS = 21  # a table has a place for every subset
MOST_SETS = 1_500_000


class Family:
    """Sets, which of them are possible, and whether what is left can still be done in time."""

    def __init__(self, problem: Problem, hops: np.ndarray, forbidden: np.ndarray):
        """Enumerate.

        Args:
            problem: with its tasks from long to short.
            hops: (T, cells) optimistic relays on a path.
            forbidden: (T,) for each task the bits of those that it can share no slot with.
        """
        size = problem.size
        self.problem = problem
        self.possible = np.zeros(1 << size, np.bool_)
        sets = np.empty(MOST_SETS, np.int64)
        rows = len(problem.limits)
        count = enumerate_sets(
            problem.robots, hops, problem.paths, problem.demands, problem.limits, forbidden,
            np.zeros((size + 1, hops.shape[1]), np.int16), np.zeros((size + 1, rows), np.int64), self.possible, sets,
        )  # fmt: skip
        self.complete = count >= 0
        self.sets = sets[: max(count, 0)].copy()
        self._fails = np.full(1 << size, -1, np.int16) if self.complete else np.empty(0, np.int16)
        self._known = np.full(1 << size, 32_000, np.int16) if self.complete else np.empty(0, np.int16)
        largest = largest_sets(self.sets, self.possible, size) if self.complete else np.empty(0, np.bool_)
        top = self.sets[largest]
        top = top[np.argsort(-np.bitwise_count(top), kind="stable")]
        self._starts = np.zeros(size + 1, np.int64)
        self._holding = np.empty(int(np.bitwise_count(top).sum()), np.int64)
        place = 0
        for task in range(size):
            some = top[top >> task & 1 == 1]
            self._holding[place : place + len(some)] = some
            place += len(some)
            self._starts[task + 1] = place

    @property
    def tables(self) -> tuple[np.ndarray, ...]:
        """What ``can_cover`` looks up and keeps."""
        return self._starts, self._holding, self._fails, self._known, self.possible

    def leaving_time(self, covered: int, ticks: int) -> np.ndarray:
        """Return the sets, none with a task of ``covered``, after which the rest can be done in the ticks left."""
        return self.in_time(self.sets[self.sets & covered == 0], covered, ticks)

    def in_time(self, sets: np.ndarray, covered: int, ticks: int) -> np.ndarray:
        """Return those of the sets, which share no task with ``covered``, that leave time for the rest."""
        kept = np.zeros(len(sets), np.bool_)
        everything = (1 << self.problem.size) - 1
        mark_in_time(sets, covered, everything, ticks, self.problem.ticks, self._starts, self._holding, self._fails,
                self._known, self.possible, kept)  # fmt: skip
        return sets[kept]


@compiled
def enumerate_sets(robots, hops, paths, demands, limits, forbidden, sums, taken, possible, sets):
    """Write all possible sets and return how many there are, or -1 if there are too many."""
    size, cells, rows = len(robots), hops.shape[1], len(limits)
    depth_tasks = np.int64(0)  # bits of the set at hand
    count, place, depth = 0, 0, 0
    possible[0] = True
    # depth first: add tasks in rising order; sums[d], taken[d] belong to the set of d tasks
    while True:
        if place < size:
            fits = forbidden[place] & depth_tasks == 0
            if fits:
                for row in range(rows):
                    taken[depth + 1, row] = taken[depth, row] + demands[row, place]
                    if taken[depth + 1, row] > limits[row]:
                        fits = False
            if fits:
                spare = (limits[0] - taken[depth + 1, 0]) // paths
                least = 32_000
                for cell in range(cells):
                    value = sums[depth, cell] + hops[place, cell]
                    sums[depth + 1, cell] = value
                    least = min(least, value)
                fits = least <= spare
            if fits:
                depth += 1
                depth_tasks |= np.int64(1) << place
                possible[depth_tasks] = True
                if count == len(sets):
                    return -1
                sets[count] = depth_tasks
                count += 1
            place += 1
            continue
        if depth == 0:
            return count
        last = size - 1
        while not depth_tasks >> last & 1:
            last -= 1
        depth_tasks ^= np.int64(1) << last
        depth -= 1
        place = last + 1


def largest_sets(sets: np.ndarray, possible: np.ndarray, size: int) -> np.ndarray:
    """Return (n,) bool: no task can be added to the set."""
    largest = np.ones(len(sets), np.bool_)
    for task in range(size):
        largest &= (sets >> task & 1 == 1) | ~possible[sets | 1 << task]
    return largest


@compiled
def mark_in_time(sets, covered, everything, ticks, durations, starts, holding, fails, known, possible, kept):
    """Mark the sets after which the tasks that are left can be done in time."""
    for number in range(len(sets)):
        lowest = 0
        while not sets[number] >> lowest & 1:
            lowest += 1
        left = everything & ~(covered | sets[number])
        kept[number] = can_cover(left, ticks - durations[lowest], durations, starts, holding, fails, known, possible)


@compiled
def can_cover(left, ticks, durations, starts, holding, fails, known, possible):
    """Tell whether tasks can be covered by sets within so many ticks; what is found out is kept."""
    if left == 0:
        return ticks >= 0
    if ticks <= fails[left]:
        return False
    if ticks >= known[left]:
        return True
    longest = 0
    while not left >> longest & 1:
        longest += 1
    rest = ticks - durations[longest]
    if possible[left]:
        return rest >= 0
    shortest = durations[longest]  # of what is left; at least two slots are needed
    for task in range(longest, len(durations)):
        if left >> task & 1:
            shortest = min(shortest, durations[task])
    if rest >= shortest:
        for place in range(starts[longest], starts[longest + 1]):
            if can_cover(left & ~holding[place], rest, durations, starts, holding, fails, known, possible):
                known[left] = ticks
                return True
    fails[left] = ticks
    return False

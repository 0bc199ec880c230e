"""Which tasks come before which: everything that follows from the priorities."""

import numpy as np

from formicarium.scheduling.problem import Problem


def closure(problem: Problem) -> np.ndarray:
    """Return (T, T) bool: the first task is before the second, directly or through others."""
    before = np.zeros((problem.size, problem.size), bool)
    before[problem.before[:, 0], problem.before[:, 1]] = True
    for middle in np.unique(problem.before):
        before |= before[:, middle : middle + 1] & before[middle : middle + 1, :]
    return before


def bits_of(related: np.ndarray) -> np.ndarray:
    """Return (T,) the rows of a (T, T) table of yes and no as bits of whole numbers."""
    return np.array([sum(1 << int(t) for t in np.flatnonzero(row)) for row in related], np.int64)


def longest_chain(problem: Problem) -> int:
    """Return the ticks of the longest chain of tasks that must be done one after the other."""
    order = in_order(problem)
    ends = problem.ticks.copy()
    for task in order:
        earlier = problem.before[problem.before[:, 1] == task, 0]
        if len(earlier):
            ends[task] += ends[earlier].max()
    return int(ends.max())


def in_order(problem: Problem) -> list[int]:
    """Return the tasks, every one after those that come before it, long ones first where that is free."""
    before = closure(problem) if len(problem.before) else np.zeros((problem.size, problem.size), bool)
    depth = np.zeros(problem.size, np.int64)
    for task in np.argsort(before.sum(axis=0), kind="stable"):
        earlier = np.flatnonzero(before[:, task])
        depth[task] = depth[earlier].max() + 1 if len(earlier) else 0
    return sorted(range(problem.size), key=lambda task: (depth[task], -problem.ticks[task], task))


def ordered(slots: list[tuple[int, ...]], problem: Problem) -> list[tuple[int, ...]] | None:
    """Return slots in an order that respects the priorities, or None if there is none."""
    if not len(problem.before):
        return slots
    place = {task: number for number, slot in enumerate(slots) for task in slot}
    after: dict[int, set[int]] = {number: set() for number in range(len(slots))}
    for first, second in problem.before:
        after[place[int(second)]].add(place[int(first)])
    done: list[int] = []
    while len(done) < len(slots):
        free = [number for number in after if number not in done and after[number] <= set(done)]
        if not free:
            return None
        done.append(free[0])
    return [slots[number] for number in done]

"""A schedule from the relaxation, for many tasks: the sets that it uses most are fixed, again and again."""

from collections.abc import Iterable

import numpy as np

from formicarium.scheduling.clock import Clock
from formicarium.scheduling.covering import Set
from formicarium.scheduling.highs import Linear
from formicarium.scheduling.problem import Problem

WIDTH = 6  # sets a task that are considered, those that pay best
SURE = 0.9  # used so much in the relaxation, a set is fixed
SHARE = 0.05  # of the slots that are still needed is fixed in any case


def dive(problem: Problem, sets: Iterable[Set], gains: np.ndarray, seconds: float, clock: Clock) -> list[Set]:
    """Return a schedule, or slots for some of the tasks if time runs out.

    Args:
        problem: without priorities.
        sets: that can be done at once; every task alone is among them.
        gains: (T,) prices of the tasks.
        seconds: to spend at most.
        clock: of the whole work.
    """
    until = clock.seconds + seconds
    loss = {chosen: float(problem.ticks[list(chosen)].max() - gains[list(chosen)].sum()) for chosen in sets}
    alone = [(task,) for task in range(problem.size)]
    known = [*alone, *sorted(loss, key=lambda chosen: loss[chosen])[: WIDTH * problem.size]]
    open_tasks, slots = set(range(problem.size)), list[Set]()
    while open_tasks and clock.seconds < until:
        known = list(dict.fromkeys(part for chosen in known if (part := _left(chosen, open_tasks))))
        row = {task: number for number, task in enumerate(sorted(open_tasks))}
        linear = Linear([1.0] * len(row))
        for chosen in known:
            linear.add(float(problem.ticks[list(chosen)].max()), [row[task] for task in chosen])
        amounts = linear.solve()[1]
        fixed = max(1, int(SHARE * amounts.sum()))
        for number, place in enumerate(np.argsort(-amounts, kind="stable")):
            if number >= fixed and amounts[place] < SURE:
                break
            if part := _left(known[place], open_tasks):
                slots.append(part)
                open_tasks.difference_update(part)
    return slots


def _left(chosen: Set, open_tasks: set[int]) -> Set:
    return tuple(task for task in chosen if task in open_tasks)

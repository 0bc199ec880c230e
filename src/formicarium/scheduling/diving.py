"""Schedules from the relaxation: the sets that it uses most are fixed, and what is left is relaxed again."""

import numpy as np

from formicarium.scheduling.covering import Covering, Set
from formicarium.scheduling.problem import Problem

WIDTH = 6  # sets a task that are considered, those that pay best
SURE = 0.9  # used so much in the relaxation, a set is fixed
SHARE = 0.05  # of the slots that are still needed is fixed in any case


def dive(
    problem: Problem, covering: Covering, gains: np.ndarray, rounds: int, below: float, until: float,
    draws: np.random.Generator | None,
) -> list[Set]:  # fmt: skip
    """Return a schedule, or nothing if it would not be better or time runs out.

    Args:
        problem: without priorities.
        covering: with sets that can be done at once; every task alone is among them.
        gains: (T,) prices of the tasks.
        rounds: looks for better sets after each step.
        below: schedules that take so many ticks or more are of no interest.
        until: on the covering's clock.
        draws: to prefer some sets over others by chance; None to take what is used most.
    """
    loss = {chosen: float(problem.ticks[list(chosen)].max() - gains[list(chosen)].sum()) for chosen in covering.sets}
    alone = [(task,) for task in range(problem.size)]
    known = [*alone, *sorted(loss, key=lambda chosen: loss[chosen])[: WIDTH * problem.size]]
    open_tasks, slots, spent = set(range(problem.size)), list[Set](), 0
    while open_tasks:
        if covering.clock.seconds > until:
            return []
        sketch = covering.sketch(np.array(sorted(open_tasks)), known, rounds, until)
        if spent + sketch.value > below - 1 + 1e-6:
            return []
        known = list(sketch.weights)
        amounts = np.array(list(sketch.weights.values()))
        wanted = amounts if draws is None else amounts * draws.uniform(0.5, 1.0, len(amounts))
        fixed = max(1, int(SHARE * amounts.sum()))
        for number, place in enumerate(np.argsort(-wanted, kind="stable")):
            if number >= fixed and amounts[place] < SURE:
                break
            if part := tuple(task for task in known[place] if task in open_tasks):
                slots.append(part)
                spent += int(problem.ticks[list(part)].max())
                open_tasks.difference_update(part)
    return slots

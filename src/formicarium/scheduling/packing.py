"""Schedules from sets: first fit, and the best choice among sets that are known."""

import numpy as np

from formicarium.scheduling.clock import Clock
from formicarium.scheduling.covering import Set
from formicarium.scheduling.deployment import Places
from formicarium.scheduling.highs import INFINITY, Mixed
from formicarium.scheduling.precedence import closure, in_order, ordered
from formicarium.scheduling.problem import Problem

Slots = list[Set]


def ticks_of(problem: Problem, slots: Slots) -> int:
    """Return the completion time of slots."""
    return int(sum(problem.ticks[list(slot)].max() for slot in slots))


def first_fit(problem: Problem, places: Places) -> Slots:
    """Put every task into the first slot that still takes it, long tasks first, after all that come before it."""
    before = closure(problem)
    slots: Slots = []
    at: dict[int, int] = {}
    for task in in_order(problem):
        earlier = [at[int(other)] for other in np.flatnonzero(before[:, task])]
        for number in range(max(earlier, default=-1) + 1, len(slots)):
            grown = tuple(sorted((*slots[number], task)))
            if places.deploy(np.array(grown)) is not None:
                slots[number] = grown
                break
        else:
            number = len(slots)
            slots.append((task,))
        at[task] = number
    return slots


def choose(
    problem: Problem, sets: list[Set], seconds: float, below: int, layers: list[tuple[int, int]], clock: Clock
) -> tuple[Slots | None, float]:
    """Return the best schedule that the sets allow, and what none of theirs is better than.

    Args:
        problem: that the sets belong to.
        sets: that can be done at once.
        seconds: to spend at most.
        below: schedules that take so many ticks or more are of no interest.
        layers: (ticks, number): so many slots last at least so long in any schedule.
        clock: of the whole work.
    """
    related = closure(problem)
    strict = bool(len(problem.before))
    if strict:  # a priority may force a task out of a set that could hold it: parts of sets matter, and each task once
        sets = [s for s in sets if not related[np.ix_(s, s)].any()]
    model = Mixed()
    ticks = [int(problem.ticks[list(chosen)].max()) for chosen in sets]
    for cost in ticks:
        model.column(float(cost), 0.0, 1.0, whole=True)
    holding: list[list[int]] = [[] for _ in range(problem.size)]
    for number, chosen in enumerate(sets):
        for task in chosen:
            holding[task].append(number)
    for task in range(problem.size):
        model.row(1.0, [(number, 1.0) for number in holding[task]], 1.0 if strict else INFINITY)
    for length, least in layers:
        model.row(float(least), [(k, 1.0) for k, cost in enumerate(ticks) if cost >= length], INFINITY)
    if strict:
        _forbid_circles(problem, model, holding)
    _, amounts, bound = model.solve(clock, seconds, absolute_gap=0.999, cutoff=below - 0.5)
    if amounts is None:
        return None, bound
    slots = _once(problem, [chosen for chosen, amount in zip(sets, amounts) if amount > 0.5])
    return ordered(slots, problem), bound


def _forbid_circles(problem: Problem, model: Mixed, holding: list[list[int]]) -> None:
    """Give tasks with priorities a position, the same for all that share a set: then slots can be put in order."""
    most = problem.size
    position = {int(task): model.column(0.0, 0.0, float(most)) for task in np.unique(problem.before)}
    for first, second in problem.before:
        model.row(1.0, [(position[int(second)], 1.0), (position[int(first)], -1.0)], INFINITY)
    names = sorted(position)
    for one in names:
        for other in names:
            together = sorted(set(holding[one]) & set(holding[other]))
            if one != other and together:
                terms = [(position[one], 1.0), (position[other], -1.0), *((k, -float(most)) for k in together)]
                model.row(-float(most), terms, INFINITY)


def _once(problem: Problem, slots: Slots) -> Slots:
    """Leave every task in the longest of the slots that hold it."""
    done: set[int] = set()
    kept = []
    for slot in sorted(slots, key=lambda slot: -int(problem.ticks[list(slot)].max())):
        left = tuple(task for task in slot if task not in done)
        done.update(left)
        if left:
            kept.append(left)
    return kept

"""Slots as a covering problem: every task in some slot, each slot a set that can be done at once.

Sets are found by pricing. A slot that lasts a level longer than another one counts in all rows below it: the
duration layers demand that enough slots last at least so long.
"""

from collections.abc import Iterable
from typing import NamedTuple

import numpy as np

from formicarium.scheduling.clock import Clock
from formicarium.scheduling.highs import Linear
from formicarium.scheduling.pricing import Prices
from formicarium.scheduling.problem import Problem

EPSILON = 1e-7
FEW_BOXES, MORE, MOST_BOXES = 300, 30, 8_100_000  # of a first look for better sets; next time; of a proof of none
BOXES_A_SECOND = 300_000  # at least: a look that could take longer than there is time is not begun

Set = tuple[int, ...]  # tasks, sorted


class Layer(NamedTuple):
    """A length that slots can have, and how many slots are at least that long in any schedule."""

    ticks: int
    least: int


class Cover(NamedTuple):
    """What the linear relaxation gives."""

    bound: float  # of the sum of durations, ticks
    gains: np.ndarray  # (T,) duals of the tasks, feasible: no set costs less than it gains
    layer_gains: np.ndarray  # (layers,) duals of the layers
    weights: dict[Set, float]  # sets in use
    converged: bool  # the bound is the value of the relaxation


class Covering:
    """The relaxation for some tasks; sets are kept and used again for other layers."""

    def __init__(self, problem: Problem, clock: Clock):
        """Prepare for a problem; begin with every task alone."""
        self.problem = problem
        self.clock = clock
        self.sets: dict[Set, None] = {(task,): None for task in range(problem.size)}
        self._prices = Prices(problem)

    def add(self, sets: Iterable[Set]) -> None:
        """Take over sets that can be done at once."""
        self.sets.update(dict.fromkeys(sets))

    def relax(self, tasks: np.ndarray, layers: list[Layer], enough: float, seconds: float, whole: int = 1) -> Cover:
        """Cover tasks at least cost in the linear relaxation.

        Args:
            tasks: to be covered.
            layers: lengths of slots from short to long, with the number of slots that is known to be needed; every
                length of a task among them. A single layer of one tick gives the least number of slots.
            enough: stop when the bound, rounded up, is as large.
            seconds: to spend at most.
            whole: costs of schedules are multiples of this.
        """
        problem, until = self.problem, self.clock.seconds + seconds
        row = {int(task): number for number, task in enumerate(tasks)}
        single = len(layers) == 1
        levels = np.array([layer.ticks for layer in layers])
        allowed = np.zeros((len(layers), problem.size), bool)
        for number, layer in enumerate(layers):
            allowed[number, tasks] = True if single else problem.ticks[tasks] <= layer.ticks
        linear = Linear([1.0] * len(tasks) + [layer.least for layer in layers])
        columns: list[tuple[Set, int]] = []

        def put(chosen: Set, level: int) -> None:
            linear.add(levels[level], [row[t] for t in chosen] + [len(tasks) + k for k in range(level + 1)])
            columns.append((chosen, level))

        known: set[tuple[Set, int]] = set()
        for chosen in list(self.sets):
            part = tuple(t for t in chosen if t in row)
            level = 0 if single or not part else int(np.searchsorted(levels, problem.ticks[list(part)].max()))
            if part and (part, level) not in known:
                known.add((part, level))
                put(part, level)
        for level in range(len(layers)):
            put((), level)
        least, best = 0.0, Cover(0.0, np.zeros(problem.size), np.zeros(len(layers)), {}, False)
        while True:
            value, amounts, duals = linear.solve()
            gains = np.zeros(problem.size)
            gains[tasks] = duals[: len(tasks)]
            paid = np.cumsum(duals[len(tasks) :])
            boxes = FEW_BOXES
            while True:
                found, worst, exact = 0, 1.0, True
                for level in range(len(layers) - 1, -1, -1):
                    worth = levels[level] - paid[level]
                    priced = self._prices.best(gains, allowed[level], worth + EPSILON, boxes)
                    worst = max(worst, (priced.bound + paid[level]) / levels[level])
                    exact = exact and priced.bound <= worth + 2 * EPSILON
                    for tasks_found in priced.sets[-12:]:
                        whole_set = tuple(int(t) for t in tasks_found)
                        self.sets[whole_set] = None
                        put(whole_set, level)
                        found += 1
                boxes *= MORE
                most = min(MOST_BOXES, BOXES_A_SECOND * (until - self.clock.seconds))
                if found or exact or boxes > most:
                    break
            if value / worst > least or exact:
                least = max(least, value / worst)
                used = {
                    columns[k][0]: a for k, a in enumerate(amounts[: len(columns)]) if a > EPSILON and columns[k][0]
                }
                best = Cover(least, gains / worst, np.diff(paid, prepend=0.0) / worst, used, exact)
            rounded = np.ceil(least / whole - 1e-6) * whole
            if exact or not found or rounded >= enough or self.clock.seconds > until:
                return best

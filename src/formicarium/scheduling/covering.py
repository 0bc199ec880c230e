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
BOXES_A_SECOND = 6_000_000  # and task, at least: a last look that could take longer than there is time is not begun
FEWEST_BOXES = 50  # of a look, however little time there is
SOME = 40  # tasks; from there on pricing looks closely at once
MANY = 150  # tasks; from there on every part of the region is asked for its sets, and prices lie in the interior

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
    converged: bool  # no set is worth more than it costs


class Sketch(NamedTuple):
    """A relaxation that no proof rests on."""

    value: float  # ticks
    weights: dict[Set, float]  # sets of the programme, and how much of each it uses


class Look(NamedTuple):
    """How closely better sets are looked for."""

    side: int  # parts of the region along each side
    boxes: int  # of the deployment point, in each part, at first
    closer: int  # times as many after a look that found few
    glance: int  # boxes of a look that no proof rests on
    most: int  # boxes of a proof that there are no better sets, in each part
    held: float = 0.0  # how far prices are held back, as a share of the way to those of the best bound


FEW_TASKS, SOME_TASKS = Look(1, 300, 30, 300, 8_100_000), Look(1, 30_000, 10, 3_000, 8_100_000)
MANY_TASKS = Look(16, 3_000, 3, 50, 100_000, 0.5)


class Covering:
    """The relaxation for some tasks; sets are kept and used again for other layers."""

    def __init__(self, problem: Problem, clock: Clock):
        """Prepare for a problem; begin with every task alone."""
        self.problem = problem
        self.clock = clock
        self.sets: dict[Set, None] = {(task,): None for task in range(problem.size)}
        self._look = MANY_TASKS if problem.size > MANY else SOME_TASKS if problem.size > SOME else FEW_TASKS
        self._prices = Prices(problem, many=problem.size > MANY)
        self._parts = _parts(problem.region, self._look.side)

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
        until, look = self.clock.seconds + seconds, self._look
        programme = _Programme(self.problem, tasks, layers, self.sets, self.problem.size > MANY)
        best = Cover(0.0, np.zeros(self.problem.size), np.zeros(len(layers)), False)
        boxes = first = self._first_boxes(until, len(layers))
        prices = at = inside = programme.solve()
        while True:
            found, worst = self._price(programme, at, boxes)
            own = at is prices
            exact = own and worst <= 1.0 + 2 * EPSILON
            if at.value / worst > best.bound or exact:
                inside = _Prices(at.gains / worst, at.paid / worst, at.value / worst)
                best = Cover(max(best.bound, inside.value), inside.gains, np.diff(at.paid, prepend=0.0) / worst, exact)
            if own or found:
                few = found < len(self._parts) / 4
                boxes = min(boxes, look.most) * look.closer if few else max(first, boxes // look.closer)
            rounded = np.ceil(best.bound / whole - 1e-6) * whole
            done = exact or rounded >= enough or (own and not found and boxes > self._most(until))
            if done or self.clock.seconds > until:
                return best
            if found:
                prices = at = programme.solve()
                if look.held:
                    at = prices.held_back(inside, look.held)
            else:
                at = prices

    def sketch(self, tasks: np.ndarray, known: Iterable[Set], rounds: int, until: float) -> "Sketch":
        """Cover tasks in the relaxation as far as sets suffice that are known or found in a few quick looks.

        Args:
            tasks: to be covered.
            known: sets that are looked at; what they hold of other tasks does not matter.
            rounds: looks for better sets, at most.
            until: on the clock; no look is begun later.
        """
        layers = [Layer(int(ticks), 0) for ticks in np.unique(self.problem.ticks[tasks])]
        programme = _Programme(self.problem, tasks, layers, known, self.problem.size > MANY)
        prices = programme.solve()
        for _ in range(rounds):
            if self.clock.seconds > until:
                break
            found, _ = self._price(programme, prices, self._look.glance)
            if not found:
                break
            prices = programme.solve()
        return Sketch(prices.value, programme.weights())

    def _most(self, until: float) -> float:
        affordable = BOXES_A_SECOND / self.problem.size * (until - self.clock.seconds)
        return min(self._look.most, affordable / len(self._parts))

    def _first_boxes(self, until: float, layers: int) -> int:
        """Return how many boxes to begin with: where there are many parts, as many as there is time for in all."""
        if len(self._parts) == 1:
            return self._look.boxes
        return min(self._look.boxes, max(FEWEST_BOXES, int(self._most(until) / layers)))

    def _price(self, programme: "_Programme", prices: "_Prices", boxes: int) -> tuple[int, float]:
        """Add sets that are worth more than they cost; return their number and the most that a set exceeds its cost.

        Nothing is known of the most, it is infinite, if all time is up before everything has been looked at.
        """
        found, worst = 0, 1.0
        for level in range(len(programme.levels) - 1, -1, -1):
            length, paid = programme.levels[level], prices.paid[level]
            for part in self._parts:
                if self.clock.left <= 0.0:
                    return found, np.inf
                priced = self._prices.best(prices.gains, programme.allowed[level], length - paid + EPSILON, boxes, part)
                worst = max(worst, (priced.bound + paid) / length)
                for tasks in priced.sets[-12:]:
                    chosen = tuple(int(t) for t in tasks)
                    self.sets[chosen] = None
                    found += programme.put(chosen, level)
        return found, worst


class _Prices(NamedTuple):
    """What the programme would pay."""

    gains: np.ndarray  # (T,) for a task
    paid: np.ndarray  # (layers,) for a slot that is so long, all shorter layers included
    value: float  # for everything

    def held_back(self, towards: "_Prices", share: float) -> "_Prices":
        """Return prices on the way to others: those of a corner swing from round to round (Wentges 1997)."""
        own = 1.0 - share
        return _Prices(
            own * self.gains + share * towards.gains,
            own * self.paid + share * towards.paid,
            own * self.value + share * towards.value,
        )


class _Programme:
    """The linear programme: a row a task, then one a layer; a column a set and the layer that it is used in."""

    def __init__(self, problem: Problem, tasks: np.ndarray, layers: list[Layer], sets: Iterable[Set], interior: bool):
        self.levels = np.array([layer.ticks for layer in layers])
        self.allowed = np.zeros((len(layers), problem.size), bool)  # tasks in a set of that layer
        single = len(layers) == 1
        for number, layer in enumerate(layers):
            self.allowed[number, tasks] = True if single else problem.ticks[tasks] <= layer.ticks
        self._tasks, self._row = tasks, {int(task): number for number, task in enumerate(tasks)}
        self._least = np.array([1.0] * len(tasks) + [layer.least for layer in layers])
        self._linear = Linear(self._least, interior)
        self._known: dict[tuple[Set, int], None] = {}
        self._amounts = np.zeros(0)
        for chosen in list(sets):
            part = tuple(t for t in chosen if t in self._row)
            if part:
                self.put(part, 0 if single else int(np.searchsorted(self.levels, problem.ticks[list(part)].max())))
        for level in range(len(layers)):
            self.put((), level)

    def put(self, chosen: Set, level: int) -> bool:
        """Add a column unless it is there."""
        if (chosen, level) in self._known:
            return False
        self._known[chosen, level] = None
        rows = [self._row[t] for t in chosen] + [len(self._tasks) + k for k in range(level + 1)]
        self._linear.add(self.levels[level], rows)
        return True

    def solve(self) -> _Prices:
        """Return prices at which no column is worth more than it costs, or hardly: any prices make a bound."""
        _, self._amounts, duals = self._linear.solve()
        gains = np.zeros(len(self.allowed[0]))
        gains[self._tasks] = duals[: len(self._tasks)]
        return _Prices(gains, np.cumsum(duals[len(self._tasks) :]), float(duals @ self._least))

    def weights(self) -> dict[Set, float]:
        """Return how much of each set was used when it was last solved; nothing of what came later."""
        amounts = np.pad(self._amounts, (0, len(self._known) - len(self._amounts)))
        return {chosen: float(amount) for (chosen, _), amount in zip(self._known, amounts, strict=True) if chosen}


def _parts(region: np.ndarray, side: int) -> np.ndarray:
    """Return the parts of a region, (side^2, 4) as x0, y0, x1, y1."""
    xs, ys = np.linspace(region[0], region[2], side + 1), np.linspace(region[1], region[3], side + 1)
    return np.array([(xs[i], ys[j], xs[i + 1], ys[j + 1]) for i in range(side) for j in range(side)])

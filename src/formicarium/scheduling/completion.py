"""Total Completion Time Minimisation (TCTM), (4): the least sum of slots, and the proof that it is the least.

First a schedule by first fit, then lower bounds layer by layer, then the best choice among the sets that pricing
came across; if bound and schedule still differ, all sets that a better schedule could use. With more than 40 tasks
dives (``diving.py``) come after the first bound, and again at the end, as long as there is time.
"""

from typing import NamedTuple

import numpy as np

from formicarium.scheduling.clock import Clock, OutOfTime
from formicarium.scheduling.covering import MANY, SOME, Cover, Covering, Layer, Set
from formicarium.scheduling.deployment import Places
from formicarium.scheduling.diving import dive
from formicarium.scheduling.enumeration import sets_below
from formicarium.scheduling.packing import Slots, choose, first_fit, ticks_of
from formicarium.scheduling.precedence import longest_chain
from formicarium.scheduling.problem import Problem
from formicarium.streams import generator

MOST_ENTRIES = 20_000_000  # of an enumeration: sets times tasks
SHARE = 0.5  # of the time that is left, for all layers together
LOOKS = 8  # for sets, after each step of a dive
FEW, MOST_DIVES = 20, 400  # dives in a row, and in all
LONGEST_GROWTH = 30.0  # s of growing sets, which hears no Ctrl-C
CHOOSING = 0.25  # of the time that is left, for a choice among known sets


class Completion(NamedTuple):
    """What is known of the least completion time, in ticks."""

    slots: Slots
    value: int
    bound: int
    proof: str  # which part made the bound


class Search:
    """The state of a search for the least completion time; can be stopped at any moment."""

    def __init__(self, problem: Problem, places: Places, clock: Clock, share: float = 1.0):
        """Begin with first fit and the longest chain of priorities; last dives take a share of what time is left."""
        self.problem, self.places, self.clock, self.share = problem, places, clock, share
        slots = first_fit(problem, places)
        value = ticks_of(problem, slots)
        chain = max(longest_chain(problem), int(problem.ticks.max()))
        self.best = Completion(slots, value, chain, "longest chain")

    def run(self) -> None:
        """Close the gap, or raise OutOfTime."""
        self._tell("first fit")
        covering = Covering(self.problem, self.clock)
        covering.add(self.best.slots)
        gains = self._dive_first(covering) if self.problem.size > SOME and not len(self.problem.before) else None
        if not self._open():
            return
        layers, cover = self._relax(covering)
        if self._open():
            self._choose(covering, layers)
        if self._open() and not cover.converged and gains is None:  # no dives: the bound may have what time there is
            seconds = self.share * self.clock.left
            cover = covering.relax(np.arange(self.problem.size), layers, self.best.value, seconds)
            self._raise_bound(cover.bound, "covering")
        if self._open() and cover.converged:
            self._enumerate(cover, layers)
        if gains is None:
            return
        until = self.clock.seconds + self.share * self.clock.left
        for first in range(FEW, MOST_DIVES, FEW):
            value = self.best.value
            self._dive(covering, gains, range(first, first + FEW), until - self.clock.seconds)
            if self._open() and cover.converged and self.best.value < value:  # fewer sets could do better now
                self._enumerate(cover, layers)

    def _dive_first(self, covering: Covering) -> np.ndarray:
        """Bound the time without the layers and dive; return the tasks' gains, (T,)."""
        lengths = [int(ticks) for ticks in np.unique(self.problem.ticks)]
        whole = lengths[0] if len(lengths) == 1 else 1
        layers = [Layer(length, 0) for length in lengths]
        everything = np.arange(self.problem.size)
        cover = covering.relax(everything, layers, self.best.value, self._share(1), whole)
        self._raise_bound(cover.bound, "covering")
        self._dive(covering, cover.gains, range(FEW), CHOOSING * self.clock.left)
        return cover.gains

    def _open(self) -> bool:
        return self.best.bound < self.best.value

    def _tell(self, part: str) -> None:
        self.clock.tell(part, self.best.bound, self.best.value)

    def _relax(self, covering: Covering) -> tuple[list[Layer], Cover]:
        """Bound the number of slots that last at least so long, from the longest tasks to all, then the time."""
        problem = self.problem
        lengths = [int(ticks) for ticks in np.unique(problem.ticks)]
        everything = np.arange(problem.size)
        if len(lengths) == 1:
            cover = covering.relax(everything, [Layer(lengths[0], 0)], self.best.value, self._share(1), lengths[0])
            self._raise_bound(cover.bound, "covering")
            return [Layer(lengths[0], self.best.bound // lengths[0])], cover
        layers: list[Layer] = []
        for number, length in enumerate(reversed(lengths)):
            tasks = np.flatnonzero(problem.ticks >= length)
            slots = sum(problem.ticks[list(slot)].max() >= length for slot in self.best.slots)
            cover = covering.relax(tasks, [Layer(1, 0)], float(slots), self._share(len(lengths) - number + 1))
            least = max(int(np.ceil(cover.bound - 1e-6)), layers[0].least if layers else 1)
            layers.insert(0, Layer(length, least))
            self.clock.check()
        steps = np.diff([0, *lengths])
        self._raise_bound(sum(step * layer.least for step, layer in zip(steps, layers)), "duration layers")
        if self._open():
            self._choose(covering, layers, 0.1)
        cover = covering.relax(everything, layers, self.best.value, self._share(1))
        self._raise_bound(cover.bound, "covering with duration layers")
        return layers, cover

    def _share(self, parts: int) -> float:
        return SHARE * self.clock.left / parts

    def _raise_bound(self, bound: float, proof: str) -> None:
        whole = int(np.ceil(bound - 1e-6)) if np.isfinite(bound) else 0
        if whole > self.best.bound:
            self.best = self.best._replace(bound=min(whole, self.best.value), proof=proof)
        self._tell(proof)
        self.clock.check()

    def _improve(self, slots: Slots | None, part: str) -> None:
        if slots is not None and (value := ticks_of(self.problem, slots)) < self.best.value:
            self.best = self.best._replace(slots=slots, value=value)
        self._tell(part)
        self.clock.check()

    def _dive(self, covering: Covering, gains: np.ndarray, numbers: range, seconds: float) -> None:
        """Dive again and again, each time with other preferences; the first has none, and of many tasks no look."""
        problem, until = self.problem, self.clock.seconds + seconds
        for number in numbers:
            if not self._open() or self.clock.seconds > until:
                return
            looks = LOOKS if problem.size <= MANY else min(number, 1)
            draws = generator(number, "dives") if number else None
            slots = dive(problem, covering, gains, looks, self.best.value, until, draws)
            self._improve(slots or None, "diving")

    def _choose(self, covering: Covering, layers: list[Layer], share: float = CHOOSING) -> None:
        seconds = min(60.0, share * self.clock.left)
        known = [(layer.ticks, layer.least) for layer in layers]
        slots, _ = choose(self.problem, list(covering.sets), seconds, self.best.value, known, self.clock)
        self._improve(slots, "choice among known sets")

    def _enumerate(self, cover: Cover, layers: list[Layer]) -> None:
        """Choose among all sets whose reduced cost allows a better schedule: then the choice is the proof."""
        problem, gap = self.problem, self.best.value - 1 - cover.bound
        paid, most = np.cumsum(cover.layer_gains), MOST_ENTRIES // problem.size
        sets: list[Set] = []
        for layer, price in zip(layers, paid):
            allowed = problem.ticks <= layer.ticks
            worth = layer.ticks - price - gap - 1e-6
            seconds = LONGEST_GROWTH if self.clock.left > 2.0 * LONGEST_GROWTH else 0.5 * self.clock.left
            found = sets_below(problem, self.places, cover.gains, worth, layer.ticks, allowed, most, seconds)
            if found is None or len(sets) + len(found) > most:
                return
            sets += found
            self.clock.check()
        known = [(layer.ticks, layer.least) for layer in layers]
        slots, bound = choose(problem, sets, self.clock.left, self.best.value, known, self.clock)
        self._improve(slots, "enumeration")
        self._raise_bound(min(bound, self.best.value), "enumeration")


def least_time(problem: Problem, places: Places, clock: Clock, share: float = 1.0) -> tuple[Completion, str]:
    """Return the best schedule and bound, and how the work ended: "proven", "time limit", "gave up", "interrupted".

    Args:
        problem: to be solved.
        places: its slot oracle.
        clock: of the whole work.
        share: of the time that is left when nothing but further dives may help, to be spent on those.
    """
    search = Search(problem, places, clock, share)
    ended = "time limit"
    try:
        search.run()
    except OutOfTime:
        pass
    except ArithmeticError:  # HiGHS has no answer: the best so far stands
        ended = "gave up"
    except KeyboardInterrupt:
        ended = "interrupted"
    if search.best.bound >= search.best.value:
        ended = "proven"
    elif ended == "time limit" and clock.left > 0:
        ended = "gave up"
    return search.best, ended

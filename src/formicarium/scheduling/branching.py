"""Branch and bound over tours: which set does an open task, and at which place of the order it stands."""

from typing import NamedTuple

import numpy as np

from formicarium.scheduling.clock import Clock
from formicarium.scheduling.descent import CAREFUL, Descent, Incumbent
from formicarium.scheduling.families import Family
from formicarium.scheduling.insertion import Insertions
from formicarium.scheduling.itinerary import Itineraries
from formicarium.scheduling.lattice import NEVER
from formicarium.scheduling.precedence import bits_of
from formicarium.scheduling.problem import Problem


class Node(NamedTuple):
    """Some sets in an order; all schedules that keep it."""

    bound: float
    tour: tuple[int, ...]  # sets
    sets: np.ndarray  # that may still be added
    outside: float  # what the arms to the tasks that are in no set yet cost at least


class Branching(Descent[Node]):
    """The search."""

    def __init__(
        self, problem: Problem, family: Family, insertions: Insertions, incumbent: Incumbent, bound: float,
        ticks: int, charge_first: bool, related: np.ndarray, ways: Itineraries, clock: Clock,
    ):  # fmt: skip
        """Prepare.

        Args:
            problem: with tasks from long to short.
            family: its possible sets.
            insertions: its lower bounds.
            incumbent: best tour so far, improved as the search goes on.
            bound: of all schedules.
            ticks: that a schedule may take.
            charge_first: whether the way from the start counts; if not, a tour may be turned round.
            related: (T, T) bool: before.
            ways: for bounds of a tour and the cost of a whole one.
            clock: of the whole work.
        """
        super().__init__(incumbent, bound, clock)
        self.problem, self.family, self.insertions, self.ticks, self.ways = problem, family, insertions, ticks, ways
        self._after = bits_of(related).tolist()
        self._mirrored = not charge_first and not related.any()
        self._everything = (1 << problem.size) - 1

    @property
    def root(self) -> Node:
        """All schedules that take no longer."""
        return Node(self.bound, (), self.family.leaving_time(0, self.ticks), 0.0)

    def _children(self, node: Node) -> list[Node]:
        """Return what a node falls into: its open task in every set at every place."""
        covered = sum(node.tour)
        left = self._everything & ~covered
        if len(node.tour) > 1:
            relaxed = self.ways.bound(self._slots(node.tour), self.incumbent.goal - node.outside) + node.outside
            if relaxed >= self.incumbent.goal:
                return []
            node = node._replace(bound=max(node.bound, relaxed))
        if not left:
            self._leaf(node.tour)
            return []
        tour = np.array(node.tour, np.int64)
        bounds, arms = self.insertions.bounds(tour, node.sets, left, self.incumbent.goal / (1 - CAREFUL))
        self._forbid(node.tour, node.sets, bounds)
        hopeful = bounds < NEVER
        alive = hopeful.any(axis=1)
        sets, bounds, hopeful = node.sets[alive], bounds[alive], hopeful[alive]
        tasks = [task for task in range(self.problem.size) if left >> task & 1]
        choices = hopeful.sum(axis=1)
        counts = [int(choices[sets >> task & 1 == 1].sum()) for task in tasks]
        task = tasks[int(np.argmin(counts))]
        children = []
        least = bounds.min(axis=1, initial=NEVER)
        floor = max(float(least[sets >> other & 1 == 1].min(initial=NEVER)) for other in tasks)
        spent = int(sum(self._length(mask) for mask in node.tour))
        for number in np.flatnonzero(sets >> task & 1 == 1):
            mask = int(sets[number])
            outside = sum(float(arms[other]) for other in tasks if not mask >> other & 1)
            further = None
            for place in np.flatnonzero(hopeful[number]):
                if further is None:
                    further = self._further(sets, covered | mask, spent + self._length(mask))
                grown = (*node.tour[:place], mask, *node.tour[place:])
                children.append(Node(max(node.bound, floor, float(bounds[number, place])), grown, further, outside))
        return children

    def _further(self, sets: np.ndarray, covered: int, spent: int) -> np.ndarray:
        """Return the sets that may still be added after one more."""
        sets = sets[sets & covered == 0]
        return self.family.in_time(sets, covered, self.ticks - spent)

    def _length(self, mask: int) -> int:
        return int(self.problem.ticks[(mask & -mask).bit_length() - 1])

    def _forbid(self, tour: tuple[int, ...], sets: np.ndarray, bounds: np.ndarray) -> None:
        """Rule out places that the priorities forbid, and one of two mirror images."""
        if self._mirrored and len(tour) == 1:
            bounds[:, 0] = NEVER
        if not any(self._after):
            return
        for number, mask in enumerate(sets):
            for place, other in enumerate(tour):
                if self._before(int(mask), other):
                    bounds[number, place + 1 :] = NEVER
                if self._before(other, int(mask)):
                    bounds[number, : place + 1] = NEVER

    def _before(self, one: int, other: int) -> bool:
        return any(self._after[task] & other for task in range(self.problem.size) if one >> task & 1)

    def _leaf(self, tour: tuple[int, ...]) -> None:
        slots = self._slots(tour)
        way = self.ways.cheapest(slots, self.incumbent.goal)
        self.clock.check()
        self.incumbent.offer(slots, way)

    def _slots(self, tour: tuple[int, ...]) -> list[tuple[int, ...]]:
        return [tuple(t for t in range(self.problem.size) if mask >> t & 1) for mask in tour]

"""Tours grown from one end, with the word of a dynamic programme for all that is still to come.

The end that stands is known on a finer lattice than the programme's, and a whole tour exactly: the more of a tour
stands, the less of its bound is guessed.
"""

from typing import NamedTuple

import numpy as np

from formicarium.scheduling.clock import Clock
from formicarium.scheduling.descent import CAREFUL, Descent, Incumbent
from formicarium.scheduling.heldkarp import HeldKarp
from formicarium.scheduling.insertion import spare_of
from formicarium.scheduling.itinerary import Itineraries
from formicarium.scheduling.lattice import NEVER, Lattice, pool, spread, stand
from formicarium.scheduling.problem import Problem

MOST_KEPT = 3000  # sets whose arms are kept, 64 KB each


class End(NamedTuple):
    """Sets from one end of the order inwards; all schedules that have this end."""

    bound: float
    tour: tuple[int, ...]  # sets
    left: int  # tasks in none of them, as bits
    ticks: int  # that are left for those
    outer: np.ndarray  # (fine cells,) cost of the end but its innermost set, from where that one is done


class Growing(Descent[End]):
    """The search."""

    def __init__(
        self, problem: Problem, rest: HeldKarp, fine: Lattice, from_start: bool, mirrored: bool, incumbent: Incumbent,
        bound: float, ways: Itineraries, clock: Clock,
    ):  # fmt: skip
        """Prepare.

        Args:
            problem: with tasks from long to short.
            rest: the programme from the other end.
            fine: optimistic cells that lie within those of the programme.
            from_start: whether tours grow from the start of the schedule, not from its end.
            mirrored: whether a tour may be turned round.
            incumbent: best tour so far, improved as the search goes on.
            bound: of all schedules.
            ways: for bounds of a whole tour and its cost.
            clock: of the whole work.
        """
        super().__init__(incumbent, bound, clock)
        self.problem, self.rest, self.fine, self.ways = problem, rest, fine, ways
        self._from_start, self._mirrored = from_start, mirrored
        self._arms: dict[int, np.ndarray] = {}
        self._sums = np.empty(fine.side**2, np.int16)
        self._line = np.empty(fine.side, np.float32)

    @property
    def root(self) -> End:
        """All schedules."""
        nothing = np.zeros(self.fine.side**2, np.float32)
        return End(self.bound, (), (1 << self.problem.size) - 1, self.rest.limit, nothing)

    def _children(self, node: End) -> list[End]:
        """Return an end that is longer by a set, for every set; measure those that are whole."""
        here = self._here(node)
        bounds = self.rest.last(node.left, node.ticks, self._pooled(here), self.incumbent.goal / (1 - CAREFUL))
        children = []
        for step in np.flatnonzero(bounds < NEVER):
            chosen, took = int(self.rest.steps.sets[step]), int(self.rest.steps.ticks[step])
            tour, left = (*node.tour, chosen), node.left & ~chosen
            if left:
                children.append(End(max(node.bound, float(bounds[step])), tour, left, node.ticks - took, here))
            elif not (self._mirrored and tour[0] < tour[-1]):
                whole = here + self._stand(chosen) + (0.0 if self._from_start else self.fine.first)
                if whole.min() * (1 - CAREFUL) < self.incumbent.goal:
                    self._measure(tour)
        return children

    def _here(self, node: End) -> np.ndarray:
        """Return (fine cells,) what an end costs from where the set next to it is done."""
        if not node.tour:
            return self.fine.first if self._from_start else node.outer
        fine, out = self.fine, np.empty_like(node.outer)
        spread(node.outer + self._stand(node.tour[-1]), fine.side, np.float32(fine.step[0]), np.float32(fine.step[1]),
               fine.free, out, self._line)  # fmt: skip
        return out

    def _stand(self, chosen: int) -> np.ndarray:
        if chosen not in self._arms:
            if len(self._arms) >= MOST_KEPT:
                self._arms.clear()
            problem, costs = self.problem, np.empty(self.fine.side**2, np.float32)
            spare = spare_of(chosen, problem.robots, problem.limits[0], problem.paths)
            stand(chosen, self.fine.hops, spare, self._sums, costs)
            self._arms[chosen] = costs
        return self._arms[chosen]

    def _pooled(self, costs: np.ndarray) -> np.ndarray:
        """Return the least costs within the programme's larger cells."""
        side = self.rest.steps.lattice.side
        pool(costs, self.fine.side, self.fine.side // side, out := np.empty(side * side, np.float32))
        return out

    def _measure(self, tour: tuple[int, ...]) -> None:
        """Work out what a whole tour costs, and keep it if it is the best."""
        order = tour if self._from_start else tour[::-1]
        slots = [tuple(t for t in range(self.problem.size) if mask >> t & 1) for mask in order]
        if self.ways.bound(slots, self.incumbent.goal) < self.incumbent.goal:
            way = self.ways.cheapest(slots, self.incumbent.goal)
            self.clock.check()
            self.incumbent.offer(slots, way)

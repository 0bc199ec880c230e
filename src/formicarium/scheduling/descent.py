"""Depth first through a tree of partial tours, with a bound that holds at any moment."""

from collections.abc import Sequence
from typing import Generic, Protocol, TypeVar

from formicarium.scheduling.clock import Clock
from formicarium.scheduling.itinerary import Itinerary

CAREFUL = 1e-6  # relative: lattices count in 32 bits
SAME = 1e-7  # hops: tours whose costs differ by less are the same


class Bounded(Protocol):
    """A node: some schedules, none of them cheaper than its bound."""

    @property
    def bound(self) -> float:
        """Least cost, hops."""
        ...


Node = TypeVar("Node", bound=Bounded)


class Incumbent:
    """The best tour so far."""

    def __init__(self, slots: list[tuple[int, ...]], way: Itinerary, gap: float):
        """Begin with a schedule; ``gap`` is the relative distance that counts as none."""
        self.slots, self.way, self.gap = slots, way, gap
        self.target = float("inf")  # what costs as much or more is not looked for

    @property
    def goal(self) -> float:
        """What a schedule must cost less than to be worth finding: better by more than the gap."""
        return min(self.target, self.way.cost - max(SAME, self.gap * self.way.cost))

    def offer(self, slots: list[tuple[int, ...]], way: Itinerary | None) -> bool:
        """Take over a cheaper tour and tell whether it was."""
        if way is None or way.cost >= self.way.cost - 1e-9:
            return False
        self.slots, self.way = slots, way
        return True


class Descent(Generic[Node]):
    """A search; can be stopped at any moment with a valid bound."""

    def __init__(self, incumbent: Incumbent, bound: float, clock: Clock):
        """Begin.

        Args:
            incumbent: best tour so far, improved as the search goes on.
            bound: of all schedules.
            clock: of the whole work.
        """
        self.incumbent, self.bound, self.clock = incumbent, bound, clock
        self._open: list[list[Node]] = []

    @property
    def root(self) -> Node:
        """All schedules."""
        raise NotImplementedError

    def run(self, most: float = float("inf")) -> None:
        """Search to the end or through so many nodes, or raise OutOfTime or KeyboardInterrupt.

        ``bound`` holds at any moment.
        """
        self._open = [[self.root]]
        while self._open and most > 0:
            if not self._open[-1]:
                self._open.pop()
                continue
            node = self._open[-1][-1]
            self._note()
            self.clock.check()
            if node.bound >= self.incumbent.goal:
                self._open[-1].clear()  # sorted: the others are no better
                continue
            most -= 1
            children = sorted(self._children(node), key=lambda child: -child.bound)
            self._open[-1].pop()
            self._open.append(children)
        if not self._open:
            self.bound = max(self.bound, self.incumbent.goal)

    def _note(self) -> None:
        least = min((level[-1].bound for level in self._open if level), default=0.0)
        self.bound = max(self.bound, min(least * (1 - CAREFUL), self.incumbent.goal))
        self.clock.tell("tours", self.bound, self.incumbent.way.cost)

    def _children(self, node: Node) -> Sequence[Node]:
        """Return what a node falls into; nothing if it is done or hopeless."""
        raise NotImplementedError

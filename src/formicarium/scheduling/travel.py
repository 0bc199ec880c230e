"""Total Dislocation Space Minimisation (TDSM), (14): the shortest tour among the schedules of a completion time."""

from typing import Any, NamedTuple

import numpy as np

from formicarium.scheduling.annealing import anneal
from formicarium.scheduling.branching import Branching
from formicarium.scheduling.clock import Clock, OutOfTime
from formicarium.scheduling.deployment import Places
from formicarium.scheduling.descent import CAREFUL, Descent, Incumbent
from formicarium.scheduling.families import MOST_TASKS, Family
from formicarium.scheduling.gathering import gathering_bound
from formicarium.scheduling.growing import Growing
from formicarium.scheduling.heldkarp import MOST_SETS, HeldKarp, Steps
from formicarium.scheduling.insertion import Insertions
from formicarium.scheduling.itinerary import Itineraries, Itinerary, itinerary
from formicarium.scheduling.lattice import lattice_of
from formicarium.scheduling.precedence import bits_of, closure
from formicarium.scheduling.problem import Problem

COARSE, FINE, FINER, FINEST = 16, 32, 64, 128  # cells along each side
GRAIN = 4  # times as many have those on which a tour grows
LOOK = 2000  # nodes of a search before another method may take over
STRIDE = 0.5  # of the way from the bound to the best tour: the next target
NEAR = 0.9  # of the best tour: from there on the bound is raised in one go
ROUNDS, TRIES = 6, 4000  # of annealing; it costs about a second
MOST_ANNEALED = 62  # tasks


class Tour(NamedTuple):
    """A schedule with its deployment points, and what is known of the best one."""

    slots: list[tuple[int, ...]]
    way: Itinerary
    bound: float
    proof: str


def least_travel(
    problem: Problem, places: Places, slots: list[tuple[int, ...]], ticks: int, charge_first: bool, gap: float,
    clock: Clock, so_far: str,
) -> tuple[Tour, str]:  # fmt: skip
    """Return the best tour and bound, and how the work ended.

    Args:
        problem: that the tasks belong to.
        places: its slot oracle.
        slots: a schedule to begin with.
        ticks: that a schedule may take.
        charge_first: whether the way from the start counts.
        gap: relative distance of value and bound that counts as proven.
        clock: of the whole work.
        so_far: how the search for these slots ended.
    """
    order = np.argsort(-problem.ticks, kind="stable")
    place = np.argsort(order)
    problem = _renumbered(problem, order, place)
    search = Search(problem, [tuple(sorted(int(place[t]) for t in slot)) for slot in slots], places, ticks,
                    charge_first, gap)  # fmt: skip
    ended = so_far if so_far == "interrupted" else "time limit"
    try:
        if so_far != "interrupted":
            search.run(clock)
            ended = "gave up"
    except OutOfTime:
        pass
    except ArithmeticError:  # HiGHS has no answer, or a tour does not settle: the best so far stands
        ended = "gave up"
    except KeyboardInterrupt:
        ended = "interrupted"
    tour = search.tour
    if tour.bound >= search.incumbent.goal - 1e-9:
        ended = "proven"
    named, hops = [], []
    for slot, relays in zip(tour.slots, tour.way.hops):
        named.append(tuple(int(order[t]) for t in slot))
        hops.append(relays)
    return tour._replace(slots=named, way=tour.way._replace(hops=hops)), ended


def _renumbered(problem: Problem, order: np.ndarray, place: np.ndarray) -> Problem:
    return problem._replace(
        places=problem.places[order],
        robots=problem.robots[order],
        ticks=problem.ticks[order],
        demands=np.ascontiguousarray(problem.demands[:, order]),
        before=place[problem.before].reshape(-1, 2),
    )


class Search:
    """The state of a search for the shortest tour; can be stopped at any moment."""

    def __init__(
        self, problem: Problem, slots: list[tuple[int, ...]], places: Places, ticks: int, charge_first: bool, gap: float
    ):
        """Begin with a schedule, deployed as the slot oracle says."""
        self.problem, self.ticks, self.charge_first = problem, ticks, charge_first
        self.incumbent = Incumbent(slots, _as_deployed(problem, slots, charge_first), gap)
        self.bound, self.proof = 0.0, "none"

    @property
    def tour(self) -> Tour:
        """The best so far."""
        return Tour(self.incumbent.slots, self.incumbent.way, min(self.bound, self.incumbent.way.cost), self.proof)

    def run(self, clock: Clock) -> None:
        """Shorten the tour and raise the bound until they meet, or raise OutOfTime."""
        problem, incumbent = self.problem, self.incumbent
        ways = Itineraries(problem, self.charge_first, clock)
        incumbent.offer(incumbent.slots, ways.cheapest(incumbent.slots))
        clock.check()
        self._anneal(ways, clock)
        self._raise(gathering_bound(problem, self.charge_first, incumbent.goal), "gathering", clock)
        if problem.size > MOST_TASKS or self.bound >= incumbent.goal:
            return
        related = closure(problem)
        lattice = lattice_of(problem, FINER, self.charge_first, optimistic=True)
        family = Family(problem, lattice.hops, bits_of(related | related.T))
        clock.check()
        if not family.complete:
            return
        branching = Branching(problem, family, Insertions(problem, lattice), incumbent, self.bound, self.ticks,
                              self.charge_first, related, ways, clock)  # fmt: skip
        self._descend(branching, LOOK)
        sets = branching.root.sets
        if self.bound < incumbent.goal and len(sets) <= MOST_SETS:
            try:
                self._grow(family, sets, related, ways, clock)
            finally:  # a bound that meets a target proves nothing about the tour
                incumbent.target = float("inf")
        if self.bound < incumbent.goal:
            self._descend(branching)

    def _grow(self, family: Family, sets: np.ndarray, related: np.ndarray, ways: Itineraries, clock: Clock) -> None:
        """Search tours from one end to the other, below one target after the other until one is met."""
        incumbent = self.incumbent
        coarse = self._programme(family, sets, related, COARSE, from_end=True)
        if not coarse.run(incumbent.goal * (1 + CAREFUL), None, clock):
            return
        self._raise(min(coarse.least * (1 - CAREFUL), incumbent.goal), "programme", clock)
        while self.bound < incumbent.goal:
            if self.bound < NEAR * incumbent.goal:
                incumbent.target = self.bound + STRIDE * (incumbent.goal - self.bound)
            if not self._reach_target(coarse, family, sets, related, ways, clock):
                return
            incumbent.target = float("inf")

    def _reach_target(
        self, coarse: HeldKarp, family: Family, sets: np.ndarray, related: np.ndarray, ways: Itineraries, clock: Clock
    ) -> bool:
        """Find what is cheaper than the target or prove that nothing is; tell whether there was room for that."""
        problem, incumbent, ahead = self.problem, self.incumbent, coarse
        mirrored = not self.charge_first and not related.any()
        growing, from_end = None, False
        for side in (FINE, FINER, FINEST):
            programme = self._programme(family, sets, related, side, from_end)
            if not programme.run(incumbent.goal * (1 + CAREFUL), ahead, clock):
                break
            self._raise(min(programme.least * (1 - CAREFUL), incumbent.goal), "programme", clock)
            grain = lattice_of(problem, min(GRAIN * side, 2 * FINEST), self.charge_first, optimistic=True)
            growing = Growing(problem, programme, grain, from_end, mirrored, incumbent, self.bound, ways, clock)
            self._descend(growing, LOOK if side < FINEST else float("inf"))
            if self.bound >= incumbent.goal:
                return True
            ahead, from_end = programme, not from_end
        if growing is None:
            return False
        self._descend(growing)
        return True

    def _programme(self, family: Family, sets: np.ndarray, related: np.ndarray, side: int, from_end: bool) -> HeldKarp:
        lattice = lattice_of(self.problem, side, self.charge_first, optimistic=True)
        steps = Steps(self.problem, lattice, sets, bits_of(related if from_end else related.T))
        first = np.zeros_like(lattice.first) if from_end else lattice.first
        return HeldKarp(self.problem, family, steps, self.ticks, first)

    def _descend(self, descent: Descent[Any], most: float = float("inf")) -> None:
        try:
            descent.run(most)
        finally:
            if descent.bound > self.bound:
                self.bound, self.proof = descent.bound, "tours"

    def _raise(self, bound: float, proof: str, clock: Clock) -> None:
        if bound > self.bound:
            self.bound, self.proof = bound, proof
        clock.tell(proof, self.bound, self.incumbent.way.cost)
        clock.check()

    def _anneal(self, ways: Itineraries, clock: Clock) -> None:
        problem = self.problem
        if problem.size > MOST_ANNEALED or len(problem.before):
            return
        lattice = lattice_of(problem, FINE, self.charge_first, optimistic=False)
        for number in range(ROUNDS):
            slots = anneal(problem, lattice, self.incumbent.slots, self.ticks, TRIES, number)
            if slots != self.incumbent.slots:
                self.incumbent.offer(slots, ways.cheapest(slots, self.incumbent.way.cost))
            clock.tell("annealing", self.bound, self.incumbent.way.cost)
            clock.check()


def _as_deployed(problem: Problem, slots: list[tuple[int, ...]], charge_first: bool) -> Itinerary:
    places = Places(problem)
    found = [places.deploy(np.array(slot)) for slot in slots]
    points = np.array([[p.x, p.y] for p in found if p is not None])
    return itinerary(problem, points, [p.hops for p in found if p is not None], charge_first)

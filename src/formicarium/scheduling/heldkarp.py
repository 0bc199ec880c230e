"""What has been done, and where the swarm stands: a dynamic programme over sets of tasks on the cells of a lattice.

After Held and Karp (1962): the cheapest way to have done some tasks and to stand in a cell does not care in which order
they were done. A coarse programme from the end tells the fine one from the start what is still to come.
"""

import numpy as np

from formicarium.compiled import compiled
from formicarium.scheduling.clock import Clock
from formicarium.scheduling.families import Family, can_cover
from formicarium.scheduling.insertion import spare_of
from formicarium.scheduling.lattice import NEVER, Lattice, spread, stand
from formicarium.scheduling.problem import Problem

MOST_SETS = 12_000  # that a slot may do
MOST_BYTES = 1_000_000_000  # of the costs of all states
MOST_WORK = 4_000_000  # sets looked at between two looks at the clock


class Steps:
    """The sets that a slot may do, and what each costs in every cell."""

    def __init__(self, problem: Problem, lattice: Lattice, sets: np.ndarray, earlier: np.ndarray):
        """Prepare.

        Args:
            problem: that the sets belong to.
            lattice: optimistic cells.
            sets: (n,) of tasks, as bits.
            earlier: (T,) tasks that must be done before each task, as bits.
        """
        cells = lattice.side**2
        self.lattice, self.sets = lattice, sets
        self.ticks = np.array([problem.ticks[int(s & -s).bit_length() - 1] for s in sets.tolist()], np.int64)
        self.earlier = np.zeros(len(sets), np.int64)
        for task in range(problem.size):
            self.earlier[sets >> task & 1 == 1] |= earlier[task]
        self.costs = np.empty((len(sets), cells), np.float32)
        stand_all(sets, lattice.hops, problem.robots, problem.limits[0], problem.paths,
                  np.empty(cells, np.int16), self.costs)  # fmt: skip


class HeldKarp:
    """States, (tasks done, ticks spent), with the least cost of having come to them, cell by cell.

    Costs of a state that has been followed are those after the way to the next point of deployment.
    """

    def __init__(self, problem: Problem, family: Family, steps: Steps, ticks: int, first: np.ndarray):
        """Begin with nothing done; ``first`` is the (cells,) cost of coming to the first point of deployment."""
        self.family, self.steps, self.limit, self.first = family, steps, ticks, first
        self.problem = problem
        cells = len(first)
        room = max(1, min(1 << problem.size, MOST_BYTES // (4 * cells)))
        self.done = np.zeros(room, np.int64)
        self.spent = np.zeros(room, np.int64)
        self.costs = np.empty((room, cells), np.float32)
        self._next_alike = np.full(room, -1, np.int32)  # another state with the same tasks done
        self._next_timely = np.full(room, -1, np.int32)  # another state with as many ticks spent
        self._alike = np.full(1 << problem.size, -1, np.int32)
        self._timely = np.full(ticks + 1, -1, np.int32)
        self._timely[0] = self._alike[0] = 0
        self.count = 1
        self._moved = np.empty(cells, np.float32)
        self._line = np.empty(steps.lattice.side, np.float32)

    def run(self, goal: float, ahead: "HeldKarp | None", clock: Clock) -> bool:
        """Find all states from which a schedule that costs less than ``goal`` may still come of.

        Args:
            goal: of a whole schedule.
            ahead: from the other end of the schedule, on cells that those here lie in; None if not known.
            clock: of the whole work.

        Returns:
            Whether there was room for all states.
        """
        lattice, family = self.steps.lattice, self.family
        other = ahead or self
        around = _inside(lattice.side, other.steps.lattice.side)
        pooled = np.empty(other.costs.shape[1], np.float32)
        for ticks in range(self.limit):
            state = int(self._timely[ticks])
            while state >= 0:
                state, self.count = follow(
                    state, self.steps.sets, self.steps.ticks, self.steps.earlier, self.steps.costs, self.first,
                    lattice.side, np.float32(lattice.step[0]), np.float32(lattice.step[1]), lattice.free,
                    self.limit, np.float32(goal), self.done, self.spent, self.costs, self._next_alike,
                    self._next_timely, self._alike, self._timely, self.count, ahead is not None, other.spent,
                    other.costs, other.steps.costs, other._alike, other._next_alike, around, pooled,
                    self.problem.ticks, *family.tables, self._moved, self._line,
                    max(1, MOST_WORK // max(1, len(self.steps.sets))),
                )  # fmt: skip
                clock.check()
                if self.count < 0:
                    return False
        return True

    @property
    def least(self) -> float:
        """Least cost of a whole schedule."""
        everything = (1 << self.problem.size) - 1
        state, least = int(self._alike[everything]), float(NEVER)
        while state >= 0:
            least = min(least, float(self.costs[state].min()))
            state = int(self._next_alike[state])
        return least

    def last(self, done: int, ticks: int, behind: np.ndarray, goal: float) -> np.ndarray:
        """Return (n,) for each set the least cost of a schedule that does ``done``, this set last, and goes on.

        Args:
            done: tasks, as bits.
            ticks: that they may take.
            behind: (cells,) cost of what follows, from the cell where the set is done.
            goal: costs at or above are given as NEVER.
        """
        found = np.full(len(self.steps.sets), np.float32(NEVER), np.float32)
        end_with(done, ticks, behind, np.float32(goal), self.steps.sets, self.steps.ticks, self.steps.earlier,
                 self.steps.costs, self.spent, self.costs, self._alike, self._next_alike, found)  # fmt: skip
        return found


@compiled
def stand_all(sets, hops, robots, limit, paths, sums, costs):
    """Fill ``costs`` (n, cells) with what the arms of each set cost from each cell."""
    for number in range(len(sets)):
        stand(sets[number], hops, spare_of(sets[number], robots, limit, paths), sums, costs[number])


def _inside(side: int, other: int) -> np.ndarray:
    """Return (side * side,) the number of the larger cell that each cell lies in."""
    line = np.arange(side) // (side // other)
    return (line[:, None] * other + line[None, :]).reshape(-1).astype(np.int32)


@compiled
def follow(
    state, sets, ticks, earlier, stands, first, side, step_x, step_y, free, limit, goal, done, spent, costs,
    next_alike, next_timely, alike, timely, count, informed, other_spent, other_costs, other_stands, other_alike,
    other_next, around, pooled, durations, starts, holding, fails, known, possible, moved, line, most,
):  # fmt: skip
    """Do every possible set after a state and the next ``most`` ones like it; return the next state and the count.

    The count is -1 if there is no room for another state.
    """
    everything = (np.int64(1) << len(durations)) - 1
    cells = len(first)
    while state >= 0 and most > 0:
        most -= 1
        if state == 0:
            for cell in range(cells):
                moved[cell] = first[cell]
        else:
            spread(costs[state], side, step_x, step_y, free, moved, line)
        for cell in range(len(pooled)):
            pooled[cell] = NEVER
        for cell in range(cells):
            costs[state, cell] = moved[cell]
            pooled[around[cell]] = min(pooled[around[cell]], moved[cell])
        for number in range(len(sets)):
            if sets[number] & done[state] or earlier[number] & ~done[state]:
                continue
            then = spent[state] + ticks[number]
            left = everything & ~(done[state] | sets[number])
            own = stands[number]
            hopeful = False
            if informed and left:
                other = other_alike[left]
                while other >= 0 and not hopeful:
                    if then + other_spent[other] <= limit:
                        hopeful = _meet(pooled, other_stands[number], other_costs[other]) < goal
                        if hopeful:
                            hopeful = _meet_inside(moved, own, other_costs[other], around) < goal
                    other = other_next[other]
            elif then <= limit:
                hopeful = can_cover(left, limit - then, durations, starts, holding, fails, known, possible)
                if hopeful:
                    least = NEVER
                    for cell in range(cells):
                        least = min(least, moved[cell] + own[cell])
                    hopeful = least < goal
            if not hopeful:
                continue
            whole = done[state] | sets[number]
            found = alike[whole]
            while found >= 0 and spent[found] != then:
                found = next_alike[found]
            if found < 0:
                if count == len(done):
                    return state, -1
                found, count = count, count + 1
                done[found], spent[found] = whole, then
                next_alike[found], alike[whole] = alike[whole], found
                next_timely[found], timely[then] = timely[then], found
                for cell in range(cells):
                    costs[found, cell] = NEVER
            target = costs[found]
            for cell in range(cells):
                target[cell] = min(target[cell], moved[cell] + own[cell])
        state = next_timely[state]
    return state, count


@compiled
def _meet(one, two, three):
    least = NEVER
    for cell in range(len(one)):
        least = min(least, one[cell] + two[cell] + three[cell])
    return least


@compiled
def _meet_inside(one, two, three, around):
    least = NEVER
    for cell in range(len(one)):
        least = min(least, one[cell] + two[cell] + three[around[cell]])
    return least


@compiled
def end_with(done, limit, behind, goal, sets, ticks, earlier, stands, spent, costs, alike, next_alike, found):
    """Fill ``found``; see ``HeldKarp.last``."""
    for number in range(len(sets)):
        if sets[number] & ~done or earlier[number] & ~(done & ~sets[number]):
            continue
        state = alike[done & ~sets[number]]
        while state >= 0:
            if spent[state] + ticks[number] <= limit:
                least = NEVER
                for cell in range(len(behind)):
                    least = min(least, costs[state, cell] + stands[number, cell] + behind[cell])
                if least < goal:
                    found[number] = min(found[number], least)
            state = next_alike[state]

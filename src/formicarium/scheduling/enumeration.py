"""All sets of tasks that a better schedule could use: those whose reduced cost is below the gap.

Coarse cells stand for deployment points. A set goes on growing while in some cell it fits, and could still gain
enough there, with the fewest relays that any point of the cell needs.
"""

import numpy as np

from formicarium.compiled import compiled
from formicarium.scheduling.covering import Set
from formicarium.scheduling.deployment import Places
from formicarium.scheduling.knapsack import move_multipliers
from formicarium.scheduling.problem import Problem
from formicarium.scheduling.reach import apart, distance, relays

CELLS = 24  # along each side
STEPS_A_SECOND = 400_000  # of growing sets, roughly: a hundred looks at cells each


def cell_demands(problem: Problem, cells: int) -> np.ndarray:
    """Return (cells^2, T): robots that each task takes of the swarm when the master is somewhere in the cell."""
    found = np.empty((cells * cells, problem.size), np.int64)
    arguments = (problem.robots, problem.paths, problem.reach, problem.region)
    _fill_cells(problem.places, *arguments, cells, found)
    return found


def sets_below(
    problem: Problem, places: Places, gains: np.ndarray, worth: float, least: int, allowed: np.ndarray, most: int,
    seconds: float,
) -> list[Set] | None:  # fmt: skip
    """Return the sets of allowed tasks that can be done at once and gain at least ``worth``.

    Without priorities a part of a set that is there need not be: the whole takes no longer and does more.

    Args:
        problem: that the tasks belong to.
        places: its slot oracle.
        gains: (T,) of the tasks.
        worth: least gain.
        least: ticks that at least one task of the set must last.
        allowed: (T,) bool.
        most: sets; None is returned if there are more.
        seconds: to spend on growing sets, roughly; None is returned if that is not enough.
    """
    tasks = np.flatnonzero(allowed)
    tasks = tasks[np.lexsort((-gains[tasks], -problem.ticks[tasks]))]
    first = int((problem.ticks[tasks] >= least).sum())
    count, rows = len(tasks), len(problem.limits)
    wanted = np.ascontiguousarray(cell_demands(problem, CELLS)[:, tasks])
    demands = np.ascontiguousarray(problem.demands[:, tasks]).astype(float)
    found = np.zeros((most, count), np.bool_)
    cells = len(wanted)
    bounds, multipliers = np.empty((cells, count + 1)), np.zeros((cells, rows))
    _bound_cells(gains[tasks], wanted, demands, problem.limits.astype(float), worth, bounds, multipliers,
                 np.empty((rows, count)), np.empty((2, rows)))  # fmt: skip
    number = grow(
        gains[tasks], wanted, demands, problem.limits.astype(float), first, worth, bounds, multipliers,
        np.empty((count + 1, cells)), np.empty((count + 1, rows)), np.empty(count + 1, np.bool_), found,
        seconds * STEPS_A_SECOND,
    )  # fmt: skip
    if number < 0:
        return None
    return _kept(found[:number], tasks, places, largest=not len(problem.before))


def _kept(found: np.ndarray, tasks: np.ndarray, places: Places, largest: bool) -> list[Set]:
    """Return those sets that have a point of deployment; if wanted only the ones that are no part of another.

    Args:
        found: (sets, T) bool, with every set that has enough gain also all larger ones that can be done.
        tasks: (T,) their numbers.
        places: slot oracle.
        largest: leave parts of others out.
    """
    masks = [int.from_bytes(row.tobytes(), "little") for row in np.packbits(found, axis=1, bitorder="little")]
    single = [1 << place for place in range(len(tasks))]
    possible: set[int] = set()
    kept: list[Set] = []
    for number in np.argsort(-found.sum(axis=1), kind="stable"):
        mask = masks[number]
        part = any(mask | bit in possible for bit in single if not mask & bit)
        if not part and places.deploy(np.sort(tasks[found[number]])) is None:
            continue
        possible.add(mask)
        if not (part and largest):
            kept.append(tuple(sorted(int(task) for task in tasks[found[number]])))
    return kept


@compiled
def _fill_cells(places, robots, paths, reach, region, cells, found):
    wide, high = (region[2] - region[0]) / cells, (region[3] - region[1]) / cells
    for column in range(cells):
        for line in range(cells):
            x0, y0 = region[0] + column * wide, region[1] + line * high
            for task in range(len(places)):
                dx, dy = apart(places[task, 0], x0, x0 + wide), apart(places[task, 1], y0, y0 + high)
                found[column * cells + line, task] = robots[task] + paths * relays(distance(dx, dy, reach))


@compiled
def _bound_cells(gains, wanted, demands, limits, worth, bounds, multipliers, weights, space):
    """For each cell find multipliers, and what the tasks from each place on can gain beyond their price at most."""
    count, rows = len(gains), len(limits)
    for cell in range(len(wanted)):
        for task in range(count):
            weights[0, task] = wanted[cell, task]
            for row in range(1, rows):
                weights[row, task] = demands[row, task]
        multipliers[cell, 0] = 1.0 / limits[0]
        move_multipliers(gains, weights, limits, count, worth, multipliers[cell], space[0], space[1])
        bounds[cell, count] = 0.0
        for task in range(count - 1, -1, -1):
            left = gains[task]
            for row in range(rows):
                left -= multipliers[cell, row] * weights[row, task]
            fits = wanted[cell, task] <= limits[0]
            bounds[cell, task] = bounds[cell, task + 1] + (max(0.0, left) if fits else 0.0)


@compiled
def grow(gains, wanted, demands, limits, first, worth, bounds, multipliers, used, taken, chosen, found, steps):
    """Write every set that may do into ``found`` and return how many there are, -1 if too many, or steps run out."""
    count, rows, cells = len(gains), len(limits), len(wanted)
    for cell in range(cells):
        used[0, cell] = 0.0
    for row in range(rows):
        taken[0, row] = 0.0
    number, place, gain, has_long = 0, 0, 0.0, 0
    forward = True
    while True:
        steps -= 1.0
        if steps < 0.0:
            return -1
        if forward:
            # can the set of this place still be worth it in some cell?
            alive = False
            if place < first or has_long > 0:
                for cell in range(cells):
                    if used[place, cell] <= limits[0]:
                        most = gain + bounds[cell, place] + multipliers[cell, 0] * (limits[0] - used[place, cell])
                        for row in range(1, rows):
                            most += multipliers[cell, row] * (limits[row] - taken[place, row])
                        if most >= worth - 1e-7:
                            alive = True
                            break
            if alive and place == count:
                if gain >= worth - 1e-7:
                    if number == len(found):
                        return -1
                    for task in range(count):
                        found[number, task] = chosen[task]
                    number += 1
                alive = False
            if not alive:
                forward = False
                continue
            fits = True
            for row in range(1, rows):
                taken[place + 1, row] = taken[place, row] + demands[row, place]
                if taken[place + 1, row] > limits[row]:
                    fits = False
            if fits:
                for cell in range(cells):
                    used[place + 1, cell] = used[place, cell] + wanted[cell, place]
                gain += gains[place]
                has_long += place < first
                chosen[place] = True
            else:
                leave(used, taken, place, cells, rows, chosen)
            place += 1
        else:
            place -= 1
            while place >= 0 and not chosen[place]:
                place -= 1
            if place < 0:
                return number
            gain -= gains[place]
            has_long -= place < first
            leave(used, taken, place, cells, rows, chosen)
            place += 1
            forward = True


@compiled
def leave(used, taken, place, cells, rows, chosen):
    """Go on without the task of this place."""
    for cell in range(cells):
        used[place + 1, cell] = used[place, cell]
    for row in range(rows):
        taken[place + 1, row] = taken[place, row]
    chosen[place] = False

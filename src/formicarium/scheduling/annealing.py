"""A good start for the least dislocation: tasks change slots, slots change places, judged on a coarse lattice."""

import numpy as np

from formicarium.compiled import compiled
from formicarium.scheduling.lattice import NEVER, Lattice, spread, stand
from formicarium.scheduling.problem import Problem
from formicarium.streams import derived, stream, uniform


def anneal(
    problem: Problem, lattice: Lattice, slots: list[tuple[int, ...]], ticks: int, tries: int, number: int
) -> list[tuple[int, ...]]:
    """Return slots of less dislocation within so many ticks, by estimate.

    Args:
        problem: of at most 62 tasks, without priorities.
        lattice: of the cells' centres.
        slots: to begin with.
        ticks: not to be exceeded.
        tries: changes that are looked at.
        number: of the try; another number takes other chances.
    """
    count, cells = len(slots), lattice.side**2
    masks = np.array([sum(1 << t for t in slot) for slot in slots], np.int64)
    best = masks.copy()
    work = np.empty((5, cells), np.float32)
    rows = [problem.demands, problem.limits]
    improve(
        masks, best, lattice.hops, lattice.first, lattice.side, *lattice.step, problem.paths, *rows,
        problem.ticks, ticks, tries, stream(number, "annealing"), np.empty((count, cells), np.float32), work,
        np.empty(cells, np.int16), np.empty(lattice.side, np.float32), np.empty(count, np.int64),
    )  # fmt: skip
    return [tuple(t for t in range(problem.size) if mask >> t & 1) for mask in best if mask]


@compiled
def improve(
    masks, best, hops, first, side, step_x, step_y, paths, demands, limits,
    durations, ticks, tries, random, grids, work, sums, line, old,
):  # fmt: skip
    """Anneal ``masks`` in place and leave the best ones in ``best``; return their cost."""
    slots, size = len(masks), len(durations)
    for slot in range(slots):
        cost_of(masks[slot], hops, paths, demands, limits, sums, grids[slot])
    now = tour_cost(masks, grids, first, side, step_x, step_y, work, line)
    least = now
    hot = 0.1 * min(now, 1e6) + 1.0
    for attempt in range(tries):
        cooled = hot * 10.0 ** (-4.0 * attempt / tries)
        draws = derived(random, attempt)
        kind = uniform(derived(draws, 0))
        one, two = int(uniform(derived(draws, 1)) * slots), int(uniform(derived(draws, 2)) * slots)
        if one == two:
            continue
        for slot in range(slots):
            old[slot] = masks[slot]
        if kind < 0.45:  # a task moves
            task = pick(masks[one], uniform(derived(draws, 3)), size)
            if task < 0:
                continue
            masks[one] ^= np.int64(1) << task
            masks[two] ^= np.int64(1) << task
        elif kind < 0.8:  # two tasks change slots
            task, other = (
                pick(masks[one], uniform(derived(draws, 3)), size),
                pick(masks[two], uniform(derived(draws, 4)), size),
            )
            if task < 0 or other < 0:
                continue
            both = (np.int64(1) << task) | (np.int64(1) << other)
            masks[one] ^= both
            masks[two] ^= both
        elif kind < 0.9:  # two slots change places
            masks[one], masks[two] = masks[two], masks[one]
        else:  # a stretch is turned round
            low, high = min(one, two), max(one, two)
            while low < high:
                masks[low], masks[high] = masks[high], masks[low]
                low, high = low + 1, high - 1
        total = 0
        for slot in range(slots):
            if masks[slot]:
                longest = 0
                for task in range(size):
                    if masks[slot] >> task & 1:
                        longest = max(longest, durations[task])
                total += longest
        fits = total <= ticks
        if fits:
            for slot in range(slots):
                if masks[slot] != old[slot]:
                    fits = cost_of(masks[slot], hops, paths, demands, limits, sums, grids[slot]) and fits
        cost = tour_cost(masks, grids, first, side, step_x, step_y, work, line) if fits else 1e30
        if cost < 1e29 and (cost <= now or uniform(derived(draws, 5)) < np.exp((now - cost) / cooled)):
            now = cost
            if cost < least:
                least = cost
                for slot in range(slots):
                    best[slot] = masks[slot]
        else:
            for slot in range(slots):
                if masks[slot] != old[slot]:
                    masks[slot] = old[slot]
                    cost_of(masks[slot], hops, paths, demands, limits, sums, grids[slot])
    return least


@compiled
def pick(mask, draw, size):
    """Return one of the tasks of a set, -1 if it is empty."""
    count = 0
    for task in range(size):
        count += mask >> task & 1
    place = int(draw * count)
    for task in range(size):
        if mask >> task & 1:
            if place == 0:
                return task
            place -= 1
    return -1


@compiled
def cost_of(mask, hops, paths, demands, limits, sums, out):
    """Fill in the cost of a slot's arms cell by cell and tell whether its robots are there at all."""
    fits = True
    spare = limits[0]
    for row in range(len(limits)):
        used = 0
        for task in range(demands.shape[1]):
            if mask >> task & 1:
                used += demands[row, task]
        if row == 0:
            spare = (limits[0] - used) // paths
        fits = fits and used <= limits[row]
    stand(mask, hops, spare, sums, out)
    return fits


@compiled
def tour_cost(masks, grids, first, side, step_x, step_y, work, line):
    """Return the cost of the best cells for slots in this order; empty slots are passed over."""
    here, moved = work[0], work[1]
    begun = False
    for cell in range(len(here)):
        here[cell] = first[cell]
    for slot in range(len(masks)):
        if masks[slot] == 0:
            continue
        if begun:
            spread(here, side, np.float32(step_x), np.float32(step_y), 0, moved, line)
        for cell in range(len(here)):
            here[cell] = (moved[cell] if begun else here[cell]) + grids[slot, cell]
        begun = True
    least = NEVER
    for cell in range(len(here)):
        least = min(least, here[cell])
    return float(least)

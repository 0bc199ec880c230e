"""The arena in cells: what arms cost from each cell, and what it costs to go from cell to cell.

For bounds both are optimistic: relays from the nearest point of a cell, ways from edge to edge. For estimates they
are those of the cells' centres.
"""

from typing import NamedTuple

import numpy as np

from formicarium.compiled import compiled
from formicarium.scheduling.problem import Problem
from formicarium.scheduling.reach import apart, distance, relays

NEVER = np.float32(1e30)  # cost of what cannot be


class Lattice(NamedTuple):
    """Cells of the arena; cell i, j has number i * side + j, i along x."""

    side: int
    hops: np.ndarray  # (T, cells) int16: relays on a path to each task
    step: tuple[float, float]  # cost of moving by one cell along x, along y
    first: np.ndarray  # (cells,) float32: cost of the way from the start
    free: int  # cells that a move may cross for nothing: 1 from edge to edge, 0 from centre to centre


def lattice_of(problem: Problem, side: int, charge_first: bool, optimistic: bool) -> Lattice:
    """Return the cells of an arena with ``side`` cells along each axis."""
    region = problem.region
    wide, high = (region[2] - region[0]) / side, (region[3] - region[1]) / side
    hops = np.empty((problem.size, side * side), np.int16)
    _fill(problem.places, problem.reach, region, side, optimistic, hops)
    first = np.zeros(side * side, np.float32)
    if charge_first:
        half = 0.5 if optimistic else 0.0
        away = []
        for axis, length in ((0, wide), (1, high)):
            middles = region[axis] + (np.arange(side) + 0.5) * length
            away.append(np.maximum(np.abs(middles - problem.start[axis]) - half * length, 0.0))
        first = (problem.swarm * (away[0][:, None] + away[1][None, :])).reshape(-1).astype(np.float32)
    steps = (problem.swarm * wide, problem.swarm * high)
    return Lattice(side, hops, steps, first, int(optimistic))


@compiled
def _fill(places, reach, region, side, optimistic, hops):
    wide, high = (region[2] - region[0]) / side, (region[3] - region[1]) / side
    for column in range(side):
        for line in range(side):
            x0, y0 = region[0] + column * wide, region[1] + line * high
            x1, y1 = x0 + wide, y0 + high
            if not optimistic:
                x0, y0 = 0.5 * (x0 + x1), 0.5 * (y0 + y1)
                x1, y1 = x0, y0
            for task in range(len(places)):
                dx, dy = apart(places[task, 0], x0, x1), apart(places[task, 1], y0, y1)
                hops[task, column * side + line] = relays(distance(dx, dy, reach))


@compiled
def spread(cost, side, step_x, step_y, free, out, line):
    """Fill ``out`` with the least cost of being in a cell after a move from any cell (one axis after the other).

    Args:
        cost: (cells,) of being in a cell before the move.
        side: cells along each axis.
        step_x: cost of moving by one cell along x.
        step_y: along y.
        free: cells that a move crosses for nothing.
        out: (cells,) result.
        line: (side,) memory to work in.
    """
    # along x, all columns of cells at once: line[j] is what it costs to come from one side
    for backwards in range(2):
        for j in range(side):
            line[j] = NEVER
        for k in range(side):
            i = side - 1 - k if backwards else k
            before = i + 1 if backwards else i - 1
            if free == 0 or k > 0:
                source = before if free else i
                for j in range(side):
                    line[j] = min(line[j] + step_x, cost[source * side + j])
            for j in range(side):
                here = out[i * side + j] if backwards else cost[i * side + j]
                out[i * side + j] = min(line[j], here)
    for i in range(side):
        for j in range(side):
            line[j] = out[i * side + j]
        ahead = NEVER
        for j in range(side):
            if free == 0:
                ahead = min(ahead + step_y, line[j])
            elif j > 0:
                ahead = min(ahead + step_y, line[j - 1])
            out[i * side + j] = min(out[i * side + j], ahead)
        ahead = NEVER
        for j in range(side - 1, -1, -1):
            if free == 0:
                ahead = min(ahead + step_y, line[j])
            elif j < side - 1:
                ahead = min(ahead + step_y, line[j + 1])
            out[i * side + j] = min(out[i * side + j], ahead)


@compiled
def pool(cost, side, share, out):
    """Fill ``out`` with the least cost in each square of ``share`` times ``share`` cells."""
    for cell in range(len(out)):
        out[cell] = NEVER
    few = side // share
    for i in range(side):
        for k in range(few):
            least = out[i // share * few + k]
            for j in range(k * share, (k + 1) * share):
                least = min(least, cost[i * side + j])
            out[i // share * few + k] = least


@compiled
def stand(mask, hops, spare, sums, out):
    """Fill ``out`` with the cost of the arms of a set in every cell; ``NEVER`` where it needs too many relays."""
    cells = hops.shape[1]
    for cell in range(cells):
        sums[cell] = 0
    task = 0
    while mask >> task:
        if mask >> task & 1:
            for cell in range(cells):
                sums[cell] += hops[task, cell]
        task += 1
    for cell in range(cells):
        out[cell] = np.float32(sums[cell]) if sums[cell] <= spare else NEVER

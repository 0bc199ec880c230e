"""A lower bound of the dislocation where the swarm hardly moves: boxes that hold all deployment points.

A tour whose points fill a box of width a and height b is at least a + b long, and no task is served with fewer
relays than from the nearest point of the box.
"""

import numpy as np

from formicarium.compiled import compiled
from formicarium.scheduling.problem import Problem
from formicarium.scheduling.reach import apart, distance, relays

MOST_BOXES = 400_000
PRECISE = 1e-5  # relative


def gathering_bound(problem: Problem, charge_first: bool, goal: float) -> float:
    """Return a lower bound of (14), in hops; ``goal`` and more is not looked for."""
    heap = np.empty((MOST_BOXES + 16, 9))
    start = problem.start if charge_first else np.array([np.nan, np.nan])
    arguments = (problem.places, problem.reach, problem.region, float(problem.swarm), start)
    return min(float(bound_boxes(*arguments, goal, heap, MOST_BOXES)), goal)


@compiled
def bound_boxes(places, reach, region, swarm, start, goal, heap, most):
    """Return the least cost over all boxes, by best-first search over ranges of their four sides.

    A node says: left side in [n0, n1], right side in [n2, n3], lower side in [n4, n5], upper side in [n6, n7].
    """
    for k in range(2):
        heap[0, 4 * k], heap[0, 4 * k + 1] = region[k], region[2 + k]
        heap[0, 4 * k + 2], heap[0, 4 * k + 3] = region[k], region[2 + k]
    heap[0, 8] = 0.0
    count = 1
    for _ in range(most):
        # take the least, mend the heap
        least = heap[0, 8]
        if least >= goal:
            return least
        wide, side = 0.0, 0
        for k in range(4):
            if heap[0, 2 * k + 1] - heap[0, 2 * k] > wide:
                wide, side = heap[0, 2 * k + 1] - heap[0, 2 * k], k
        if swarm * wide < PRECISE * max(least, 1e-6):
            return least
        low = heap[0, 2 * side]
        high = heap[0, 2 * side + 1]
        middle = 0.5 * (low + high)
        count += 1  # the second half goes to the end, the first one stays at the root
        for k in range(9):
            heap[count - 1, k] = heap[0, k]
        heap[0, 2 * side + 1] = middle
        heap[count - 1, 2 * side] = middle
        heap[0, 8] = max(least, cost_of_box(heap[0], places, reach, swarm, start))
        heap[count - 1, 8] = max(least, cost_of_box(heap[count - 1], places, reach, swarm, start))
        sink(heap, 0, count)
        rise(heap, count - 1)
    return heap[0, 8]


@compiled
def cost_of_box(node, places, reach, swarm, start):
    """Return what every tour of such a box costs at least; infinite where no box is."""
    if node[0] > node[3] or node[4] > node[7]:
        return 1e300
    cost = swarm * (max(node[2] - node[1], 0.0) + max(node[6] - node[5], 0.0))
    if start[0] == start[0]:
        cost += swarm * (apart(start[0], node[0], node[3]) + apart(start[1], node[4], node[7]))
    for task in range(len(places)):
        dx, dy = apart(places[task, 0], node[0], node[3]), apart(places[task, 1], node[4], node[7])
        cost += relays(distance(dx, dy, reach))
    return cost


@compiled
def rise(heap, place):
    """Bring a node up to where it belongs."""
    while place > 0:
        above = (place - 1) // 2
        if heap[above, 8] <= heap[place, 8]:
            return
        swap(heap, above, place)
        place = above


@compiled
def sink(heap, place, count):
    """Bring a node down to where it belongs."""
    while True:
        below = 2 * place + 1
        if below >= count:
            return
        if below + 1 < count and heap[below + 1, 8] < heap[below, 8]:
            below += 1
        if heap[place, 8] <= heap[below, 8]:
            return
        swap(heap, place, below)
        place = below


@compiled
def swap(heap, one, other):
    """Exchange two nodes."""
    for k in range(9):
        heap[one, k], heap[other, k] = heap[other, k], heap[one, k]

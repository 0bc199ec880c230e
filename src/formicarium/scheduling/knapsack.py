"""The most valuable set of tasks that fits into several limits at once: Lagrange multipliers, then depth first."""

from formicarium.compiled import compiled

STEPS = 12  # of the multipliers, each time they are moved
MOST_NODES = 300_000  # of the depth-first search; beyond, its bound is handed back instead of the optimum
EPSILON = 1e-9


@compiled
def move_multipliers(gains, weights, limits, count, goal, multipliers, slopes, best):
    """Move multipliers towards the least upper bound, until it is at most ``goal`` or the steps are done.

    The bound is u . limits + sum_t max(0, gain_t - u . weight_t), by Polyak's steps towards ``goal``.

    Args:
        gains: (T,) of the tasks; the first ``count`` count.
        weights: (R, T) what each task takes of each limit.
        limits: (R,) of the rows.
        count: tasks.
        goal: a bound that is low enough.
        multipliers: (R,) u, at least 0; moved in place to the best found.
        slopes: (R,) memory to work in.
        best: (R,) memory to work in.

    Returns:
        The least bound found.
    """
    rows = len(limits)
    least = 1e300
    for _ in range(STEPS):
        bound = 0.0
        for row in range(rows):
            bound += multipliers[row] * limits[row]
            slopes[row] = limits[row]
        for task in range(count):
            left = gains[task]
            for row in range(rows):
                left -= multipliers[row] * weights[row, task]
            if left > 0.0:
                bound += left
                for row in range(rows):
                    slopes[row] -= weights[row, task]
        if bound < least:
            least = bound
            for row in range(rows):
                best[row] = multipliers[row]
        steep = 0.0
        for row in range(rows):
            if multipliers[row] > 0.0 or slopes[row] < 0.0:
                steep += slopes[row] * slopes[row]
        if least <= goal or steep == 0.0:
            break
        step = (bound - goal) / steep
        for row in range(rows):
            multipliers[row] = max(0.0, multipliers[row] - step * slopes[row])
    for row in range(rows):
        multipliers[row] = best[row]
    return least


@compiled
def fill(gains, weights, limits, count, goal, multipliers, order, keys, above, left, taken, chosen):
    """Find the best set above ``goal``.

    Args:
        gains: as above, like ``weights``, ``limits``, ``count``, ``goal`` and ``multipliers``.
        order: (T,) memory to work in.
        keys: (T,) memory to work in.
        above: (T + 1,) memory to work in.
        left: (R,) memory to work in.
        taken: (T,) memory to work in.
        chosen: (T,) bool; set to the best set if one is above ``goal``.

    Returns:
        (value, bound, nodes): of the best set, ``goal`` if there is none above it; what no set exceeds; and the nodes
        that were looked at.
    """
    rows = len(limits)
    for task in range(count):
        key = gains[task]
        for row in range(rows):
            key -= multipliers[row] * weights[row, task]
        keys[task] = key
        order[task] = task
    _sort(order, keys, count)
    above[count] = 0.0
    for place in range(count - 1, -1, -1):
        above[place] = above[place + 1] + max(0.0, keys[order[place]])
    fixed = 0.0
    for row in range(rows):
        left[row] = limits[row]
        fixed += multipliers[row] * limits[row]
    best, value, place, nodes = goal, 0.0, 0, 0
    root = fixed + above[0]
    bound = root  # of what is open here: fixed is u . left, kept up to date
    while True:
        nodes += 1
        if nodes > MOST_NODES:
            return best, max(root, best), nodes
        bound = value + fixed + above[place]
        if bound > best + EPSILON and place < count:
            task = order[place]
            fits = True
            for row in range(rows):
                if weights[row, task] > left[row]:
                    fits = False
                    break
            taken[place] = fits
            if fits:
                value += gains[task]
                for row in range(rows):
                    left[row] -= weights[row, task]
                    fixed -= multipliers[row] * weights[row, task]
            place += 1
            continue
        if bound > best + EPSILON and value > best + EPSILON:
            best = value
            for task in range(count):
                chosen[task] = False
            for earlier in range(place):
                chosen[order[earlier]] = taken[earlier]
        # back to the last task that was taken, and leave it out
        place -= 1
        while place >= 0 and not taken[place]:
            place -= 1
        if place < 0:
            return best, best, nodes
        task = order[place]
        taken[place] = False
        value -= gains[task]
        for row in range(rows):
            left[row] += weights[row, task]
            fixed += multipliers[row] * weights[row, task]
        place += 1


@compiled
def _sort(order, keys, count):
    """Sort ``order`` by the size of the keys, largest first: the surest decisions first (Shell's sort)."""
    gap = count // 2
    while gap > 0:
        for place in range(gap, count):
            task = order[place]
            size = abs(keys[task])
            hole = place
            while hole >= gap and abs(keys[order[hole - gap]]) < size:
                order[hole] = order[hole - gap]
                hole -= gap
            order[hole] = task
        gap //= 2

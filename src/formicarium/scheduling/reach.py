"""How far an arm reaches: hops from the master to a task, by three readings of the paper's (7) to (9)."""

from enum import IntEnum
from math import ceil, sqrt

from formicarium.compiled import compiled

SQRT_HALF = sqrt(0.5)
INNER = sqrt((2.0 + sqrt(2.0)) / 4.0)  # cos(pi / 8): inradius over circumradius of a regular octagon
TOLERANCE = 1e-9  # of a hop: a task at exactly two hops needs one relay whatever the last digit says


class Reach(IntEnum):
    """Where an arm of r metres ends."""

    PRINTED = 0  # the octagon of (7) to (9), drawn around the circle: up to 1.082 r, beyond radio reach
    INSCRIBED = 1  # the octagon inside the circle: never beyond radio reach
    EUCLID = 2  # the circle itself


PRINTED, INSCRIBED, EUCLID = (int(reach) for reach in Reach)


@compiled
def distance(dx, dy, reach):
    """Return the length of the shortest arm that ends (dx, dy) from the master, in hops."""
    across, up = abs(dx), abs(dy)
    if reach == EUCLID:
        return sqrt(across * across + up * up)
    longest = max(across, up, (across + up) * SQRT_HALF)
    return longest / INNER if reach == INSCRIBED else longest


@compiled
def relays(length):
    """Return how many relays one path of that length, in hops, needs between the master and the task."""
    return max(0, int(ceil(length - TOLERANCE)) - 1)


@compiled
def apart(value, low, high):
    """Return how far a number lies outside of an interval."""
    return max(low - value, value - high, 0.0)

"""Directions that travel from robot to robot, none of which has a compass (ST-36)."""

import math

from formicarium.angles import wrapped
from formicarium.compiled import compiled


@compiled
def carried_over(direction, bearing_of_me, bearing):
    """Return in one's own frame a direction that a neighbour tells in its frame.

    T_i = wrap(T_j - M_ji + O_ij - pi): with M_ji, one's bearing as the neighbour sees it, and O_ij, the neighbour's as
    one sees it oneself, both ends of the line of sight, headings differ by h_i - h_j = M_ji - O_ij + pi. The rule
    printed in the paper, M_ji - O_ij + T_j, is wrong by 90 degrees on average.

    Args:
        direction: T_j, rad.
        bearing_of_me: M_ji, rad, of the same instant as T_j (ST-37).
        bearing: O_ij, rad.
    """
    return wrapped(direction - bearing_of_me + bearing - math.pi)


@compiled
def carried_over_printed(direction, bearing_of_me, bearing):
    """Return what the rule printed in the paper makes of it."""
    return wrapped(bearing_of_me - bearing + direction)

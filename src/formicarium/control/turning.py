"""From a wanted velocity to two wheels: the three states of the authors' files (ST-24)."""

import math
from enum import IntEnum

from formicarium.compiled import compiled

QUARTER = 0.5 * math.pi
TO_HARD = math.radians(90.0)  # above this error a robot pivots,
TO_SOFT = math.radians(70.0)  # until it is down to this,
TO_STRAIGHT = math.radians(10.0)  # and below this it drives straight on


class Turning(IntEnum):
    """How sharply a robot turns."""

    STRAIGHT = 0
    SOFT = 1
    HARD = 2


@compiled
def turn_state(state, error):
    """Return the next Turning for a heading error (rad, not negative)."""
    if error > TO_HARD:
        return Turning.HARD
    if state == Turning.HARD:
        return Turning.SOFT if error <= TO_SOFT else Turning.HARD
    if error > TO_STRAIGHT:
        return Turning.SOFT
    return Turning.STRAIGHT


@compiled
def drive_towards(command, state, limit):
    """Write the wheel speeds for the velocity in a command; return the new Turning.

    HARD: wheels -limit and +limit; SOFT: base (1 -+ error / 90 deg); STRAIGHT: both base, where base is the length of
    the wanted velocity, cut to ``limit`` (m/s). Without a wanted velocity the robot stands.
    """
    base = math.sqrt(command.ahead * command.ahead + command.aside * command.aside)
    if base == 0.0:
        command.left = 0.0
        command.right = 0.0
        return state
    angle = math.atan2(command.aside, command.ahead)
    state = turn_state(state, math.fabs(angle))
    base = min(base, limit)
    if state == Turning.HARD:
        inner, outer = -limit, limit
    elif state == Turning.SOFT:
        share = min(1.0, math.fabs(angle) / QUARTER)
        inner, outer = base * (1.0 - share), base * (1.0 + share)
    else:
        inner, outer = base, base
    if angle >= 0.0:
        command.left = inner
        command.right = outer
    else:
        command.left = outer
        command.right = inner
    return state

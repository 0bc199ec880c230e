"""Angles: radians, counter-clockwise."""

import math

from formicarium.compiled import compiled

TURN = 2.0 * math.pi
MANY = 64.0  # rad, ten turns


@compiled
def wrapped(angle):
    """Return the same angle in (-pi, pi], by taking off one turn after the other."""
    while angle > math.pi:
        angle -= TURN
        angle -= turns_alike(angle)
    while angle <= -math.pi:
        angle += TURN
        angle += turns_alike(-angle)
    return angle


@compiled
def turns_alike(angle):
    """Return how much (rad) of a large angle can be taken off in one go, to the same last bit as turn by turn.

    Headings count whole turns, and a robot in a crowd that turns on the spot for a day has made thousands. Between
    one power of two and the next, floating-point numbers are evenly spaced: there every turn takes off the same, so
    that the sum of them is exact. Small angles, and the last turns above the power, are left to be taken one by one.
    """
    if angle < MANY:
        return 0.0
    power = math.ldexp(0.5, math.frexp(angle)[1])
    turn = angle - (angle - TURN)
    return turn * max(0.0, math.floor((angle - power) / turn) - 1.0)

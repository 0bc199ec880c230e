"""Angles: radians, counter-clockwise."""

import math

from formicarium.compiled import compiled

TURN = 2.0 * math.pi
MANY = 64.0  # rad: up to ten turns are taken off one by one; a power of two


@compiled
def wrapped(angle):
    """Return the same angle in (-pi, pi], by taking off one turn after the other."""
    if angle >= MANY:
        angle = unwound(angle)
    elif angle <= -MANY:
        angle = -unwound(-angle)
    while angle > math.pi:
        angle -= TURN
    while angle <= -math.pi:
        angle += TURN
    return angle


@compiled
def unwound(angle):
    """Take turns off an angle of ``MANY`` or more until it is less, many in one go, to the same bit as one by one.

    Headings count whole turns, and a robot in a crowd that turns on the spot for a day has made thousands. Between
    a power of two and the next, floating-point numbers are evenly spaced: there, after the first, every turn takes
    off the same, and the sum of many of them is exact.
    """
    power = MANY
    while 2.0 * power <= angle:
        power *= 2.0
    while power >= MANY:
        angle -= TURN
        turn = angle - (angle - TURN)
        many = math.floor((angle - power) / TURN) - 1.0
        if many > 0.0:
            angle -= many * turn
        while angle >= power:
            angle -= TURN
        power *= 0.5
    return angle

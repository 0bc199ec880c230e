"""Angles: radians, counter-clockwise."""

import math

from formicarium.compiled import compiled


@compiled
def wrapped(angle):
    """Return the same angle in (-pi, pi]."""
    while angle > math.pi:
        angle -= 2.0 * math.pi
    while angle <= -math.pi:
        angle += 2.0 * math.pi
    return angle

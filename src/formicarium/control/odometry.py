"""Where a robot has got to since the last cycle, from its wheel steps alone."""

import math

import numpy as np

from formicarium.compiled import compiled

# A point that the robot keeps in mind, carried along in its own frame while it moves.
TRACK = np.dtype(
    [
        ("known", "i8"),  # 1 if it holds a point
        ("x", "f8"),  # m, forward
        ("y", "f8"),  # m, left
        ("seen", "i8"),  # cycle of the last sighting
    ],
    align=True,
)

ODOMETER = np.dtype(
    [
        ("left_steps", "i8"),  # counts at the last cycle
        ("right_steps", "i8"),
        ("forward", "f8"),  # m, path of the last cycle
        ("turn", "f8"),  # rad, change of heading in the last cycle
        ("cosine", "f8"),  # of that turn
        ("sine", "f8"),
    ],
    align=True,
)


@compiled
def measure(odometer, reading, epuck):
    """Work out forward path (l + r) / 2 and turn (r - l) / wheel distance of the last cycle."""
    metres = 2.0 * math.pi * epuck.wheel_radius / epuck.steps_per_turn
    left = (reading.left_steps - odometer.left_steps) * metres
    right = (reading.right_steps - odometer.right_steps) * metres
    odometer.left_steps = reading.left_steps
    odometer.right_steps = reading.right_steps
    odometer.forward = 0.5 * (left + right)
    odometer.turn = (right - left) / epuck.wheel_distance
    odometer.cosine = math.cos(odometer.turn)
    odometer.sine = math.sin(odometer.turn)


@compiled
def carry(track, odometer):
    """Move a point of the robot's frame against the robot's own motion."""
    x = track.x - odometer.forward
    y = track.y
    track.x = odometer.cosine * x + odometer.sine * y
    track.y = odometer.cosine * y - odometer.sine * x


@compiled
def place(track, distance, bearing, cycle):
    """Set a point from distance and bearing."""
    track.known = 1
    track.x = distance * math.cos(bearing)
    track.y = distance * math.sin(bearing)
    track.seen = cycle


@compiled
def distance_to(track):
    """Return the distance to a point, m."""
    return math.sqrt(track.x * track.x + track.y * track.y)


@compiled
def bearing_to(track):
    """Return the bearing of a point, rad."""
    return math.atan2(track.y, track.x)

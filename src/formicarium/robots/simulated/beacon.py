"""The sensor of task beacons."""

import math

from formicarium.angles import wrapped
from formicarium.compiled import compiled


@compiled
def sense_beacon(body, beacons, reach, reading):
    """Notice the nearest beacon within ``reach`` (m) of the robot's middle."""
    reading.beacon = 0
    reading.beacon_range = 0.0
    reading.beacon_bearing = 0.0
    nearest = reach * reach
    for k in range(len(beacons)):
        dx = beacons[k].x - body.x
        dy = beacons[k].y - body.y
        square = dx * dx + dy * dy
        if square <= nearest:
            nearest = square
            reading.beacon = beacons[k].task
            reading.beacon_range = math.sqrt(square)
            reading.beacon_bearing = wrapped(math.atan2(dy, dx) - body.heading)

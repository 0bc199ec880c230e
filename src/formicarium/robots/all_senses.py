"""What crosses the boundary of a controller that has every sensor of the e-puck at once: Reading in, Command out.

Robot frame: x forward, y left, bearings counter-clockwise from the heading, in (-pi, pi]. SI units. The Command is
that of ``robots.records``: wheels, lights, radio, infrared.
"""

import numpy as np

from formicarium.robots.forager import GROUND_SENSORS
from formicarium.robots.records import BLOB, BLOBS, PACKET, PACKETS, PROXIMITY_SENSORS

READING = np.dtype(
    [
        ("identity", "i8"),  # the robot's own number, 1..255
        ("cycle", "i8"),  # the robot's own clock, control cycles since it was switched on
        ("proximity", "f8", PROXIMITY_SENSORS),  # 0 nothing .. 1 touching, at PROXIMITY_ANGLES
        ("light", "f8", PROXIMITY_SENSORS),  # 0 dark .. 1, the same sensors
        ("ground", "f8", GROUND_SENSORS),  # 0 black .. 1 white; left, middle, right
        ("blob_count", "i8"),
        ("blobs", BLOB, BLOBS),  # lights seen all round, nearest first
        ("packet_count", "i8"),
        ("packets", PACKET, PACKETS),  # heard by radio, in the order of arrival
        ("infrared", "i8"),  # byte heard at short range, SILENCE if none
        ("left_steps", "i8"),  # wheel steps since the start, signed
        ("right_steps", "i8"),
    ],
    align=True,
)

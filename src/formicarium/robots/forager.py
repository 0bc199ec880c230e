"""What crosses the boundary of a foraging e-puck's controller: Reading in, Command out (Pini et al. 2011, TP-63).

Wheels, eight infrared sensors for proximity and light, the forward camera, three ground sensors; no radio. Robot
frame: x forward, y left, bearings counter-clockwise from the heading, in (-pi, pi]. SI units.
"""

import numpy as np

from formicarium.robots.records import BLOB, PROXIMITY_SENSORS

GROUND_SENSORS = 3
SIGHTS = 16  # blobs a picture can hold: there are 14 booths

READING = np.dtype(
    [
        ("identity", "i8"),  # the robot's own number, 1..255
        ("cycle", "i8"),  # the robot's own clock, control cycles since it was switched on
        ("proximity", "f8", PROXIMITY_SENSORS),  # 0 nothing .. 1 touching, at PROXIMITY_ANGLES
        ("light", "f8", PROXIMITY_SENSORS),  # 0 dark .. 1, the same sensors
        ("ground", "f8", GROUND_SENSORS),  # 0 black .. 1 white; left, middle, right
        ("blob_count", "i8"),
        ("blobs", BLOB, SIGHTS),  # in the order of the booths' keys
        ("busy", "i8"),  # 1 while the (virtual) gripper hands over or takes an object
        ("left_steps", "i8"),  # wheel steps since the start, signed
        ("right_steps", "i8"),
    ],
    align=True,
)

COMMAND = np.dtype(
    [
        ("left", "f8"),  # wheel speed at the rim, m/s
        ("right", "f8"),
    ],
    align=True,
)

# What the simulator keeps of a forager beside ROBOT. A controller never sees this record.
GRIP = np.dtype([("busy_until", "i8")], align=True)  # cycle at which the interfacing time of its visit is over

# A light at the bottom of a niche: seen from inside and through the opening.
NICHE_LIGHT = np.dtype(
    [
        ("x", "f8"),  # m
        ("y", "f8"),
        ("cosine", "f8"),  # of the direction into the niche
        ("sine", "f8"),
        ("depth", "f8"),  # m, of the light behind the opening
        ("half_width", "f8"),  # m, of the opening
        ("colour", "i8"),  # Colour
        ("key", "i8"),
    ],
    align=True,
)

# A lamp above everything.
LAMP = np.dtype([("x", "f8"), ("y", "f8"), ("intensity", "f8")], align=True)

HEARD = 8  # utterances that a robot can take in in one cycle; those of more are lost

# What a robot that talks says of its three times (an option: the paper's robots do not talk).
WORDS = np.dtype(
    [
        ("identity", "i8"),  # of who says it
        ("times", "f8", 4),  # s, numbered as a system numbers its estimates
        ("ages", "f8", 4),  # s since each was last measured, negative for never
    ],
    align=True,
)

# Said now, and heard in this cycle. Beside the Reading, which is that of the paper's robots.
VOICE = np.dtype([("speaking", "i8"), ("said", WORDS), ("heard_count", "i8"), ("heard", WORDS, HEARD)], align=True)

"""What crosses the boundary of a controller: Reading in, Command out (TS-18). Nothing else does.

Robot frame: x forward, y left, bearings counter-clockwise from the heading, in (-pi, pi]. SI units.
"""

from enum import IntEnum

import numpy as np

PROXIMITY_SENSORS = 8
BLOBS = 32  # blobs a camera frame can hold; more are counted, the farthest are dropped
PACKETS = 10  # packets a radio can hand over in one cycle
EMITTERS = 12
PAYLOAD = 4  # bytes in a packet
SILENCE = -1  # no infrared byte


class Colour(IntEnum):
    """Colours that lights show and cameras tell apart. The first four mark tasks, the last three roles."""

    OFF = 0
    RED = 1
    GREEN = 2
    BLUE = 3
    ORANGE = 4
    CYAN = 5
    YELLOW = 6
    MAGENTA = 7


BLOB = np.dtype(
    [
        ("colour", "i8"),  # Colour
        ("distance", "f8"),  # m, centre of the seeing robot to the light
        ("bearing", "f8"),  # rad
    ],
    align=True,
)

PACKET = np.dtype(
    [
        ("payload", "u1", PAYLOAD),  # bytes as sent
        ("distance", "f8"),  # m, centre to centre, as the board estimates it
        ("bearing", "f8"),  # rad, direction of the sender
    ],
    align=True,
)

READING = np.dtype(
    [
        ("identity", "i8"),  # the robot's own number, 1..255
        ("cycle", "i8"),  # the robot's own clock, control cycles since it was switched on
        ("proximity", "f8", PROXIMITY_SENSORS),  # 0 nothing .. 1 touching, at PROXIMITY_ANGLES
        ("blob_count", "i8"),
        ("blobs", BLOB, BLOBS),  # nearest first
        ("packet_count", "i8"),
        ("packets", PACKET, PACKETS),  # in the order of arrival
        ("infrared", "i8"),  # byte heard at short range, SILENCE if none
        ("left_steps", "i8"),  # wheel steps since the start, signed
        ("right_steps", "i8"),
    ],
    align=True,
)

COMMAND = np.dtype(
    [
        ("left", "f8"),  # wheel speed at the rim, m/s
        ("right", "f8"),
        ("colour", "i8"),  # Colour of the body's lights
        ("enabled", "i8", EMITTERS),  # 1 if the emitter sends
        ("payload", "u1", (EMITTERS, PAYLOAD)),  # bytes of each emitter; emitter k points to k * 30 degrees
        ("infrared", "i8"),  # byte to send at short range, SILENCE for none
    ],
    align=True,
)

# A robot as the simulator keeps it, beside its body. A controller never sees this record.
ROBOT = np.dtype(
    [
        ("identity", "i8"),
        ("key", "i8"),  # orders robots independently of where they are stored
        ("alive", "i8"),
        ("dies_at", "i8"),  # cycle, -1 for never
        ("noise", "u8"),  # start of the robot's own noise stream
        ("speaking", "i8"),  # whether any emitter is enabled
        ("infrared_heard", "i8"),
        ("left_path", "f8"),  # distance the wheel rims have run, m
        ("right_path", "f8"),
        ("packets_heard", "i8"),  # totals over the trial, for checks and reports
        ("blobs_dropped", "i8"),
    ],
    align=True,
)

# A coloured light that belongs to a device.
LIGHT = np.dtype([("x", "f8"), ("y", "f8"), ("colour", "i8"), ("key", "i8")], align=True)

# A place in the queue of a radio: scratch of the simulator.
QUEUE = np.dtype([("draw", "u8"), ("neighbour", "i8")], align=True)

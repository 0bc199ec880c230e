"""The packets of an e-puck2, as its published firmware and libraries have them; little-endian, nothing padded.

Sources, for Bluetooth and USB: the firmware (GitHub, e-puck2/e-puck2_main-processor, src/epuck1x/Asercom2.c, requests
0x08 and 0x09) and the maker's library (e-puck2/e-puck2_cpp_remote_library, epuck2.h and epuck2.cpp). For WiFi: public
drivers that agree on 21 bytes to port 1000 and on the kinds of packets that come back; the sensors are the same.
"""

from typing import NamedTuple

import numpy as np

PROXIMITY_FULL = 4095  # raw value of something that touches, after calibration
DARK = 4095  # raw value of ambient light in the dark; 0 is strong light
WHITE = 1023  # raw value of a white floor
MOST_STEPS = 1000  # 1/s, of a wheel
BRIGHTEST = 100  # of a colour's part
TCP_PORT = 1000

SENSORS = np.dtype(
    [
        ("acceleration", "<i2", 3),
        ("acceleration_length", "<f4"),
        ("orientation", "<f4"),
        ("inclination", "<f4"),
        ("rotation", "<i2", 3),
        ("magnetic_field", "<f4", 3),
        ("temperature", "i1"),
        ("proximity", "<u2", 8),  # 0 nothing .. PROXIMITY_FULL; clockwise from the front right
        ("ambient", "<u2", 8),  # 0 strong light .. DARK
        ("distance", "<u2"),  # mm, time of flight, to the front
        ("volume", "<u2", 4),
        ("steps", "<i2", 2),  # of the left and the right wheel, modulo 2**16
        ("battery", "<u2"),
        ("card", "u1"),
        ("remote", "u1", 3),
        ("selector", "u1"),
        ("ground", "<u2", 3),  # 0 black .. WHITE; left, middle, right
        ("ground_ambient", "<u2", 3),
    ]
)

ACTUATORS = np.dtype(
    [
        ("settings", "u1"),  # bit 0: calibrate the proximity sensors; bit 2: speeds are step counts to set
        ("speeds", "<i2", 2),  # steps/s of the left and the right wheel
        ("lamps", "u1"),  # bits: four red lights, body, front
        ("colours", "u1", (4, 3)),  # red, green, blue of four lights, 0 .. BRIGHTEST
        ("sound", "u1"),
    ]
)


class Framing(NamedTuple):
    """What stands around the actuators in a request, and around the sensors in its answer."""

    before: bytes
    after: bytes
    header: bytes  # with which an answer begins
    rest: int  # bytes behind the sensors


# Binary requests are negated numbers: -9 sets the actuators, -8 asks for the sensors, 0 ends the list.
SERIAL = Framing(before=b"\xf7", after=b"\xf8\x00", header=b"", rest=1)
# 0x80 is a command that asks for the sensors (bit 1) and no picture (bit 0); its answer is packet 2, with the button.
WIFI = Framing(before=b"\x80\x02", after=b"", header=b"\x02", rest=2)


def request(framing: Framing, actuators: np.ndarray) -> bytes:
    """Return the request that sets ACTUATORS (1,) and asks for the sensors."""
    return framing.before + actuators.tobytes() + framing.after

"""Frames as few bytes: places to a tenth of a millimetre, differences in time, then zlib.

Twenty robots at two frames a second take less than 1 MB an hour.
"""

import struct
import zlib

import numpy as np

from formicarium.trial.record import Frames

PLACE = 1e-4  # m
HEADING = 2.0 * np.pi / 65536  # rad
LEVEL = 1  # of zlib: higher ones cost five times the time for a tenth of the bytes
SHAPE = struct.Struct("<qIHHH")  # first cycle, cycles between frames, frames, robots, devices
COLUMNS = ("x", "y", "heading", "role", "carried", "colour", "joined", "lit")


def packed(frames: Frames, every: int) -> bytes:
    """Write frames that are ``every`` cycles apart."""
    count, robots = frames.x.shape
    missing = np.zeros((count, robots))
    columns = [
        np.rint(frames.x / PLACE).astype("<i4"),
        np.rint(frames.y / PLACE).astype("<i4"),
        np.rint(frames.heading / HEADING).astype("<i8").astype("<i4"),
        frames.role,
        frames.carried,
        missing.astype("i1") if frames.colour is None else frames.colour,
        missing.astype("<i2") - 1 if frames.joined is None else frames.joined,
        frames.lit,
    ]
    parts = []
    for column in columns:
        steps = np.diff(column, axis=0, prepend=np.zeros((1, column.shape[1]), column.dtype))
        if column.itemsize == 4:
            parts += [column[:1].tobytes(), _narrow(steps[1:])]
        else:
            parts.append(steps.tobytes())
    shape = SHAPE.pack(int(frames.cycle[0]), every, count, robots, frames.lit.shape[1])
    return shape + zlib.compress(b"".join(parts), LEVEL)


def _narrow(steps: np.ndarray) -> bytes:
    """Write steps as 16 bits, or as 32 if one is larger (a robot that was moved by hand)."""
    wide = bool(len(steps)) and int(np.abs(steps).max()) > 32767
    return bytes([wide]) + steps.astype("<i4" if wide else "<i2").tobytes()


def unpacked(content: bytes, identity: np.ndarray) -> Frames:
    """Read what ``packed`` wrote; ``identity`` are the robots of the columns."""
    first, every, count, robots, devices = SHAPE.unpack_from(content)
    data, at = zlib.decompress(content[SHAPE.size :]), 0

    def take(kind: str, rows: int, width: int) -> np.ndarray:
        nonlocal at
        found = np.frombuffer(data, kind, rows * width, at).reshape(rows, width)
        at += found.nbytes
        return found

    def wide() -> np.ndarray:
        nonlocal at
        start = take("<i4", 1, robots)
        at += 1
        steps = take("<i4" if data[at - 1] else "<i2", count - 1, robots)
        return np.concatenate([start, steps]).cumsum(axis=0, dtype="i8")

    def narrow(kind: str, width: int) -> np.ndarray:
        return take(kind, count, width).cumsum(axis=0, dtype=kind)

    x, y, heading = wide() * PLACE, wide() * PLACE, wide() * HEADING
    role, carried, colour = (narrow("i1", robots) for _ in range(3))
    joined, lit = narrow("<i2", robots), narrow("i1", devices)
    cycle = first + every * np.arange(count, dtype="i8")
    x, y, heading = (column.astype("f4") for column in (x, y, heading))
    return Frames(cycle, x, y, heading, role, carried, lit, identity, colour, joined)

"""The digest of a state: what two simulations of the same trial must agree on."""

import hashlib
from collections.abc import Iterator
from typing import Any

import numpy as np

# Not part of a digest: the clock counts events since the last look, the others hold nothing between cycles.
LEFT_OUT = ("clock", "events", "queue")
SIZE = 8  # bytes


def digest(state: Any) -> bytes:
    """Return a hash of everything that decides how a trial goes on."""
    found = hashlib.blake2b(digest_size=SIZE)
    for _, part in deciding(state):
        found.update(bytes_of(part))
    return found.digest()


def deciding(state: Any) -> Iterator[tuple[str, np.ndarray]]:
    """Yield what decides how a trial goes on: the bodies of its world, if it has one, and all records beside it."""
    if hasattr(state, "world"):
        yield "bodies", np.asarray(state.world.bodies)
    for name, part in state._asdict().items():
        if name not in LEFT_OUT and not isinstance(part, tuple):
            yield name, np.asarray(part)


def bytes_of(array: np.ndarray) -> memoryview:
    """Return the bytes of an array; they are not copied unless it has gaps."""
    return np.ascontiguousarray(array).view("u1").data

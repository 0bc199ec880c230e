"""Copies of a state from which the trial can go on: a bounded number, evenly spread over what has passed."""

from bisect import bisect_right
from typing import Any, NamedTuple

import numpy as np

SCRATCH = ("events",)  # parts of a state that hold nothing between two looks
FIRST_SPACING = 200  # cycles between two snapshots at the beginning
MOST = 64
MOST_BYTES = 64_000_000  # of all snapshots together


class Snapshot(NamedTuple):
    """A state at a cycle, before the interventions of that cycle."""

    cycle: int
    done: int  # how many interventions had been made
    arrays: list[np.ndarray]


def arrays_of(state: Any) -> list[np.ndarray]:
    """Return every array of a state that a snapshot keeps."""
    found: list[np.ndarray] = []
    for name, part in state._asdict().items():
        if name not in SCRATCH:
            found += arrays_of(part) if isinstance(part, tuple) else [part]
    return found


class Snapshots:
    """Snapshots of one trial; when there are too many, every second one is let go."""

    def __init__(self, state: Any):
        """Begin with the state as it is now."""
        self._live = arrays_of(state)
        size = sum(array.nbytes for array in self._live)
        self._most = int(np.clip(MOST_BYTES // size, 4, MOST))
        self.spacing = FIRST_SPACING
        self._kept: list[Snapshot] = []

    def due(self, cycle: int) -> bool:
        """Tell whether a snapshot should be taken at this cycle."""
        return cycle % self.spacing == 0 and (not self._kept or cycle > self._kept[-1].cycle)

    def take(self, cycle: int, done: int) -> None:
        """Keep the state as it is now."""
        self._kept.append(Snapshot(cycle, done, [array.copy() for array in self._live]))
        if len(self._kept) > self._most:
            self.spacing *= 2
            self._kept = [kept for kept in self._kept if kept.cycle % self.spacing == 0]

    def restore(self, cycle: int) -> Snapshot:
        """Put the state back to the last snapshot at or before ``cycle``; the arrays stay where they are."""
        kept = self._kept[max(bisect_right([k.cycle for k in self._kept], cycle) - 1, 0)]
        for array, copy in zip(self._live, kept.arrays, strict=True):
            array[...] = copy
        return kept

    def nearest(self, cycle: int) -> int:
        """Return the cycle of the snapshot that ``restore`` would choose."""
        return self._kept[max(bisect_right([k.cycle for k in self._kept], cycle) - 1, 0)].cycle

    def forget_after(self, cycle: int) -> None:
        """Let go of all snapshots later than ``cycle``."""
        self._kept = [kept for kept in self._kept if kept.cycle <= cycle]

"""Holding a trial that is simulated again against the digests in its recording."""

from bisect import bisect_right
from collections.abc import Mapping
from typing import Any

from formicarium.views.recording.digest import digest


class Checks:
    """What a recording says the trial must be, and how far that has been found true."""

    def __init__(self, wanted: Mapping[int, bytes]):
        """Begin with the digests by cycle."""
        self._wanted = dict(wanted)
        self._cycles = sorted(wanted)
        self.agreed = 0  # cycle up to which all digests agree
        self.counted = 0  # digests that agreed
        self.differs: int | None = None  # cycle of the first digest that does not
        self.left: int | None = None  # cycle at which somebody intervened: from here on nothing can agree

    def compare(self, cycle: int, state: Any, new: bool) -> None:
        """Compare the state at a cycle that has been reached for the first time."""
        if not new or self.left is not None or self.differs is not None or cycle not in self._wanted:
            return
        if digest(state) == self._wanted[cycle]:
            self.agreed, self.counted = cycle, self.counted + 1
        else:
            self.differs = cycle

    def next(self, cycle: int) -> int | None:
        """Return the first cycle after ``cycle`` that has a digest."""
        place = bisect_right(self._cycles, cycle)
        return self._cycles[place] if place < len(self._cycles) else None

    def leave(self, cycle: int) -> None:
        """Note that the trial takes another course from this cycle on."""
        self.left = cycle if self.left is None else min(self.left, cycle)

    @property
    def last(self) -> int:
        """Cycle of the last digest."""
        return max(self._wanted, default=0)

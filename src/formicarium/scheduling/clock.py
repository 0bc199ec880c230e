"""How much time is left, and whom to tell how far the work is."""

import time
from collections.abc import Callable
from typing import NamedTuple


class News(NamedTuple):
    """How far a solver is."""

    part: str  # of the solver that is at work
    bound: float  # no schedule is better
    value: float  # best schedule so far


Told = Callable[[News], None]


class OutOfTime(Exception):
    """The time limit has come."""


class Clock:
    """Time since the work began: of the clock on the wall, or of the processor where many share one."""

    def __init__(self, limit: float | None = None, told: Told | None = None, processor: bool = False):
        """Start; ``limit`` in seconds, None for no limit."""
        self._now = time.process_time if processor else time.monotonic
        self.on_the_wall = not processor
        self._began = self._now()
        self._limit = limit
        self._told = told
        self.unit = 1.0  # of bounds and values that are told

    @property
    def seconds(self) -> float:
        """Since the start."""
        return self._now() - self._began

    @property
    def left(self) -> float:
        """Seconds until the limit; infinite without one."""
        return float("inf") if self._limit is None else max(0.0, self._limit - self.seconds)

    def check(self) -> None:
        """Raise OutOfTime if the limit has come."""
        if self.left <= 0.0:
            raise OutOfTime

    def tell(self, part: str, bound: float, value: float) -> None:
        """Pass on how far the work is."""
        if self._told:
            self._told(News(part, bound * self.unit, value * self.unit))

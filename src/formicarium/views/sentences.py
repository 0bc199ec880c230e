"""Events in words, as pages and tables list them."""

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from formicarium.systems.registry import System

Line = tuple[int, str, int, str]  # cycle, kind, robot, sentence


def teller(system: System | None, kinds: Sequence[str]) -> Callable[[Any], str]:
    """Return what says an event in a sentence: the system, if it can and knows these kinds, else the kind's name."""
    if system is not None and system.watching is not None and tuple(kinds) == system.kinds:
        return system.watching.tell
    return lambda event: f"{kinds[int(event['kind'])].replace('_', ' ')}, robot {int(event['robot'])}"


def lines(events: np.ndarray, kinds: Sequence[str], tell: Callable[[Any], str]) -> list[Line]:
    """Return the events (EVENT) as a page lists them."""
    return [(int(e["cycle"]), kinds[int(e["kind"])], int(e["robot"]), tell(e)) for e in events]

"""There is no compass in a robot: in a turned and shifted world it reads and commands the same."""

import itertools
import math
from typing import Any

import numpy as np

from formicarium.contracts.broken import require
from formicarium.contracts.states import advanced, copy_of, distances, recorded, turned
from formicarium.systems.registry import System, resolve

EXACT = 1e-9


def worst(system: System, state: Any, turn: float, shift: tuple[float, float]) -> dict[str, float]:
    """Let one cycle pass here and in the turned world; return the greatest difference in each field."""
    here, there = copy_of(state), turned(state, turn, shift)
    for world in (here, there):
        advanced(system, world, 1)
    return distances(here.readings, there.readings) | {
        f"command{path}": gap for path, gap in distances(here.commands, there.commands).items()
    }


def no_compass(name: str, count: int = 60, every: int = 173) -> None:
    """Robots read and command the same in a turned and shifted world."""
    system, draws = resolve(name), np.random.default_rng(2)
    for state in itertools.islice(recorded(name, every), 1, count + 1):
        turn = draws.uniform(-math.pi, math.pi)
        x, y = draws.uniform(-3.0, 3.0, 2)
        gaps = {path: gap for path, gap in worst(system, state, turn, (x, y)).items() if gap > EXACT}
        require(
            not gaps, f"cycle {state.clock[0].cycle}, turned by {turn:.3f} rad: {gaps}; who knows the world's axes?"
        )

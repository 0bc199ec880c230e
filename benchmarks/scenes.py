"""The trials that are timed, and a reference kernel, so that figures of different machines can be compared."""

import math
import time
from unittest import mock

import numpy as np

from formicarium.compiled import compiled
from formicarium.systems.sequencing.parameters import SequencingParameters, mark_i3_parameters
from formicarium.systems.sequencing.setup import SequencingState, begin
from formicarium.trial import setup

SEED = 5
WARM_UP = 1000  # cycles before anything is timed: the chain is under construction
WINDOW = 1000  # cycles

# Name, setting of Table 1, robots. None: a hexagon with as much room for each as setting 4 has for its 80.
Scene = tuple[str, int | None, int]
SCENES: tuple[Scene, ...] = (
    ("setting 0", 0, 20),
    ("setting 1", 1, 28),
    ("setting 2", 2, 40),
    ("setting 3", 3, 57),
    ("setting 4", 4, 80),
    ("setting 4", 4, 160),
    ("setting 4", 4, 216),
    ("as dense", None, 1000),
)


def warmed(scene: Scene, run) -> SequencingState:
    """Return the state of a scene after its first cycles."""
    _, setting, robots = scene
    state = crowd(robots) if setting is None else begin(mark_i3_parameters(setting=setting, robots=robots), SEED)
    run(state, WARM_UP)
    return state


def crowd(robots: int) -> SequencingState:
    """Begin a trial with more robots than there are identities, and more room than the parameters allow.

    Only for timing: several robots carry the same byte, which the bounds of the parameters rightly forbid. They
    are numbered through when they are placed, and the numbers folded into 1 to 255 afterwards.
    """
    usual = mark_i3_parameters(setting=4)
    side = usual.arena.side * math.sqrt(robots / usual.swarm.robots)
    parameters = unchecked(usual, arena={"side": side}, swarm={"robots": robots})
    with mock.patch.object(setup, "IDENTITIES", robots):
        state = begin(parameters, SEED)
    state.robots.identity = (state.robots.identity - 1) % setup.IDENTITIES + 1
    return state


def unchecked(parameters: SequencingParameters, **groups: dict[str, float]) -> SequencingParameters:
    """Return parameters with fields changed beyond their bounds."""
    changed = {group: getattr(parameters, group).model_copy(update=fields) for group, fields in groups.items()}
    return parameters.model_copy(update=changed)


@compiled
def reference_kernel(places, cycles):
    """Return a number that depends on the distance and direction of all pairs, over and over."""
    total = 0.0
    for _ in range(cycles):
        for i in range(len(places)):
            for j in range(len(places)):
                dx = places[j, 0] - places[i, 0] + total * 1e-18
                dy = places[j, 1] - places[i, 1]
                total += math.sqrt(dx * dx + dy * dy) + math.atan2(dy, dx + 1e-9)
    return total


PLACES = np.random.default_rng(1).uniform(-1, 1, (20, 2))


def reference_time() -> float:
    """Return microseconds per point and cycle of the reference kernel: all pairs of 20 points."""
    start = time.perf_counter()
    reference_kernel(PLACES, WINDOW)
    return (time.perf_counter() - start) / WINDOW / len(PLACES) * 1e6

"""Microseconds per robot-step of a whole Mark I3 trial, everything on, one core, beside a reference kernel.

The reference kernel does a fixed amount of plain arithmetic (all pairs of 20 points: difference, root, arc
tangent), so that figures of different machines can be compared as ratios.

    python benchmarks/robot_step.py
"""

import math
import statistics
import time

import numpy as np

from formicarium.compiled import compiled
from formicarium.systems.sequencing.loop import run
from formicarium.systems.sequencing.parameters import mark_i3_parameters
from formicarium.systems.sequencing.setup import begin

SCENES = ((0, 20), (1, 28), (2, 40), (3, 57), (4, 80), (4, 160))  # setting of Table 1, robots
SEED = 5
WARM_UP = 1000  # cycles
WINDOW = 1000  # cycles
REPEATS = 7


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


def reference_time(places: np.ndarray) -> float:
    """Return microseconds per point and cycle of the reference kernel."""
    start = time.perf_counter()
    reference_kernel(places, WINDOW)
    return (time.perf_counter() - start) / WINDOW / len(places) * 1e6


def main() -> None:
    """Time every scene and the reference kernel in turn, and print medians."""
    places = np.random.default_rng(1).uniform(-1, 1, (20, 2))
    reference_kernel(places, 1)
    print("setting  robots  us/robot-step (median, min..max)  reference us/point  ratio  times real time")
    for setting, robots in SCENES:
        state = begin(mark_i3_parameters(setting=setting, robots=robots), SEED)
        run(state, WARM_UP)
        steps, references = [], []
        for _ in range(REPEATS):
            state.clock[0].event_count = 0
            references.append(reference_time(places))
            start = time.perf_counter()
            run(state, WINDOW)
            steps.append((time.perf_counter() - start) / WINDOW / robots * 1e6)
        step, reference = statistics.median(steps), statistics.median(references)
        print(
            f"{setting:7d} {robots:7d}  {step:13.2f}   ({min(steps):.2f}..{max(steps):.2f}) {reference:19.3f}"
            f" {step / reference:9.1f} {0.1 / (step * robots * 1e-6):12.0f}"
        )


if __name__ == "__main__":
    main()

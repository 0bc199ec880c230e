"""Microseconds per robot-step of a whole Mark I3 trial, everything on, one core, beside a reference kernel.

The reference kernel does a fixed amount of plain arithmetic (all pairs of 20 points: difference, root, arc
tangent), so that figures of different machines, or of a busy one, can be compared as ratios. Every window of the
trial is paired with one of the kernel; the ratio is the median over the pairs. Members are the robots in the chain at
the end: who talks and shines costs more than who walks, and of 1,000 robots only one chain's worth does.

    python benchmarks/robot_step.py
"""

import statistics
import time

import numpy as np
from scenes import PLACES, SCENES, WINDOW, reference_kernel, reference_time, warmed

from formicarium.systems.sequencing.loop import run
from formicarium.systems.sequencing.memory import Role

REPEATS = 7


def main() -> None:
    """Time every scene and the reference kernel in turn, and print medians."""
    reference_kernel(PLACES, 1)
    print("scene      robots  us/robot-step (median, min..max)  reference us/point  ratio  times real time  members")
    for scene in SCENES:
        name, _, robots = scene
        state = warmed(scene, run)
        steps, references = [], []
        for _ in range(REPEATS):
            state.clock[0].event_count = 0
            references.append(reference_time())
            start = time.perf_counter()
            run(state, WINDOW)
            steps.append((time.perf_counter() - start) / WINDOW / robots * 1e6)
        step, reference = statistics.median(steps), statistics.median(references)
        ratio = statistics.median(step / reference for step, reference in zip(steps, references, strict=True))
        members = np.count_nonzero(state.memories.role != Role.RUNNER)
        real_time = state.world.settings[0].cycle_time / (step * robots * 1e-6)
        print(
            f"{name:9s} {robots:7d}  {step:13.2f}   ({min(steps):.2f}..{max(steps):.2f}) {reference:19.3f}"
            f" {ratio:9.1f} {real_time:12.0f} {members:8d}",
            flush=True,
        )


if __name__ == "__main__":
    main()

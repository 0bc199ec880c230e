"""Microseconds per robot-step of coverage trials with 101 robots, one core, everything on; means over 900 s.

    python benchmarks/coverage_step.py

The first 100 s, while the robots still stand in a crowd, are given beside: everybody hears everybody there.
"""

import time

from formicarium.systems.coverage.loop import run
from formicarium.systems.coverage.setup import begin
from formicarium.systems.registry import resolve

ROBOTS, SEED = 101, 900301
WINDOW, WINDOWS = 1000, 9  # cycles of 0.1 s


def timed(arms: int, variant: str) -> list[float]:
    """Return microseconds a robot-step of each window of a trial."""
    usual = resolve("coverage").configure(setting=2, robots=ROBOTS).model_dump()
    usual["tasks"]["count"], usual["behaviour"]["variant"] = arms, variant
    state = begin(resolve("coverage").parameters.model_validate(usual), SEED)
    run(state, 0)  # compiled now
    steps = []
    for _ in range(WINDOWS):
        state.clock[0].event_count = 0
        start = time.perf_counter()
        run(state, WINDOW)
        steps.append((time.perf_counter() - start) / WINDOW / ROBOTS * 1e6)
    return steps


def main() -> None:
    """Time one arm and three, both variants."""
    print("arms  variant    us/robot-step  in the first 100 s")
    for arms in (1, 3):
        for variant in ("faithful", "safe"):
            steps = timed(arms, variant)
            print(f"{arms:4d}  {variant:8s} {sum(steps) / WINDOWS:15.2f} {steps[0]:19.2f}", flush=True)


if __name__ == "__main__":
    main()

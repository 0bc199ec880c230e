"""Small random instances with capabilities, priorities and disjoint paths."""

import numpy as np

from formicarium.scheduling.instance import Instance, InstanceError, Task, Team, checked


def small_instance(seed, most=5):
    """Draw an instance that can be scheduled."""
    draws = np.random.default_rng([41, seed])
    while True:
        count = int(draws.integers(2, most + 1))
        side = float(draws.uniform(4, 14))
        teams = tuple(
            Team(int(draws.integers(1, 7)), frozenset(some)) for some in ("", "a", "b", "ab") if draws.random() < 0.7
        )
        tasks = tuple(
            Task(
                f"t{k}", float(draws.uniform(0, side)), float(draws.uniform(0, side)), int(draws.integers(1, 4)),
                float(draws.choice([1, 2, 2.5, 4])), frozenset(c for c in "ab" if draws.random() < 0.3),
            )
            for k in range(count)
        )  # fmt: skip
        pairs = [(f"t{i}", f"t{j}") for i in range(count) for j in range(i + 1, count) if draws.random() < 0.12]
        start = (float(draws.uniform(0, side)), float(draws.uniform(0, side)))
        found = Instance(
            f"small-{seed}", teams, tasks, (0.0, 0.0, side, side), start, tuple(pairs), paths=1 + (seed % 3 == 0)
        )
        try:
            return checked(found)
        except InstanceError:
            continue

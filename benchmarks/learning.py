"""What a step of the environment for learning costs: 20 e-pucks of Mark I3, beside the compiled loop.

python benchmarks/learning.py
"""

import statistics
import time

import numpy as np

import formicarium
from formicarium.systems.registry import resolve

STEPS, ROUNDS = 300, 7


def stepping(**options):
    parameters = formicarium.parameters("mark-i3", robots=20)
    env = formicarium.parallel_env("mark-i3", parameters=parameters, **options)
    costs = []
    for round_ in range(ROUNDS + 1):
        env.reset(seed=round_)
        actions = {agent: env.action_space(agent).sample() for agent in env.agents}
        began = time.process_time()
        for _ in range(STEPS):
            env.step(actions)
        costs.append((time.process_time() - began) / STEPS)
    return costs[1:]  # the first compiles


def looping():
    system, costs = resolve("mark-i3"), []
    for round_ in range(ROUNDS + 1):
        state = system.begin(system.configure(robots=20), round_)
        began = time.process_time()
        system.advance(state, STEPS)
        costs.append((time.process_time() - began) / STEPS)
    return costs[1:]


def main():
    cases = {
        "compiled loop": looping(),
        "all of the Reading, all of the Command": stepping(),
        "proximity and wheels, the rest by the behaviour": stepping(observe=["proximity"], act=["left", "right"]),
    }
    for name, costs in cases.items():
        low, middle, high = (1e6 * np.array([min(costs), statistics.median(costs), max(costs)])).round(0)
        print(f"{name}: {middle:.0f} us a cycle ({low:.0f} to {high:.0f}), {0.1e6 / middle:.0f} times real time")


if __name__ == "__main__":
    main()

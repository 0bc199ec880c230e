"""Random instances of the paper's section IV-B, in the classes of which its text gives only the numbers 1 to 5."""

import math
from typing import NamedTuple

import numpy as np

from formicarium.scheduling.instance import Instance, Task, Team

DENSITIES = (0.005, 0.01, 0.05, 0.1, 0.2, 0.5)  # D of (15)


class InstanceClass(NamedTuple):
    """How instances of a class are drawn. The paper gives no table of classes: these are a guess, but for class 5."""

    robots: int  # |N|
    tasks: int  # |T|
    most_robots: int  # beta_max
    longest: int  # delta_max
    ability: float  # p_Rob
    need: float  # p_Tsk
    meaning: str


CLASSES = {
    1: InstanceClass(100, 20, 5, 1, 0.75, 0.25, "baseline (Fig. 6)"),
    2: InstanceClass(20, 20, 3, 1, 0.75, 0.25, "small swarm"),
    3: InstanceClass(100, 20, 5, 1, 0.25, 0.75, "scarce skills"),
    4: InstanceClass(100, 20, 20, 1, 0.75, 0.25, "large teams demanded"),
    5: InstanceClass(100, 20, 5, 10, 0.75, 0.25, "heterogeneous durations (said in V-B)"),
    6: InstanceClass(20, 100, 3, 1, 0.75, 0.25, "20 robots, 100 tasks"),
    7: InstanceClass(20, 100, 3, 10, 0.75, 0.25, "the same, heterogeneous durations"),
    8: InstanceClass(100, 100, 5, 1, 0.75, 0.25, "100 robots, 100 tasks"),
    9: InstanceClass(100, 100, 5, 10, 0.75, 0.25, "the same, heterogeneous durations"),
}
SKILLS = ("a", "b")  # |C| = 2


def draw_instance(number: int, density: float, seed: int, tasks: int | None = None) -> Instance:
    """Draw an instance of a class.

    Args:
        number: of the class, 1 to 9.
        density: communication density D, see (15).
        seed: of everything that is drawn.
        tasks: instead of the class's number of tasks.
    """
    kind = CLASSES[number]
    draws = np.random.default_rng([number, round(density * 1000), seed, *([tasks] if tasks else [])])
    side = math.sqrt(kind.robots * math.pi / density)  # Gamma = 1
    abilities = [_some(draws, kind.ability) for _ in range(kind.robots)]
    teams = tuple(Team(abilities.count(some), some) for some in sorted(set(abilities), key=sorted))
    found = Instance("", teams, (), (0.0, 0.0, side, side), (0.0, 0.0))
    chosen = tuple(_task(draws, kind, found, name) for name in range(tasks or kind.tasks))
    start = (float(draws.uniform(0, side)), float(draws.uniform(0, side)))
    name = f"class-{number}-density-{density:g}-seed-{seed}" + (f"-tasks-{tasks}" if tasks else "")
    return found._replace(name=name, tasks=chosen, start=start)


def _some(draws: np.random.Generator, chance: float) -> frozenset[str]:
    return frozenset(skill for skill in SKILLS if draws.random() < chance)


def _task(draws: np.random.Generator, kind: InstanceClass, swarm: Instance, name: int) -> Task:
    """Draw a task; one that nobody can do is drawn again (the paper does not say what was done)."""
    while True:
        x, y = (float(value) for value in draws.uniform(0, swarm.region[2], 2))
        robots, duration = int(draws.integers(1, kind.most_robots + 1)), float(draws.integers(1, kind.longest + 1))
        task = Task(f"t{name + 1}", x, y, robots, duration, _some(draws, kind.need))
        if robots <= min(sum(swarm.teams[k].robots for k in swarm.able(task)), swarm.robots - 1):
            return task

"""An instance as arrays of numbers, in the form that solvers work with."""

from fractions import Fraction
from itertools import combinations
from math import gcd, lcm
from typing import NamedTuple

import numpy as np

from formicarium.scheduling.instance import Instance
from formicarium.scheduling.reach import Reach

MOST_NEEDS = 12  # different sets of teams that tasks can be done by: 2^12 rows of Hall's theorem


class Problem(NamedTuple):
    """Tasks, limits and order of an instance; T tasks, R rows."""

    places: np.ndarray  # (T, 2) sigma, m
    robots: np.ndarray  # (T,) beta
    ticks: np.ndarray  # (T,) durations, whole multiples of the unit
    unit: float  # greatest common divisor of the durations: every schedule takes a multiple of it
    demands: np.ndarray  # (R, T) robots that a task takes of row r; row 0 is the whole swarm without its master
    limits: np.ndarray  # (R,) robots that there are in row r
    before: np.ndarray  # (P, 2) pairs of tasks: the first in an earlier slot than the second
    region: np.ndarray  # (4,) x from, y from, x to, y to, m
    start: np.ndarray  # (2,) m
    spacing: float  # Gamma, m
    paths: int  # Omega
    reach: int
    swarm: int  # |N|

    @property
    def size(self) -> int:
        """Number of tasks."""
        return len(self.robots)


def problem_of(instance: Instance, reach: Reach) -> Problem:
    """Return the arrays of a valid instance.

    Raises:
        ValueError: if tasks need more than MOST_NEEDS combinations of capabilities that differ in who has them.
    """
    tasks = instance.tasks
    fractions = [Fraction(str(task.duration)) for task in tasks]
    below = lcm(*(fraction.denominator for fraction in fractions))
    whole = [int(fraction * below) for fraction in fractions]
    common = gcd(*whole)
    demands, limits = _rows(instance)
    index = {task.name: number for number, task in enumerate(tasks)}
    return Problem(
        places=np.array([[task.x, task.y] for task in tasks], float).reshape(-1, 2),
        robots=np.array([task.robots for task in tasks], np.int64),
        ticks=np.array([value // common for value in whole], np.int64),
        unit=float(Fraction(common, below)),
        demands=demands,
        limits=limits,
        before=np.array([[index[a], index[b]] for a, b in instance.priorities], np.int64).reshape(-1, 2),
        region=np.array(instance.region, float),
        start=np.array(instance.start, float),
        spacing=float(instance.spacing),
        paths=instance.paths,
        reach=int(reach),
        swarm=instance.robots,
    )


def _rows(instance: Instance) -> tuple[np.ndarray, np.ndarray]:
    """Return who takes robots of which group of teams, and how many there are: Hall's theorem.

    A slot can be manned iff for every set of its tasks there are as many robots able to do one of them as they
    demand together. It is enough to look at the tasks that all lie within one union of "who can do it".
    """
    able = [frozenset(instance.able(task)) for task in instance.tasks]
    kinds = sorted(set(able), key=sorted)
    if len(kinds) > MOST_NEEDS:
        raise ValueError(f"tasks need {len(kinds)} different groups of robots; at most {MOST_NEEDS} are supported")
    unions = {frozenset().union(*some) for k in range(1, len(kinds) + 1) for some in combinations(kinds, k)}
    demanded = np.array([task.robots for task in instance.tasks], np.int64)
    demands, limits = [demanded], [instance.robots - 1]
    for union in sorted(unions, key=sorted):
        row = np.where([teams <= union for teams in able], demanded, 0)
        robots = sum(instance.teams[team].robots for team in union)
        if robots < instance.robots and row.sum() > robots:
            demands.append(row)
            limits.append(robots)
    return np.array(demands), np.array(limits, np.int64)

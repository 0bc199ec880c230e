"""An instance as arrays of numbers, in the form that solvers work with."""

from fractions import Fraction
from itertools import combinations
from math import gcd, lcm
from typing import NamedTuple

import numpy as np

from formicarium.scheduling.instance import Instance, InstanceError
from formicarium.scheduling.reach import Reach

DIGITS = 9  # significant ones of a duration: 0.1 * 3 and 0.3 are the same
MOST_TICKS = 2**53
MOST_NEEDS = 12  # different sets of teams that tasks can be done by: 2^12 rows of Hall's theorem


class Problem(NamedTuple):
    """Tasks, limits and order of an instance; T tasks, R rows. Lengths are in hops from a corner of the region."""

    places: np.ndarray  # (T, 2) sigma
    robots: np.ndarray  # (T,) beta
    ticks: np.ndarray  # (T,) durations, whole multiples of the unit
    unit: float  # greatest common divisor of the durations: every schedule takes a multiple of it
    demands: np.ndarray  # (R, T) robots that a task takes of row r; row 0 is the whole swarm without its master
    limits: np.ndarray  # (R,) robots that there are in row r
    before: np.ndarray  # (P, 2) pairs of tasks: the first in an earlier slot than the second
    region: np.ndarray  # (4,) x from, y from, x to, y to
    start: np.ndarray  # (2,)
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
        InstanceError: if durations have no common unit that is large enough, or tasks need more than MOST_NEEDS
            combinations of capabilities that differ in who has them.
    """
    tasks = instance.tasks
    fractions = [Fraction(f"{task.duration:.{DIGITS}g}") for task in tasks]
    below = lcm(*(fraction.denominator for fraction in fractions))
    whole = [int(fraction * below) for fraction in fractions]
    common = gcd(*whole)
    if sum(whole) // common > MOST_TICKS:
        unit = float(Fraction(common, below))
        raise InstanceError(f"durations: all are multiples of no more than {unit:g}: round them to fewer digits")
    demands, limits = _rows(instance)
    corner = np.array(instance.region[:2], float)
    index = {task.name: number for number, task in enumerate(tasks)}
    return Problem(
        places=(np.array([[task.x, task.y] for task in tasks], float).reshape(-1, 2) - corner) / instance.spacing,
        robots=np.array([task.robots for task in tasks], np.int64),
        ticks=np.array([value // common for value in whole], np.int64),
        unit=float(Fraction(common, below)),
        demands=demands,
        limits=limits,
        before=np.array([[index[a], index[b]] for a, b in instance.priorities], np.int64).reshape(-1, 2),
        region=(np.array(instance.region, float) - np.tile(corner, 2)) / instance.spacing,
        start=(np.array(instance.start, float) - corner) / instance.spacing,
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
        raise InstanceError(
            f"tasks need {len(kinds)} different groups of teams, at most {MOST_NEEDS} can be scheduled: give tasks or "
            "teams that differ little the same capabilities"
        )
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

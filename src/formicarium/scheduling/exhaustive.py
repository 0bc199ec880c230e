"""Every schedule there is, for a handful of tasks: slow, plain, and nothing of the exact method in it."""

from collections.abc import Iterator
from functools import cache
from itertools import permutations

from formicarium.scheduling.clock import Clock
from formicarium.scheduling.instance import Instance
from formicarium.scheduling.model import solve_model
from formicarium.scheduling.reach import Reach

MOST_TASKS = 8


def partitions(items: list[int]) -> Iterator[list[list[int]]]:
    """Yield every way to part items into groups."""
    if not items:
        yield []
        return
    first, rest = items[0], items[1:]
    for parted in partitions(rest):
        yield [[first], *parted]
        for k in range(len(parted)):
            yield [*parted[:k], [first, *parted[k]], *parted[k + 1 :]]


def orders(instance: Instance) -> Iterator[list[list[int]]]:
    """Yield every ordered partition that respects the priorities."""
    index = {task.name: number for number, task in enumerate(instance.tasks)}
    pairs = [(index[a], index[b]) for a, b in instance.priorities]
    for groups in partitions(list(range(len(instance.tasks)))):
        for order in permutations(groups):
            place = {task: number for number, group in enumerate(order) for task in group}
            if all(place[a] < place[b] for a, b in pairs):
                yield list(order)


def least_time_of_all(instance: Instance, reach: Reach) -> float:
    """Return the least completion time by looking at every schedule.

    Whether tasks can be done at once is asked of the paper's model with a single slot.

    Raises:
        ValueError: if there are more than MOST_TASKS tasks.
    """
    _check_size(instance)
    tasks = instance.tasks

    @cache
    def fits(group: tuple[int, ...]) -> bool:
        alone = instance._replace(tasks=tuple(tasks[t] for t in group), priorities=())
        return solve_model(alone, reach, Clock(), slots=1).schedule is not None

    return min(
        sum(max(tasks[t].duration for t in group) for group in order)
        for order in orders(instance)
        if all(fits(tuple(sorted(group))) for group in order)
    )


def least_travel_of_all(instance: Instance, reach: Reach, time: float, charge_first: bool) -> float:
    """Return the least dislocation (14) within a completion time, by solving every ordered partition.

    Raises:
        ValueError: if there are more than MOST_TASKS tasks.
    """
    _check_size(instance)
    best = float("inf")
    for order in orders(instance):
        if sum(max(instance.tasks[t].duration for t in group) for group in order) <= time + 1e-6:
            best = min(best, _cost(instance, order, reach, charge_first))
    return best


def _cost(instance: Instance, order: list[list[int]], reach: Reach, charge_first: bool) -> float:
    """Return the dislocation of an ordered partition, by the paper's model with every task fixed to its slot."""
    fixed = tuple((instance.tasks[t].name, slot) for slot, group in enumerate(order) for t in group)
    return solve_model(instance, reach, Clock(), len(order), float("inf"), charge_first, fixed).value


def _check_size(instance: Instance) -> None:
    if len(instance.tasks) > MOST_TASKS:
        raise ValueError(f"{len(instance.tasks)} tasks are too many to look at every schedule; at most {MOST_TASKS}")

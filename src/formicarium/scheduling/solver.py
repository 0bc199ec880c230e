"""From an instance to a schedule with a proof: ``solve(read_instance("tasks.toml"))``."""

from typing import Literal, get_args

import numpy as np

from formicarium.scheduling.clock import Clock, Told
from formicarium.scheduling.completion import Completion, least_time
from formicarium.scheduling.deployment import Places
from formicarium.scheduling.descent import SAME
from formicarium.scheduling.instance import Instance, checked
from formicarium.scheduling.problem import Problem, problem_of
from formicarium.scheduling.reach import Reach
from formicarium.scheduling.schedule import Answer, Arm, Schedule, Slot, travel_cost
from formicarium.scheduling.travel import Tour, least_travel

Objective = Literal["time", "travel"]
Reached = Literal["printed", "inscribed", "euclid"]
RELATIVE_GAP = 1e-4  # of the dislocation: closer is called proven (the default of the paper's solver)


def solve(
    instance: Instance,
    objective: Objective = "travel",
    reach: Reached = "inscribed",
    time_limit: float | None = None,
    *,
    charge_first: bool = True,
    told: Told | None = None,
    processor_time: bool = False,
) -> Answer:
    """Schedule the tasks of an instance.

    Args:
        instance: what is to be done, and by whom.
        objective: "time": the least completion time (TCTM). "travel": among the schedules of least completion time
            the one with the least dislocation (TDSM).
        reach: how far an arm of n hops reaches: the paper's octagon around the circle ("printed": up to 8 % beyond
            radio reach), the octagon inside it ("inscribed"), or the circle.
        time_limit: seconds; the best schedule so far is the answer then, as it is on Ctrl-C.
        charge_first: whether "travel" counts the way from the start to the first deployment point; the paper's (14)
            does not.
        told: is told bound and value while the work goes on.
        processor_time: count the time of the processor, not of the clock on the wall.

    Returns:
        The schedule with value, proven bound, gap, time and the part that made the bound. Equal for any machine and
        load unless time ran out.

    Raises:
        InstanceError: if the instance cannot be scheduled; names the task and the reason.
        ValueError: if objective or reach is none of these.
    """
    checked(instance)
    if objective not in get_args(Objective) or reach not in get_args(Reached):
        raise ValueError(f"({objective!r}, {reach!r}): must be of {get_args(Objective)} and of {get_args(Reached)}")
    clock = Clock(time_limit, told, processor_time)
    problem = problem_of(instance, Reach[reach.upper()])
    places = Places(problem)
    clock.unit = problem.unit
    best, ended = least_time(problem, places, clock, 1.0 if objective == "time" else 0.5)
    if objective == "time":
        points = [places.deploy(np.array(slot)) for slot in best.slots]
        found = [(slot, (p.x, p.y), p.hops) for slot, p in zip(best.slots, points) if p is not None]
        schedule = _schedule(instance, found)
        value, bound = best.value * problem.unit, best.bound * problem.unit
        return Answer("time", schedule, value, bound, clock.seconds, best.proof, ended, time_bound=bound)
    return _travel(instance, problem, places, best, ended, charge_first, clock)


def shorten(
    instance: Instance,
    schedule: Schedule,
    reach: Reached = "inscribed",
    time_limit: float | None = None,
    *,
    charge_first: bool = True,
    told: Told | None = None,
    processor_time: bool = False,
) -> Answer:
    """Find the least dislocation within the completion time of a schedule; arguments as of ``solve``."""
    clock = Clock(time_limit, told, processor_time)
    problem = problem_of(instance, Reach[reach.upper()])
    index = {task.name: number for number, task in enumerate(instance.tasks)}
    slots = [tuple(sorted(index[arm.task] for arm in slot.arms)) for slot in schedule.slots]
    ticks = int(sum(problem.ticks[list(slot)].max() for slot in slots))
    known = Completion(slots, ticks, ticks, "given")
    return _travel(instance, problem, Places(problem), known, "proven", charge_first, clock)


def _travel(
    instance: Instance, problem: Problem, places: Places, known: Completion, so_far: str, charge_first: bool,
    clock: Clock,
) -> Answer:  # fmt: skip
    clock.unit = instance.spacing
    tour, ended = least_travel(problem, places, known.slots, known.value, charge_first, RELATIVE_GAP, clock, so_far)
    schedule = _schedule(instance, _visits(tour))
    value = travel_cost(instance, schedule, charge_first)
    bound = min(tour.bound * instance.spacing, value)
    if value - bound <= 1.001 * SAME * instance.spacing:
        bound = value
    if ended == "proven" and value - bound > 1.001 * RELATIVE_GAP * value:
        ended = "gave up"
    if ended == "proven" and so_far != "proven":
        ended = so_far  # least dislocation within a time that may not be the least
    time, time_bound = known.value * problem.unit, known.bound * problem.unit
    return Answer("travel", schedule, value, bound, clock.seconds, tour.proof, ended, time, time_bound)


def _visits(tour: Tour) -> list:
    return [(slot, point, hops) for slot, point, hops in zip(tour.slots, tour.way.points, tour.way.hops)]


def _schedule(instance: Instance, visits: list) -> Schedule:
    """Return slots in metres from those in hops."""
    slots, (x0, y0) = [], instance.region[:2]
    for tasks, (x, y), hops in visits:
        arms = [Arm(instance.tasks[t].name, instance.paths * int(h)) for t, h in zip(tasks, hops)]
        longest = max(instance.tasks[t].duration for t in tasks)
        x, y = x0 + float(x) * instance.spacing, y0 + float(y) * instance.spacing
        slots.append(Slot(x, y, longest, tuple(arms)))
    return Schedule(tuple(slots))

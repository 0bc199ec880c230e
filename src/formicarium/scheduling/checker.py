"""The independent judge of schedules. It shares no code with the solvers and computes in whole numbers only.

Lengths are rounded to nanometres once, and every comparison after that is exact. An arm may be too short by a
millionth of a hop, because a solver keeps its limits to a number of digits, and by two nanometres for the rounding.
"""

import itertools
import math
from collections.abc import Sequence
from math import isqrt
from numbers import Integral, Real
from typing import NamedTuple

import numpy as np
from scipy.sparse import csr_array
from scipy.sparse.csgraph import maximum_flow

from formicarium.scheduling.instance import Instance, Task, is_number
from formicarium.scheduling.schedule import Schedule, Slot

NANOMETRES = 10**9
FARTHEST = 1e15  # m
DIGITS = 1e-8  # relative: solvers add durations up in nine digits
SLACK, ROUNDED = 1e-6, 2  # hops; nm: a place and a deployment point, along both axes
REACHES = ("printed", "inscribed", "euclid")
# cos^2(pi / 8) = (2 + sqrt 2) / 4, rounded up in the tenth digit: the inscribed octagon
INNER_SQUARE = (2 * 10**10 + isqrt(2 * 10**20) + 1, 4 * 10**10)


class Verdict(NamedTuple):
    """What the judge finds."""

    faults: tuple[str, ...]  # empty: the schedule can be carried out as it says
    time: float  # completion time, added up again
    trip: float  # way between deployment points along the axes, m
    first_trip: float  # way to the first one, m
    relays: int  # of all arms
    over_radio: int  # arms that are longer than the radio reaches in a straight line, whatever was asked for


def check(instance: Instance, schedule: Schedule, reach: str = "printed", time_limit: float | None = None) -> Verdict:
    """Judge a schedule against everything that the instance demands.

    Args:
        instance: what was to be scheduled.
        schedule: what came of it.
        reach: "printed", "inscribed" or "euclid", see (7) to (9) of the paper.
        time_limit: that the completion time must not exceed.

    Raises:
        ValueError: if the reach is none of these, or the limit is no number.
    """
    if reach not in REACHES:
        raise ValueError(f"reach = {reach!r}: must be one of {', '.join(REACHES)}")
    if time_limit is not None and not (is_number(time_limit, Real) and not math.isnan(time_limit)):
        raise ValueError(f"time_limit = {time_limit!r}: must be a number")
    if strange := _strange(schedule):
        return Verdict(strange, math.nan, math.nan, math.nan, 0, 0)
    schedule = Schedule(tuple(map(_plain, schedule.slots)))
    tasks = {task.name: task for task in instance.tasks}
    faults = _faults_of_cover(instance, schedule)
    over_radio = 0
    for number, slot in enumerate(schedule.slots, 1):
        present = [tasks[arm.task] for arm in slot.arms if arm.task in tasks]
        faults += [f"slot {number}: {fault}" for fault in _faults_of_slot(instance, slot, present)]
        for arm in slot.arms:
            if arm.task not in tasks:
                continue
            if arm.relays < 0 or arm.relays % instance.paths:
                faults.append(f"slot {number}: {arm.task}: {arm.relays} relays are no {instance.paths} equal paths")
            if not _reached(instance, slot, tasks[arm.task], arm.relays, reach):
                faults.append(f"slot {number}: {arm.task} is out of reach with {arm.relays} relays ({reach})")
            over_radio += not _reached(instance, slot, tasks[arm.task], arm.relays, "euclid")
    place = {arm.task: number for number, slot in enumerate(schedule.slots) for arm in slot.arms}
    for first, second in instance.priorities:
        if first in place and second in place and place[first] >= place[second]:
            faults.append(f"{first} is not done before {second}")
    time = sum(
        max((tasks[arm.task].duration for arm in s.arms if arm.task in tasks), default=0.0) for s in schedule.slots
    )
    if time_limit is not None and time > time_limit * (1.0 + DIGITS) + 1e-6:
        faults.append(f"takes {time}, more than {time_limit}")
    points = [(_nano(slot.x), _nano(slot.y)) for slot in schedule.slots]
    trip = sum(abs(b[0] - a[0]) + abs(b[1] - a[1]) for a, b in itertools.pairwise(points))
    start = (_nano(instance.start[0]), _nano(instance.start[1]))
    outward = abs(points[0][0] - start[0]) + abs(points[0][1] - start[1]) if points else 0
    relays = sum(arm.relays for slot in schedule.slots for arm in slot.arms)
    return Verdict(tuple(faults), time, trip / NANOMETRES, outward / NANOMETRES, relays, over_radio)


def _strange(schedule: Schedule) -> tuple[str, ...]:
    """Return what is no number in a schedule: nothing else can be judged then."""
    faults = []
    for number, slot in enumerate(schedule.slots, 1):
        if not all(is_number(value, Real) and abs(value) <= FARTHEST for value in (slot.x, slot.y, slot.duration)):
            faults.append(f"slot {number}: ({slot.x!r}, {slot.y!r}) for {slot.duration!r} is no place and time")
        for arm in slot.arms:
            if not is_number(arm.relays, Integral):
                faults.append(f"slot {number}: {arm.task}: {arm.relays!r} is no whole number of relays")
    return tuple(faults)


def _plain(slot: Slot) -> Slot:
    """Return a slot with Python's numbers instead of NumPy's, which overflow."""
    arms = tuple(arm._replace(relays=int(arm.relays)) for arm in slot.arms)
    return Slot(float(slot.x), float(slot.y), float(slot.duration), arms)


def _nano(length: float) -> int:
    return round(length * NANOMETRES)


def _faults_of_cover(instance: Instance, schedule: Schedule) -> list[str]:
    done = [arm.task for slot in schedule.slots for arm in slot.arms]
    known = {task.name for task in instance.tasks}
    faults = [f"{name} is done {done.count(name)} times" for name in sorted(set(done)) if done.count(name) > 1]
    faults += [f"{name} is no task" for name in sorted(set(done) - known)]
    faults += [f"{name} is never done" for name in sorted(known - set(done))]
    return faults + [f"slot {number} is empty" for number, slot in enumerate(schedule.slots, 1) if not slot.arms]


def _faults_of_slot(instance: Instance, slot: Slot, present: Sequence[Task]) -> list[str]:
    faults = []
    demanded = sum(task.robots for task in present) + sum(arm.relays for arm in slot.arms)
    swarm = sum(team.robots for team in instance.teams)
    if demanded > swarm - 1:
        faults.append(f"{demanded} robots are needed beside the master, there are {swarm - 1}")
    if lacking := _lacking(instance, present):
        faults.append(f"{lacking} robots with the right capabilities are lacking")
    x0, y0, x1, y1 = map(_nano, instance.region)
    x, y = _nano(slot.x), _nano(slot.y)
    slack = _slack(instance)
    if not (x0 - slack <= x <= x1 + slack and y0 - slack <= y <= y1 + slack):
        faults.append("the deployment point is outside the region")
    longest = max((task.duration for task in present), default=0.0)
    if abs(slot.duration - longest) > 1e-9:
        faults.append(f"lasts {slot.duration}, its longest task {longest}")
    return faults


def _lacking(instance: Instance, present: Sequence[Task]) -> int:
    """Return how many demanded robots are not there, by the largest flow from teams to tasks."""
    teams, tasks = len(instance.teams), len(present)
    source, sink = teams + tasks, teams + tasks + 1
    room = np.zeros((sink + 1, sink + 1), np.int32)
    for number, team in enumerate(instance.teams):
        room[source, number] = team.robots
        for place, task in enumerate(present):
            room[number, teams + place] = task.robots if task.needs <= team.abilities else 0
    room[teams : teams + tasks, sink] = [task.robots for task in present]
    return int(sum(task.robots for task in present) - maximum_flow(csr_array(room), source, sink).flow_value)


def _slack(instance: Instance) -> int:
    return ROUNDED + math.ceil(SLACK * _nano(instance.spacing))


def _reached(instance: Instance, slot: Slot, task: Task, relays: int, reach: str) -> bool:
    hops = relays // instance.paths + 1
    radius = hops * _nano(instance.spacing) + _slack(instance)
    across, up = abs(_nano(task.x) - _nano(slot.x)), abs(_nano(task.y) - _nano(slot.y))
    if reach == "euclid":
        return across**2 + up**2 <= radius**2
    square = radius**2
    over, under = INNER_SQUARE if reach == "inscribed" else (1, 1)
    return all(2 * value * under <= 2 * square * over for value in (across**2, up**2)) and (
        (across + up) ** 2 * under <= 2 * square * over
    )

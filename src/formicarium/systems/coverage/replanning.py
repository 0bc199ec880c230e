"""New plans in a trial (ST-72): the scheduler on board the master, which knows what has come to it and nothing else.

The scheduler is exact, large and not compiled with the loop. So the loop stops in the cycle in which a master asks, a
plan is made here of its own memory and chart, and the loop goes on. No time passes in between: a robot would think.
"""

from typing import Any

import numpy as np

from formicarium.robots.footbot import ARMS
from formicarium.systems.coverage.loop import run
from formicarium.systems.coverage.memory import SLOTS, Planning

PLANNING_TIME = 60.0  # s of the processor, then the best plan so far is flown


def advance(state: Any, cycles: int) -> None:
    """Advance a trial by so many control cycles, with new plans where a master asks for one."""
    clock = state.clock[0]
    end = int(clock.cycle) + cycles
    run(state, cycles)
    while state.survey[0].asked == 1 and clock.cycle < end:
        answer(state)
        run(state, end - int(clock.cycle))


def answer(state: Any) -> None:
    """Hand every master that has asked a plan of what it takes for undone."""
    for memory, chart in zip(state.memories, state.charts, strict=True):
        if memory.planning == Planning.ASKED:
            plan_anew(memory, chart)
    state.survey[0].asked = 0


def plan_anew(memory: np.record, chart: np.record) -> None:
    """Write a plan of what is left into the master's memory, from where it stands and with whom it has counted.

    Raises:
        ModuleNotFoundError: if the scheduler's extra is not installed; says what to type.
    """
    try:
        from formicarium.scheduling.instance import Instance, Task, Team
        from formicarium.scheduling.solver import solve
    except ModuleNotFoundError as error:
        raise ModuleNotFoundError(
            f"mission.replans = {int(chart.replans)}: a new plan needs {error.name}, which is not installed. "
            'Type: python -m pip install "formicarium[scheduling]"; or set mission.replans to 0'
        ) from error

    places = [k for k in range(int(chart.task_count)) if not int(memory.credited) >> k & 1]
    start = (float(memory.way_ahead), float(memory.way_aside))
    ahead, aside, to_ahead, to_aside = (float(length) for length in chart.region)
    tasks = [chart.tasks[k] for k in places]
    instance = Instance(
        name="what is left",
        teams=(Team(max(2, int(memory.crew))),),
        tasks=tuple(
            Task(str(k), float(t.ahead), float(t.aside), 1, left_of(memory, chart, k) * float(chart.cycle_time))
            for k, t in zip(places, tasks, strict=True)
        ),
        region=(min(ahead, start[0]), min(aside, start[1]), max(to_ahead, start[0]), max(to_aside, start[1])),
        start=start,
        priorities=tuple(
            (str(a), str(b)) for b, task in zip(places, tasks, strict=True) for a in places if int(task.after) >> a & 1
        ),
        spacing=float(chart.planning_range),
        paths=int(chart.paths),
    )
    schedule = solve(instance, "travel", "inscribed", PLANNING_TIME, processor_time=True).schedule
    assert schedule is not None  # every valid instance has one: a slot a task
    parts = [(s, s.arms[k : k + ARMS]) for s in schedule.slots for k in range(0, len(s.arms), ARMS)][:SLOTS]
    for slot, (planned, arms) in zip(memory.slots, parts, strict=False):
        slot.point_ahead, slot.point_aside, slot.travel, slot.task_count = planned.x, planned.y, 1, len(arms)
        for k, arm in enumerate(arms):
            task = chart.tasks[int(arm.task)]
            slot.task[k], slot.task_ahead[k], slot.task_aside[k] = int(arm.task) + 1, task.ahead, task.aside
            slot.wanted[k] = arm.relays + 1
        slot.hold_cycles = max(left_of(memory, chart, int(arm.task)) for arm in arms)
        slot.hold_limit = chart.erupt_cycles + slot.hold_cycles
    memory.slot_count = len(parts)
    memory.plans += 1
    memory.planning = Planning.ANSWERED


def left_of(memory: np.record, chart: np.record, place: int) -> int:
    """Return the cycles of work that a task still wants, as far as word has come; at least one."""
    return max(1, int(chart.tasks[place].cycles) - int(memory.worked[place]))

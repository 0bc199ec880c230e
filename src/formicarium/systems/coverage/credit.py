"""The credit of a mission's tasks (ST-70), and its time by phase: a measurer's, seen by no robot."""

from collections.abc import Sequence
from typing import Any

import numpy as np

from formicarium.compiled import compiled
from formicarium.observers.graphs import Graph
from formicarium.systems.coverage.memory import Mode

TASK_SEEN = np.dtype(
    [
        ("covered", "i8"),  # 1 while any connected robot is at the task
        ("since", "i8"),  # cycle
        ("cycles", "i8"),
        ("first", "i8"),  # cycle
        ("needed", "i8"),  # cycles of work, 0 without a plan
        ("worked", "i8"),  # cycles
        ("done_at", "i8"),  # cycle, -1 for not yet
    ],
    align=True,
)


@compiled
def is_worked_on(state, k):
    """Tell whether a robot works on a task now.

    It is alive, within the beacon's reach, of the arm that is for this task, in an eruption or a hold, and a way of
    lines of sight leads from it to the master.
    """
    beacon = state.beacons[k]
    reach = state.footbot[0].beacon_range
    for i in range(len(state.robots)):
        memory = state.memories[i]
        if state.robots[i].alive == 0 or state.places[i].reached[Graph.SIGHT] == 0 or memory.arm == 0:
            continue
        if memory.mode != Mode.ERUPT and memory.mode != Mode.HOLD:
            continue
        if memory.arms[memory.arm - 1].task != beacon.task:
            continue
        dx = state.world.bodies[i].x - beacon.x
        dy = state.world.bodies[i].y - beacon.y
        if dx * dx + dy * dy <= reach * reach:
            return True
    return False


@compiled
def give_credit(state, k):
    """Count a cycle of work on a task; tell whether that was the last one it needed."""
    task = state.tasks[k]
    if task.needed == 0 or not is_worked_on(state, k):
        return False
    task.worked += 1
    if task.worked != task.needed:
        return False
    task.done_at = state.clock[0].cycle
    return True


def mission_columns(state: Any, phases: Sequence[tuple[int, int]]) -> dict[str, int | float | str | None]:
    """Return a mission's columns: its tasks, and its planned and real time by phase, in seconds.

    Args:
        state: at the end of the trial.
        phases: (cycle, Mode) of each call of the master.
    """
    cycle_time = float(state.world.settings[0].cycle_time)
    end = int(state.clock[0].cycle)
    survey = state.survey[0]
    first = state.charts[int(np.flatnonzero(state.robots.key == 0)[0])]
    tasks = np.asarray(state.tasks)
    planned = sum(int(slot.hold_cycles) for slot in first.slots[: int(first.slot_count)])
    done = tasks["done_at"] >= 0
    row: dict[str, int | float | str | None] = {
        "tasks_done": int(done.sum()),
        "mission_done": int(done.all()),
        "mission_s": round((int(tasks["done_at"].max()) + 1) * cycle_time, 6) if done.all() else None,
        "planned_s": round(planned * cycle_time, 6),
        "slots": int(first.slot_count),
    }
    if first.task_count > 0:  # others may follow the master, or new plans be made
        row |= {"followed": max(0, int(survey.term) - 1), "planned_anew": int(survey.planned)}
    ends = [cycle for cycle, _ in phases[1:]] + [end]
    for mode in (Mode.FLOCK, Mode.ERUPT, Mode.HOLD, Mode.GATHER):
        cycles = sum(stop - start for (start, called), stop in zip(phases, ends, strict=True) if called == mode)
        row[f"{mode.name.lower()}_s"] = round(cycles * cycle_time, 6)
    for k, task in enumerate(tasks, 1):
        row[f"worked_{k}_s"] = round(int(task["worked"]) * cycle_time, 6)
        row[f"done_{k}_s"] = round((int(task["done_at"]) + 1) * cycle_time, 6) if task["done_at"] >= 0 else None
    return row

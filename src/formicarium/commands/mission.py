"""A map becomes a mission: tasks and robots from a file, a plan from the solver, and the plan among the parameters."""

from collections.abc import Sequence
from typing import Any, Literal

from pydantic import BaseModel
from rich.console import Console

from formicarium.campaigns.table import Row
from formicarium.commands.errors import UserError
from formicarium.commands.extras import require
from formicarium.commands.fields import with_settings, with_values
from formicarium.commands.known import parameters_of
from formicarium.scheduling.instance import Instance
from formicarium.statistics.runtimes import in_words, run_times
from formicarium.systems.registry import System

ATTEMPTS = 2  # at a slot [choice]
SLOT_TIME = 900.0  # s, that a trial lasts at most for each attempt at a slot [choice]
ERUPT_LIMIT = 300.0  # s, an eruption's time-out (ST-48)
SWEEP_CYCLES = 600  # an arm looks for its task between its robots after and within a minute [choice]
SILENCE_CYCLES = 50  # 5 s without word of the master, then another follows it (ST-48)
REPLANS = 8  # of what is left, at most [choice ST-72]
CENSUS_CYCLES = 300  # half a minute: a robot that is silent for longer is not waited for [choice ST-71]
PLANNING_TIME = 60.0  # s, then the best plan so far is flown
# Never farther than the circle: the paper's octagon plans arms that are too long (ST-54).
REACH: Literal["inscribed"] = "inscribed"


def parameters_with_map(
    system: System, setting: int | None, robots: int | None, settings: tuple[str, ...], file: str | None
) -> BaseModel:
    """Return the parameters of a trial; with a map, of a mission that is planned now.

    The plan becomes part of the parameters, so a run is whole without the file. ``settings`` have the last word.

    Raises:
        UserError: if the system flies no missions, or a setting or the map cannot be used.
        InstanceError: if the map cannot be scheduled; names file, task or field, and why.
    """
    if file is None:
        return parameters_of(system, setting, robots, settings)
    if "mission" not in system.parameters.model_fields:
        raise UserError(f"--map {file}: {system.name} does no tasks of a map; formicarium run coverage does")
    require("scheduling", "--map")
    from formicarium.scheduling.reading import read_instance

    spacings = tuple(said for said in settings if said.partition("=")[0].rpartition(".")[2] == "planning_range")
    asked: Any = parameters_of(system, setting, None, spacings)  # the others may not fit before the map is read
    instance = read_instance(file, robots, asked.mission.planning_range)
    refuse_what_arms_cannot_do(instance, file)
    return with_settings(planned_parameters(system, instance, file, setting), settings)


def planned_parameters(system: System, instance: Instance, file: str, setting: int | None = None) -> BaseModel:
    """Plan a mission and return the parameters of its trials, with all that a map's missions switch on."""
    return with_values(parameters_of(system, setting, None, ()), mission_values(instance, file))


def refuse_what_arms_cannot_do(instance: Instance, file: str) -> None:
    """Refuse tasks that a schedule can hold and a swarm cannot do yet.

    Raises:
        UserError: naming file, task, field and value.
    """
    faults = [
        f"{file}: task {task.name!r}: robots = {task.robots}: an arm brings one robot to its task; leave robots away"
        for task in instance.tasks
        if task.robots > 1
    ]
    faults += [
        f"{file}: task {task.name!r}: needs = {sorted(task.needs)}: robots of a mission are all alike; leave needs away"
        for task in instance.tasks
        if task.needs
    ]
    if faults:
        raise UserError("\n".join(faults))


def mission_values(instance: Instance, file: str) -> dict[str, Any]:
    """Plan a mission and return it as parameters by dotted path; places are relative to the start.

    Raises:
        UserError: if the plan has more arms or slots than the swarm's messages and the master's chart have room for.
    """
    from formicarium.robots.footbot import ARMS
    from formicarium.scheduling.checker import check
    from formicarium.scheduling.solver import solve
    from formicarium.systems.coverage.memory import SLOTS

    answer = solve(instance, "travel", REACH, PLANNING_TIME)
    assert answer.schedule is not None  # every valid instance has one: a slot a task
    verdict = check(instance, answer.schedule, REACH, answer.time_limit)
    if verdict.faults:
        raise AssertionError(f"the checker refuses the schedule: {'; '.join(verdict.faults)}")
    slots = answer.schedule.slots
    for number, slot in enumerate(slots, 1):
        if len(slot.arms) > ARMS:
            raise UserError(
                f"{file}: slot {number} of the plan has {len(slot.arms)} tasks, a message has room for {ARMS} arms: "
                "give fewer robots, or say with 'after' which tasks come later"
            )
    if len(slots) > SLOTS:
        raise UserError(f"{file}: the plan has {len(slots)} slots, at most {SLOTS} can be flown: give more robots")
    return {
        "swarm.robots": instance.robots,
        "swarm.time_cap": SLOT_TIME * ATTEMPTS * len(slots),
        "tasks.attempts": ATTEMPTS,
        "tasks.programme": "mission",
        "tasks.erupt_limit": ERUPT_LIMIT,
        "behaviour.arm_choice": "quota",
        "behaviour.correction_limit": ERUPT_LIMIT,  # an arm without a robot must get one, however late
        "behaviour.rendezvous": "flocking",
        "behaviour.sweep_cycles": SWEEP_CYCLES,
        "behaviour.strays": "return",
        "behaviour.census_cycles": CENSUS_CYCLES,
        "behaviour.silence_cycles": SILENCE_CYCLES,
        "behaviour.agreed_cycles": 0,  # with messages lost a count is seldom whole, and never for long
        "mission.planning_range": instance.spacing,
        "mission.paths": instance.paths,
        "mission.region": _relative_region(instance),
        "mission.replans": REPLANS,
        "mission.slots": [_slot_values(instance, slot) for slot in slots],
    }


def _relative_region(instance: Instance) -> list[float]:
    (x, y), (x0, y0, x1, y1) = instance.start, instance.region
    return [x0 - x, y0 - y, x1 - x, y1 - y]


def _slot_values(instance: Instance, slot: Any) -> dict[str, Any]:
    x, y = instance.start
    tasks = {task.name: task for task in instance.tasks}
    return {
        "x": slot.x - x,
        "y": slot.y - y,
        "tasks": [
            {
                "name": arm.task,
                "x": tasks[arm.task].x - x,
                "y": tasks[arm.task].y - y,
                "duration": tasks[arm.task].duration,
                "robots": arm.relays + tasks[arm.task].robots,
                "after": [earlier for earlier, later in instance.priorities if later == arm.task],
            }
            for arm in slot.arms
        ],
    }


def print_missions(console: Console, rows: Sequence[Row]) -> None:
    """Print how many missions were done, how long they took beside the plan and in which phase, and who was lost."""
    numbers: list[dict[str, Any]] = [dict(row) for row in rows]
    done, runs = sum(row["mission_done"] for row in numbers), len(numbers)
    tasks, asked = sum(row["tasks_done"] for row in numbers), sum(row["tasks"] for row in numbers)
    whole = sum(row["lost_share_range"] == 0.0 for row in numbers)
    times = run_times([row["mission_s"] for row in numbers], [row["duration_s"] for row in numbers])
    phases = ", ".join(
        f"{name} {sum(row[f'{name}_s'] for row in numbers) / runs:.0f} s"
        for name in ("flock", "erupt", "hold", "gather")
    )
    console.print(f"missions  {done} of {runs} done, {tasks} of {asked} tasks", highlight=False)
    console.print(
        f"time      {in_words(times.median)} (median), {numbers[0]['planned_s']:g} s of them planned; {phases} (means)",
        highlight=False,
    )
    console.print(f"connected at every step: {whole} of {runs} runs", highlight=False)

"""A mission as the master is told of it: slots in their order, planned before the trial (ST-48)."""

from formicarium.robots.footbot import ARMS, TASKS
from formicarium.systems.coverage.memory import SLOTS, TALLIED
from formicarium.tables import Table, number


class PlannedTask(Table):
    """A task with its arm."""

    name: str = number("task", "1", "for people; robots know its number")
    x: float = number(0.0, "m", "ahead of where the master starts, as it heads")
    y: float = number(0.0, "m", "to the left of it")
    duration: float = number(20.0, "s", "for which a robot must stand at it", gt=0, le=1e5)
    robots: int = number(1, "1", "wanted in its arm, relays and those at the task", ge=1)
    after: tuple[str, ...] = number((), "1", "names of tasks that come in an earlier slot, also of a new plan")


class PlannedSlot(Table):
    """Tasks that are done at the same time round one point of deployment."""

    x: float = number(0.0, "m", "of the point, ahead of where the master starts")
    y: float = number(0.0, "m", "to the left of it")
    tasks: tuple[PlannedTask, ...] = number((), "1", "an arm each", min_length=1, max_length=ARMS)

    @property
    def duration(self) -> float:
        """Of its longest task, s."""
        return max(task.duration for task in self.tasks)

    @property
    def robots(self) -> int:
        """In all its arms."""
        return sum(task.robots for task in self.tasks)


class MissionTable(Table):
    """The plan of a mission, and with which reach it is made."""

    planning_range: float = number(
        1.0,
        "m",
        "metres of arm for each robot of it, where a map does not say (spacing): less than the fifth percentile of "
        "what arms of 2.4 m between robots reach, 1.3 m; the radio's 3 m cannot be flown [choice ST-56]",
        gt=0,
        le=10,
    )
    paths: int = number(1, "1", "Omega: robot-disjoint paths that each arm of a new plan has room for [paper]", ge=1)
    region: tuple[float, ...] = number(
        (), "m", "of a new plan's points: ahead and aside from, ahead and aside to; none: round tasks and swarm"
    )
    replans: int = number(
        0,
        "1",
        "new plans at most, of what is not done as far as the master knows, when a slot has ended so or a master has "
        "followed another; 0: none [paper; choice ST-72]",
        ge=0,
        le=50,
    )
    slots: tuple[PlannedSlot, ...] = number((), "1", "in the order in which they are done", max_length=SLOTS)

    @property
    def tasks(self) -> tuple[PlannedTask, ...]:
        """All tasks, in the order of slots and arms; the first has the number 1."""
        return tuple(task for slot in self.slots for task in slot.tasks)

    @property
    def duration(self) -> float:
        """Planned time in seconds, the sum of the slots; a plan knows no travel and no eruption."""
        return sum(slot.duration for slot in self.slots)


def check_mission(mission: MissionTable, programme: str, robots: int, silence_cycles: int = 0) -> None:
    """Refuse a plan that cannot be flown.

    Raises:
        ValueError: naming field and value, and what to do.
    """
    if programme != "mission" and mission.slots:
        raise ValueError(f"mission.slots is given, but tasks.programme = {programme!r}: set it to 'mission'")
    if programme == "mission" and not mission.slots:
        raise ValueError("tasks.programme = 'mission' without mission.slots: give a map (formicarium run --map FILE)")
    if len(mission.tasks) > TASKS:
        raise ValueError(f"mission.slots has {len(mission.tasks)} tasks: a mission has at most {TASKS}; make two of it")
    if silence_cycles > 0 and programme != "mission":
        raise ValueError(
            f"behaviour.silence_cycles = {silence_cycles}, but tasks.programme = {programme!r}: a master can only be "
            "followed in a mission; set silence_cycles to 0"
        )
    if len(mission.tasks) > TALLIED and (mission.replans > 0 or silence_cycles > 0):
        raise ValueError(
            f"mission.slots has {len(mission.tasks)} tasks, a swarm tells {TALLIED} apart that are done: make two "
            "missions of it, or set mission.replans and behaviour.silence_cycles to 0"
        )
    if mission.region and len(mission.region) != 4:
        raise ValueError(f"mission.region = {list(mission.region)}: must be four lengths, or none")
    names = {task.name for task in mission.tasks}
    for task in mission.tasks:
        for earlier in task.after:
            if earlier not in names:
                raise ValueError(f"mission.slots: task {task.name!r} is after {earlier!r}, but there is no such task")
    for number_of, slot in enumerate(mission.slots, 1):
        if slot.robots > robots - 1:
            raise ValueError(
                f"mission.slots[{number_of - 1}] wants {slot.robots} robots in its arms, swarm.robots = {robots} has "
                f"{robots - 1} beside the master: plan again for as many robots, or give more"
            )

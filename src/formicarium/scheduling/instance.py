"""What is to be scheduled: a swarm, its capabilities, an arena and tasks (Panerati et al. 2018, III-C)."""

from collections.abc import Mapping, Sequence
from typing import NamedTuple

MOST_ROBOTS = 1_000_000
MOST_HOPS = 10_000  # along a side of the region
FARTHEST = 1e7  # hops from the origin: farther off a place is not known to a thousandth of what a checker allows
LENGTHS = (1e-4, 1e6)  # of a hop, m: the checker counts in nanometres
DURATIONS = (1e-6, 1e9)


class InstanceError(ValueError):
    """An instance that cannot be scheduled; the message names the task or the field, and the reason."""


class Task(NamedTuple):
    """Something to be done at a place by several robots at once."""

    name: str
    x: float  # m
    y: float  # m
    robots: int = 1  # beta: that must stand at the task together, besides the relays that lead there
    duration: float = 1.0  # delta, in any unit of time, the same for all tasks
    needs: frozenset[str] = frozenset()  # capabilities that each of those robots must have


class Team(NamedTuple):
    """Robots with the same capabilities (a configuration class)."""

    robots: int
    abilities: frozenset[str] = frozenset()


class Instance(NamedTuple):
    """A problem: the swarm, the arena, the tasks and which of them come before others."""

    name: str
    teams: tuple[Team, ...]
    tasks: tuple[Task, ...]
    region: tuple[float, float, float, float]  # where the master may stand: x from, y from, x to, y to; m
    start: tuple[float, float]  # Theta_0, where the swarm is before the first slot; m
    priorities: tuple[tuple[str, str], ...] = ()  # (a, b): a is done in an earlier slot than b
    spacing: float = 1.0  # Gamma: one hop of an arm, m
    paths: int = 1  # Omega: robot-disjoint paths between the master and each task

    @property
    def robots(self) -> int:
        """All robots, the master included (|N|)."""
        return sum(team.robots for team in self.teams)

    def able(self, task: Task) -> list[int]:
        """Return the numbers of the teams whose robots can do a task."""
        return [number for number, team in enumerate(self.teams) if task.needs <= team.abilities]


def checked(instance: Instance, source: str = "instance") -> Instance:
    """Return an instance that can be scheduled: every single task is feasible with the master beside it.

    Raises:
        InstanceError: naming every task or field that is wrong, and why.
    """
    faults = [*_faults_of_swarm(instance), *_faults_of_tasks(instance), *_faults_of_priorities(instance)]
    if faults:
        raise InstanceError("\n".join(f"{source}: {fault}" for fault in faults))
    return instance


def is_number(value: object, kind: type) -> bool:
    """Tell whether a value is a number of a kind, Python's or NumPy's; True and False are none."""
    return isinstance(value, kind) and not isinstance(value, bool)


def _finite(value: float) -> bool:
    return value - value == 0.0


def _faults_of_swarm(instance: Instance) -> list[str]:
    faults = []
    if not instance.tasks:
        faults.append("there is no task: list at least one under 'tasks'")
    if instance.robots < 2:
        faults.append(f"the swarm has {instance.robots} robots: a master and at least one more are needed")
    if instance.robots > MOST_ROBOTS:
        faults.append(f"the swarm has {instance.robots} robots: at most {MOST_ROBOTS} can be scheduled")
    faults += [
        f"team {k + 1} has {t.robots} robots: must be at least 1" for k, t in enumerate(instance.teams) if t.robots < 1
    ]
    if not LENGTHS[0] <= instance.spacing <= LENGTHS[1]:
        faults.append(f"spacing = {instance.spacing}: must be a length from {LENGTHS[0]:g} to {LENGTHS[1]:g} m")
    if not 1 <= instance.paths <= MOST_ROBOTS:
        faults.append(f"paths = {instance.paths}: must be from 1 to {MOST_ROBOTS}")
    x0, y0, x1, y1 = instance.region
    if not all(map(_finite, instance.region)) or x0 > x1 or y0 > y1:
        faults.append(f"region = {list(instance.region)}: must be [x from, y from, x to, y to], in metres")
    elif LENGTHS[0] <= instance.spacing <= LENGTHS[1] and (
        max(x1 - x0, y1 - y0) > MOST_HOPS * instance.spacing
        or max(map(abs, instance.region)) > FARTHEST * instance.spacing
    ):
        faults.append(
            f"region = {list(instance.region)}: at most {MOST_HOPS} hops of {instance.spacing:g} m long and wide, and "
            f"no more than {FARTHEST:g} hops from (0, 0): move the origin, or mend spacing"
        )
    elif not (all(map(_finite, instance.start)) and x0 <= instance.start[0] <= x1 and y0 <= instance.start[1] <= y1):
        faults.append(f"start = {list(instance.start)}: must lie in the region {list(instance.region)}")
    return faults


def _faults_of_tasks(instance: Instance) -> list[str]:
    faults = []
    names = [task.name for task in instance.tasks]
    faults += [f"task {name!r} is there twice: give every task a name of its own" for name in _twice(names)]
    x0, y0, x1, y1 = instance.region
    for task in instance.tasks:
        said = f"task {task.name!r}"
        if not task.name:
            faults.append("a task has an empty name")
        elif not task.name.isprintable():
            faults.append(f"{said}: its name has characters that cannot be printed")
        if not (_finite(task.x) and _finite(task.y)):
            faults.append(f"{said}: place ({task.x}, {task.y}) is no place")
        elif _finite(sum(instance.region)) and not (x0 <= task.x <= x1 and y0 <= task.y <= y1):
            faults.append(f"{said}: place ({task.x:g}, {task.y:g}) is outside the region {list(instance.region)}")
        if not DURATIONS[0] <= task.duration <= DURATIONS[1]:
            faults.append(f"{said}: duration = {task.duration}: must be from {DURATIONS[0]:g} to {DURATIONS[1]:g}")
        if task.robots < 1:
            faults.append(f"{said}: robots = {task.robots}: must be at least 1")
            continue
        capable = sum(instance.teams[k].robots for k in instance.able(task))
        if capable == 0:
            known = frozenset().union(*(team.abilities for team in instance.teams))
            unknown = sorted(task.needs - known)
            why = f"no robot has {unknown[0]!r}" if unknown else f"no robot has {_listed(task.needs)} together"
            faults.append(f"{said}: nobody can do it: {why}")
        elif task.robots > capable:
            faults.append(f"{said}: needs {task.robots} robots with {_listed(task.needs)}, there are {capable}")
        elif task.robots > instance.robots - 1:
            faults.append(
                f"{said}: needs {task.robots} robots, but only {instance.robots - 1} of {instance.robots} can leave "
                "the centre: one is the master"
            )
    return faults


def _listed(needs: frozenset[str]) -> str:
    return " and ".join(map(repr, sorted(needs))) or "any ability"


def _twice(names: Sequence[str]) -> list[str]:
    return sorted({name for name in names if names.count(name) > 1}) if len(set(names)) < len(names) else []


def _faults_of_priorities(instance: Instance) -> list[str]:
    names = {task.name for task in instance.tasks}
    faults = [
        f"task {pair[1 - k]!r} is to be done {('after', 'before')[k]} {pair[k]!r}, but there is no such task"
        for pair in instance.priorities
        for k in (0, 1)
        if pair[k] not in names
    ]
    if not faults and (cycle := _cycle(instance.priorities)):
        faults.append(f"priorities go in a circle: {' before '.join(map(repr, cycle))}")
    return faults


def _cycle(pairs: Sequence[tuple[str, str]]) -> list[str]:
    """Return names of a circle of priorities, the first one again at its end, or nothing."""
    left: Mapping[str, set[str]] = {}
    successors = {name: {b for a, b in pairs if a == name} for name in {name for pair in pairs for name in pair}}
    left = dict(successors)
    while ends := [name for name, after in left.items() if not after & left.keys()]:
        left = {name: after for name, after in left.items() if name not in ends}
    if not left:
        return []
    walk = [min(left)]
    while walk.count(walk[-1]) < 2:
        walk.append(min(successors[walk[-1]] & left.keys()))
    return walk[walk.index(walk[-1]) :]

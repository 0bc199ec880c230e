"""Instances in files: TOML, JSON, or CSV with one task a line."""

import csv
import json
import tomllib
from pathlib import Path
from typing import Annotated, Any

from pydantic import BaseModel, ConfigDict, Field, ValidationError

from formicarium.scheduling.instance import Instance, InstanceError, Task, Team, checked

Names = Annotated[list[str], Field(default_factory=list)]


class _Strict(BaseModel):
    model_config = ConfigDict(extra="forbid", allow_inf_nan=True)


class _Team(_Strict):
    robots: int
    abilities: Names


class _Task(_Strict):
    name: str
    x: float
    y: float
    robots: int = 1
    duration: float = 1.0
    needs: Names
    after: Names


class _File(_Strict):
    name: str = ""
    spacing: float | None = None
    paths: int = 1
    region: tuple[float, float, float, float] | None = None
    start: tuple[float, float] | None = None
    teams: list[_Team] = Field(default_factory=list)
    tasks: list[_Task] = Field(default_factory=list)


def read_instance(path: str | Path, robots: int | None = None, spacing: float = 1.0) -> Instance:
    """Read an instance from a .toml, .json or .csv file.

    Args:
        path: of the file.
        robots: the swarm, all robots able to do everything; for files that list no teams.
        spacing: one hop of an arm, m, for files that do not say.

    Raises:
        InstanceError: naming file, task or field, and what is wrong.
    """
    path = Path(path)
    readers = {".toml": _read_toml, ".json": _read_json, ".csv": _read_csv}
    if path.suffix.lower() not in readers:
        raise InstanceError(f"{path}: must end in .toml, .json or .csv")
    try:
        content = readers[path.suffix.lower()](path)
    except OSError as error:
        raise InstanceError(f"{path}: cannot be read: {error.strerror}") from error
    except (ValueError, csv.Error) as error:
        raise InstanceError(f"{path}: is no {path.suffix[1:].upper()} file: {error}") from error
    return instance_of(content, str(path), robots, spacing)


def instance_of(content: Any, source: str = "instance", robots: int | None = None, spacing: float = 1.0) -> Instance:
    """Check an instance given as plain values, as a file would hold it. Raises as ``read_instance``."""
    if not content:
        raise InstanceError(f"{source}: is empty: list the tasks, each with name, x and y, and the teams")
    try:
        found = _File.model_validate(content)
    except ValidationError as error:
        told = dict.fromkeys(_in_words(problem, content) for problem in error.errors())
        raise InstanceError("\n".join(f"{source}: {line}" for line in told)) from error
    if robots is not None and found.teams:
        raise InstanceError(f"{source}: lists teams, so the number of robots cannot be given beside it")
    if robots is None and not found.teams:
        raise InstanceError(f"{source}: says nothing of the robots: list teams, or give their number (--robots)")
    tasks = tuple(Task(t.name, t.x, t.y, t.robots, t.duration, frozenset(t.needs)) for t in found.tasks)
    everything = frozenset().union(*(task.needs for task in tasks)) if tasks else frozenset()
    teams = tuple(Team(team.robots, frozenset(team.abilities)) for team in found.teams)
    instance = Instance(
        name=found.name or Path(source).stem,
        teams=teams or (Team(robots or 0, everything),),
        tasks=tasks,
        region=found.region or _around(tasks, found.start),
        start=found.start or _middle(found.region or _around(tasks, None)),
        priorities=tuple((earlier, task.name) for task in found.tasks for earlier in task.after),
        spacing=spacing if found.spacing is None else found.spacing,
        paths=found.paths,
    )
    return checked(instance, source)


def as_content(instance: Instance) -> dict[str, Any]:
    """Return an instance as plain values that ``instance_of`` reads back."""
    before: dict[str, list[str]] = {}
    for first, second in instance.priorities:
        before.setdefault(second, []).append(first)
    return {
        "name": instance.name,
        "spacing": instance.spacing,
        "paths": instance.paths,
        "region": list(instance.region),
        "start": list(instance.start),
        "teams": [{"robots": team.robots, "abilities": sorted(team.abilities)} for team in instance.teams],
        "tasks": [
            {**task._asdict(), "needs": sorted(task.needs), "after": before.get(task.name, [])}
            for task in instance.tasks
        ],
    }


def _read_toml(path: Path) -> Any:
    return tomllib.loads(path.read_text(encoding="utf-8"))


def _read_json(path: Path) -> Any:
    text = path.read_text(encoding="utf-8")
    content = json.loads(text) if text.strip() else {}
    if not isinstance(content, dict):
        raise ValueError("must be an object with teams and tasks")
    return content


def _read_csv(path: Path) -> Any:
    """Read tasks, one a line: name, x, y and, if wanted, robots, duration, needs and after (names, with spaces)."""
    with path.open(encoding="utf-8", newline="") as file:
        lines = list(csv.DictReader(file))
    tasks = []
    for number, line in enumerate(lines, 2):
        if None in line or None in line.values():
            raise ValueError(f"line {number} has another number of fields than the first line")
        task: dict[str, Any] = {name.strip(): value.strip() for name, value in line.items() if value.strip()}
        task.update({name: task[name].split() for name in ("needs", "after") if name in task})
        tasks.append(task)
    return {"tasks": tasks} if tasks else {}


def _around(tasks: tuple[Task, ...], start: tuple[float, float] | None) -> tuple[float, float, float, float]:
    places = [(task.x, task.y) for task in tasks] + ([start] if start else [])
    if not places:
        return (0.0, 0.0, 0.0, 0.0)
    xs, ys = zip(*places)
    return (min(xs), min(ys), max(xs), max(ys))


def _middle(region: tuple[float, float, float, float]) -> tuple[float, float]:
    return (0.5 * (region[0] + region[2]), 0.5 * (region[1] + region[3]))


def _in_words(problem: Any, content: Any) -> str:
    where = [step for step in problem["loc"] if not (isinstance(step, str) and "[" in step)]
    place = "".join(f"[{step}]" if isinstance(step, int) else f".{step}" for step in where).lstrip(".")
    if len(where) > 1 and where[0] == "tasks":
        task = content["tasks"][where[1]]
        name = task.get("name") if isinstance(task, dict) else None
        place = f"task {name!r}: {'.'.join(map(str, where[2:])) or 'entry'}" if name else place
    if problem["type"] == "extra_forbidden":
        return f"{place}: there is no such field"
    if problem["type"] == "missing":
        return f"{place}: is missing"
    return f"{place} = {problem['input']!r}: {problem['msg'][:1].lower()}{problem['msg'][1:]}"

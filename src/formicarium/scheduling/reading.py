"""Instances in files: TOML, JSON, or CSV with one task a line."""

import csv
import json
import math
import reprlib
import tomllib
from pathlib import Path
from typing import Annotated, Any

from pydantic import BaseModel, BeforeValidator, ConfigDict, Field, ValidationError

from formicarium.scheduling.instance import Instance, InstanceError, Task, Team, checked


def _no_truth(value: Any) -> Any:
    if isinstance(value, bool | str):
        raise ValueError("must be a number")
    if isinstance(value, int) and abs(value) > LARGEST:
        raise ValueError(f"must be a number of at most {LARGEST:g}")
    return value


Names = Annotated[list[str], Field(default_factory=list)]
Real = Annotated[float, BeforeValidator(_no_truth)]
Count = Annotated[int, BeforeValidator(_no_truth)]


LARGEST = 10**300
ENCODING = "utf-8-sig"  # a byte order mark, as spreadsheets write it, is passed over


class _Strict(BaseModel):
    model_config = ConfigDict(extra="forbid", allow_inf_nan=True)


class _Team(_Strict):
    robots: Count
    abilities: Names


class _Task(_Strict):
    name: str
    x: Real
    y: Real
    robots: Count = 1
    duration: Real = 1.0
    needs: Names
    after: Names


class _File(_Strict):
    name: str = ""
    spacing: Real | None = None
    paths: Count = 1
    region: tuple[Real, Real, Real, Real] | None = None
    start: tuple[Real, Real] | None = None
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
    except RecursionError as error:
        raise InstanceError(f"{path}: is nested too deeply: no instance needs more than four levels") from error
    except UnicodeDecodeError as error:
        raise InstanceError(f"{path}: is not in UTF-8: save it as UTF-8") from error
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
    return tomllib.loads(path.read_text(encoding=ENCODING))


def _read_json(path: Path) -> Any:
    text = path.read_text(encoding=ENCODING)
    content = json.loads(text, object_pairs_hook=_once) if text.strip() else {}
    if not isinstance(content, dict):
        raise ValueError("must be an object with teams and tasks")
    return content


def _once(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    """Return an object's fields, each given once."""
    content = dict(pairs)
    if len(content) < len(pairs):
        raise ValueError(f"{_twice([name for name, _ in pairs])!r} is given twice in one object")
    return content


def _twice(names: list[str]) -> str:
    return next(name for name in names if names.count(name) > 1)


def _read_csv(path: Path) -> Any:
    """Read tasks, one a line: name, x, y and, if wanted, robots, duration, needs and after.

    Several names in needs or after are parted by semicolons, or by spaces where there is no semicolon.
    """
    with path.open(encoding=ENCODING, newline="") as file:
        reader = csv.reader(file)
        lines = [(reader.line_num, _without_empty_ends(line)) for line in reader]
    (_, names), *lines = [(number, line) for number, line in lines if line] or [(0, [])]
    if len(names) == 1 and (other := next((mark for mark in ";\t" if mark in names[0]), None)):
        raise ValueError(f"its columns are parted by {other!r}: save it with commas")
    if "" in names:
        raise ValueError("a column has no name in the first line")
    if len(set(names)) < len(names):
        raise ValueError(f"the column {_twice(names)!r} is there twice")
    if lines and (lacking := {"name", "x", "y"} - set(names)):
        raise ValueError(f"the first line must name the columns name, x and y; it lacks {', '.join(sorted(lacking))}")
    tasks = []
    for number, line in lines:
        if len(line) > len(names):
            raise ValueError(f"line {number} has more fields than the first line")
        task: dict[str, Any] = {name: value for name, value in zip(names, line) if value}
        for name in ("needs", "after"):
            if name in task:
                parted = task[name].split(";" if ";" in task[name] else None)
                task[name] = [word.strip() for word in parted if word.strip()]
        for name, kind in (("x", float), ("y", float), ("duration", float), ("robots", int)):
            if name in task:
                try:
                    task[name] = kind(task[name].replace("_", "?"))  # Python alone takes 1_0 for a number
                except ValueError as error:
                    said = "whole number" if kind is int else "number"
                    raise ValueError(f"line {number}: {name} = {task[name]!r}: must be a {said}") from error
        tasks.append(task)
    return {"tasks": tasks} if tasks else {}


def _without_empty_ends(line: list[str]) -> list[str]:
    """Return the fields of a line up to the last one with content; spreadsheets write commas beyond."""
    fields = [field.strip() for field in line]
    while fields and not fields[-1]:
        fields.pop()
    return fields


def _around(tasks: tuple[Task, ...], start: tuple[float, float] | None) -> tuple[float, float, float, float]:
    places = [(task.x, task.y) for task in tasks] + ([start] if start else [])
    places = [place for place in places if math.isfinite(sum(place))]  # what is no place is told as the task's fault
    if not places:
        return (0.0, 0.0, 0.0, 0.0)
    xs, ys = zip(*places)
    return (min(xs), min(ys), max(xs), max(ys))


def _middle(region: tuple[float, float, float, float]) -> tuple[float, float]:
    return (0.5 * (region[0] + region[2]), 0.5 * (region[1] + region[3]))


def _short(value: Any) -> str:
    return "a whole number" if isinstance(value, int) and abs(value) > LARGEST else reprlib.repr(value)


def _in_words(problem: Any, content: Any) -> str:
    where = [step for step in problem["loc"] if not (isinstance(step, str) and step.endswith("]"))]
    place = "".join(f"[{step}]" if isinstance(step, int) else f".{step}" for step in where).lstrip(".")
    if len(where) > 1 and where[0] == "tasks":
        task = list(content["tasks"])[where[1]]
        name = task.get("name") if isinstance(task, dict) else None
        place = f"task {name!r}: {'.'.join(map(str, where[2:])) or 'entry'}" if name else place
    place = place or ("''" if where else "content")
    if problem["type"] == "extra_forbidden":
        return f"{place}: there is no such field"
    if problem["type"] == "missing":
        return f"{place}: is missing"
    said = problem["msg"].removeprefix("Value error, ")
    return f"{place} = {_short(problem['input'])}: {said[:1].lower()}{said[1:]}"

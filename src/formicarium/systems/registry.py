"""The register of systems: name -> "module:object", resolved only when asked for.

A reader's own package registers in the entry-point group ``formicarium.systems``. Whoever stands in the folder of
such a package need not install it: what its pyproject.toml announces is known there.
"""

import sys
import tomllib
import traceback
from collections.abc import Callable, Mapping
from importlib import import_module
from importlib.metadata import entry_points
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from pydantic import BaseModel

from formicarium.sources import INSTALLED, PACKAGE
from formicarium.trial.onboard import Onboard
from formicarium.trial.record import Timeline, Trial
from formicarium.trial.watching import Watching

BUILT_IN = {
    "mark-i3": "formicarium.systems.sequencing.study:MARK_I3",
    "mark-i4": "formicarium.systems.sequencing.study:MARK_I4",
    "mark-ii3": "formicarium.systems.sequencing.study:MARK_II3",
    "mark-ii4": "formicarium.systems.sequencing.study:MARK_II4",
    "partitioning": "formicarium.systems.partitioning.study:PARTITIONING",
    "coverage": "formicarium.systems.coverage.study:COVERAGE",
}
GROUP = "formicarium.systems"


class Targets(NamedTuple):
    """Columns of the outcome row that hold times, for run-time distributions."""

    columns: Mapping[str, str]  # outcome column -> label ("time_10_s" -> "10 sequences")
    published: Mapping[str, tuple[float, ...]]  # outcome column -> the paper's run times, seconds; inf = not reached
    published_label: str  # what the published curve is ("10 runs of 20 e-pucks, Garattoni & Birattari 2018")
    published_cap: float  # seconds after which the published runs were ended


class System(NamedTuple):
    """A swarm experiment that can be run, swept, drawn and tested without knowing what it is."""

    name: str
    summary: str  # one line, for listings and --help
    parameters: type[BaseModel]  # nested groups of named numbers with unit, source and bounds
    configure: Callable[..., BaseModel]  # (setting: int | None, robots: int | None) -> parameters
    run: Callable[..., Trial]  # (parameters, seed, *, frames_every: float | None, watch: Callable | None) -> Trial
    kinds: tuple[str, ...]  # names of the event kinds, in the order of their numbers
    targets: Targets
    timeline: Callable[[Trial], Timeline]  # what the timeline figure shows
    # The same trial cycle by cycle, for tests, debuggers and viewers. A state is a NamedTuple of record arrays with
    # the names that trial/phases.py uses (clock, world, robots, readings, commands, memories, lights, events).
    begin: Callable[..., Any] | None = None  # (parameters, seed, *, storage) -> state before the first cycle
    advance: Callable[[Any, int], None] | None = None  # (state, cycles): the compiled loop
    roles: Callable[[Any], np.ndarray] | None = None  # state -> (N,) role numbers as in Scene.roles
    watching: Watching | None = None  # how it is shown and touched; None if it cannot be watched
    onboard: Onboard | None = None  # its loop taken apart, for controllers in processes of their own
    home: str | None = None  # module whose package holds its sources; that of ``run`` if not given
    # (parameters, seed, last good cycle, error, failures injected) -> the error in words: file, line, robot and cycle
    explained: Callable[..., Exception] | None = None


class UnknownSystem(LookupError):
    """No system of that name is registered."""


class BrokenSystem(UnknownSystem):
    """A system is there but its code cannot be imported; names file and line."""


def broken(name: str, error: Exception) -> str:
    """Say where the code of a system fails while it is imported."""
    if isinstance(error, SyntaxError):
        place = f"{error.filename}, line {error.lineno}"
    else:
        frames = [frame for frame in traceback.extract_tb(error.__traceback__) if not frame.filename.startswith("<")]
        place = f"{frames[-1].filename}, line {frames[-1].lineno}"
        own = [frame for frame in frames if not Path(frame.filename).is_relative_to(PACKAGE)]
        own = [frame for frame in own if not INSTALLED & set(Path(frame.filename).parts)]
        own = [frame for frame in own if Path(frame.filename).parent.name != "importlib"]
        if own:
            place = f"{own[-1].filename}, line {own[-1].lineno}"
    return f"the system {name!r} cannot be imported: {place}: {type(error).__name__}: {error}"


def names() -> list[str]:
    """Return the names of all registered systems, sorted."""
    try:
        here = announced_here()
    except UnknownSystem:  # told by whoever asks for one of them
        here = {}
    return sorted({*BUILT_IN, *here, *(point.name for point in entry_points(group=GROUP))})


def announced_here() -> dict[str, str]:
    """Return the systems that the pyproject.toml of the current folder announces: name -> "module:object".

    Raises:
        UnknownSystem: if the file is no TOML.
    """
    try:
        content = tomllib.loads(Path("pyproject.toml").read_text(encoding="utf-8"))
    except (OSError, UnicodeDecodeError):
        return {}
    except tomllib.TOMLDecodeError as error:
        raise UnknownSystem(f"pyproject.toml of this folder is no TOML: {error}") from error
    found = content.get("project", {}).get("entry-points", {}).get(GROUP, {})
    return {str(name): str(place) for name, place in found.items()} if isinstance(found, dict) else {}


def resolve(name: str) -> System:
    """Return the system called ``name``; "module:object" names one that is not registered.

    After a "+" the name may go on with failures, see ``systems/failing.py``.

    Raises:
        UnknownSystem: if nothing is registered under that name; the message lists what is.
    """
    if "+" in name:
        plain, *failures = name.split("+")
        return import_module("formicarium.systems.failing").failing(resolve(plain), failures)
    if name in BUILT_IN:
        module, attribute = BUILT_IN[name].split(":")
        return getattr(import_module(module), attribute)
    if place := announced_here().get(name):
        here = str(Path.cwd())
        if here not in sys.path:
            sys.path.insert(0, here)  # first: who stands in the folder means its files, not an installed copy
        return _unregistered(place)
    for point in entry_points(group=GROUP):
        if point.name == name:
            return point.load()
    if ":" in name:
        return _unregistered(name)
    raise UnknownSystem(f"unknown system {name!r}; registered systems: {', '.join(names())}")


def _unregistered(name: str) -> System:
    module, _, attribute = name.partition(":")
    try:
        system = getattr(import_module(module), attribute)
    except (AttributeError, ModuleNotFoundError, TypeError, ValueError) as error:
        if isinstance(error, ModuleNotFoundError) and not f"{module}.".startswith(f"{error.name}."):
            raise BrokenSystem(broken(name, error)) from error  # it is there, something that it imports is not
        if len(traceback.extract_tb(error.__traceback__)) > 1 and not isinstance(error, ModuleNotFoundError):
            raise BrokenSystem(broken(name, error)) from error
        raise UnknownSystem(f"there is no system {name!r}: {error}") from error
    except Exception as error:
        raise BrokenSystem(broken(name, error)) from error
    if not isinstance(system, System):
        raise UnknownSystem(f"{name!r} is no system but a {type(system).__name__}")
    return system

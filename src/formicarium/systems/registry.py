"""The register of systems: name -> "module:object", resolved only when asked for.

A reader's own package registers in the entry-point group ``formicarium.systems``.
"""

from collections.abc import Callable, Mapping
from importlib import import_module
from importlib.metadata import entry_points
from typing import Any, NamedTuple

import numpy as np
from pydantic import BaseModel

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


class UnknownSystem(LookupError):
    """No system of that name is registered."""


def names() -> list[str]:
    """Return the names of all registered systems, sorted."""
    return sorted({*BUILT_IN, *(point.name for point in entry_points(group=GROUP))})


def resolve(name: str) -> System:
    """Return the system called ``name``; "module:object" names one that is not registered.

    Raises:
        UnknownSystem: if nothing is registered under that name; the message lists what is.
    """
    if name in BUILT_IN:
        module, attribute = BUILT_IN[name].split(":")
        return getattr(import_module(module), attribute)
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
            raise  # the module is there, something that it imports is not
        raise UnknownSystem(f"there is no system {name!r}: {error}") from error
    if not isinstance(system, System):
        raise UnknownSystem(f"{name!r} is no system but a {type(system).__name__}")
    return system

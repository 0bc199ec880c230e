"""What a viewer may know of a system, and what a person may do to a trial: any system shows through these alone."""

from collections.abc import Callable, Mapping
from typing import Any, NamedTuple

from formicarium.trial.film import Film
from formicarium.trial.record import Scene


class Section(NamedTuple):
    """A small table about one robot."""

    title: str  # "reading", "memory"
    columns: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]  # a text for every column


class Inspection(NamedTuple):
    """What one robot sees, thinks, says and hears."""

    identity: int
    summary: str  # one line: role and state
    sections: tuple[Section, ...]


class Intervention(NamedTuple):
    """What a person did to a running trial; the only thing besides parameters and seed that decides it."""

    cycle: int  # done before this control cycle
    deed: str  # "move", "kill", "block" or "unblock"
    subject: int  # identity of the robot; number of the device as the Scene's devices are numbered, from 0
    x: float = 0.0  # metres, where a robot was put
    y: float = 0.0


class Impossible(ValueError):
    """An intervention cannot be done; says why."""


class Watching(NamedTuple):
    """How a system is shown and touched. Beside its ``begin`` and ``advance`` a viewer needs nothing else of it."""

    scene: Callable[[Any, Any], Scene]  # (parameters, state) -> what does not move
    shoot: Callable[[Any, Film], None]  # (state, film): compiled; takes one moment
    roll: Callable[[Any, int, int, Film], None]  # (state, cycles, every, film): advance, shoot every so many cycles
    inspect: Callable[[Any, int], Inspection]  # (state, identity) -> what is in that robot
    tell: Callable[[Any], str]  # EVENT -> one sentence
    intervene: Callable[[Any, Intervention], None]  # changes the state, or raises Impossible and leaves it
    outcome: Callable[[Any, Any, Any], Mapping[str, Any]]  # (parameters, state, events) -> row, as ``run`` gives it
    blockable: bool = True  # whether its devices are booths that a person may block

"""What a trial leaves behind: events, frames and one outcome row. Views and campaigns know only these."""

from collections.abc import Mapping
from typing import NamedTuple

import numpy as np

# One thing that happened, written by the compiled loop; ``kind`` numbers the system's EventKind.
EVENT = np.dtype(
    [
        ("cycle", "i8"),  # control cycle, 0 at the start of the trial
        ("kind", "i8"),  # the system's EventKind
        ("robot", "i8"),  # identity of the robot it happened to, 0 if none
        ("subject", "i8"),  # what it is about: another robot's identity, a task colour, a branch
        ("value", "i8"),  # number that goes with the kind (new role, verdict, count)
        ("detail", "i8"),  # a second number
    ],
    align=True,
)


FLOOR = "floor "  # with the shade after it, 0 black .. 1 white: the colour of a patch of floor
OBJECT = "object"  # the colour of a place that holds a thing or does not; lit while it does


class Polygon(NamedTuple):
    """A closed outline on the floor."""

    points: np.ndarray  # (K, 2) metres
    colour: str  # a name that the views know ("wall", "red", "green", "blue", "orange"), or one of those above


class Scene(NamedTuple):
    """What does not move: drawn once under all frames."""

    polygons: tuple[Polygon, ...]
    radius: float  # of the robots, metres
    roles: tuple[str, ...]  # names of the role numbers in the frames, for legends
    cycle_time: float  # seconds
    ranges: tuple[tuple[str, float], ...] = ()  # names and reaches of the robots' senses, metres, to be drawn
    load: str = ""  # what robots carry ("object"), drawn on who carries; if empty, the carried number is written there
    number: str = "tasks\ndone so far"  # what the carried number is, for legends

    @property
    def devices(self) -> tuple[Polygon, ...]:
        """Everything that is neither wall nor floor, in the order of ``Frames.lit``."""
        return tuple(p for p in self.polygons if p.colour != "wall" and not p.colour.startswith(FLOOR))

    @property
    def longest_link(self) -> float:
        """Length up to which a link between two robots is drawn, metres: 18 radii, or the radio's reach if longer."""
        return max([18 * self.radius, *(reach for name, reach in self.ranges if name == "radio")])


class Frames(NamedTuple):
    """Snapshots of all robots at F chosen cycles; N robots, in the order of their identities."""

    cycle: np.ndarray  # (F,) int64
    x: np.ndarray  # (F, N) float32, metres
    y: np.ndarray  # (F, N) float32, metres
    heading: np.ndarray  # (F, N) float32, radians, counter-clockwise from the x axis
    role: np.ndarray  # (F, N) int8, index into Scene.roles
    carried: np.ndarray  # (F, N) int8, a small number the system wants shown on the robot (tasks done so far)
    lit: np.ndarray  # (F, B) int8 of the Scene's devices: 0 dark, 1 its lights are on, 2 they show red instead
    identity: np.ndarray  # (N,) int64
    colour: np.ndarray | None = None  # (F, N) int8, Colour of each robot's lights
    joined: np.ndarray | None = None  # (F, N) int16, column of the robot that each is linked to, -1 for none


class Trial(NamedTuple):
    """All of one finished trial."""

    outcome: Mapping[str, int | float | str | bool | None]  # one row; only what seed and parameters decide
    events: np.ndarray  # (E,) EVENT, sorted by cycle, robot, kind
    frames: Frames | None
    scene: Scene


class Span(NamedTuple):
    """One robot in one role for a while: a bar of the timeline."""

    lane: int  # row, 0 at the bottom
    start: float  # seconds
    end: float  # seconds
    role: int  # index into Scene.roles


class Timeline(NamedTuple):
    """Who was what when, and what was achieved: everything the timeline figure shows."""

    lanes: tuple[str, ...]  # one label a robot
    spans: tuple[Span, ...]
    marks: tuple[tuple[float, str], ...]  # (seconds, label): chain events, task verdicts
    counts: tuple[float, ...]  # times at which one more sequence was complete, seconds
    duration: float  # seconds

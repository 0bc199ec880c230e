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


FLOOR = "floor "  # colour of a patch of floor: this and its shade, 0 black .. 1 white


class Polygon(NamedTuple):
    """A closed outline on the floor."""

    points: np.ndarray  # (K, 2) metres
    colour: str  # a name that the views know ("wall", "red", "green", "blue", "orange", "floor 0.62")

    @property
    def is_device(self) -> bool:
        """Tell whether it is something robots work with: neither a wall nor a patch of floor."""
        return self.colour != "wall" and not self.colour.startswith(FLOOR)


class Scene(NamedTuple):
    """What does not move: drawn once under all frames."""

    polygons: tuple[Polygon, ...]
    radius: float  # of the robots, metres
    roles: tuple[str, ...]  # names of the role numbers in the frames, for legends
    cycle_time: float  # seconds
    ranges: tuple[tuple[str, float], ...] = ()  # names and reaches of the robots' senses, metres, to be drawn


class Frames(NamedTuple):
    """Snapshots of all robots at F chosen cycles; N robots, in the order of their identities."""

    cycle: np.ndarray  # (F,) int64
    x: np.ndarray  # (F, N) float32, metres
    y: np.ndarray  # (F, N) float32, metres
    heading: np.ndarray  # (F, N) float32, radians, counter-clockwise from the x axis
    role: np.ndarray  # (F, N) int8, index into Scene.roles
    carried: np.ndarray  # (F, N) int8, a small number the system wants shown on the robot (tasks done so far)
    lit: np.ndarray  # (F, B) int8, 1 while the lights of device b are on; devices in the order of the Scene
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

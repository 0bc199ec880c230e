"""An arena as plain values, from Python or from a TOML file: walls, obstacles, booths, lamps and floor.

Metres and degrees, x to the right, y up, angles counter-clockwise::

    outline = [[-1, -1], [1, -1], [1, 1], [-1, 1]]   # the outer wall, corner by corner
    start = [-0.5, -0.5, 0.5, 0.5]                   # where robots begin: left, bottom, right, top

    [[obstacle]]
    corners = [[0.2, 0.2], [0.4, 0.2], [0.3, 0.4]]
    [[wall]]
    line = [[-0.5, 0.5], [0.0, 0.5]]
    [[booth]]
    at = [0.6, -0.6]
    direction = 0                                    # into its bay
    colour = "red"
    [[lamp]]
    at = [0, 0]
    [[floor]]
    rectangle = [-1, -1, 0, 1]
    shade = 0.5                                      # 0 black .. 1 white
"""

import math
import tomllib
from itertools import pairwise
from pathlib import Path
from typing import Annotated, Any, Literal

import numpy as np
from pydantic import BaseModel, BeforeValidator, ConfigDict, Field, ValidationError, field_validator

from formicarium.devices.booth import booth_outline
from formicarium.physics.floor import patches
from formicarium.physics.scenery import WALL_FRICTION, chain, joined, outline
from formicarium.tables import Table, number

Place = tuple[float, float]
Rectangle = tuple[float, float, float, float]  # left, bottom, right, top (m)
WIDEST = 100.0  # m from the origin


class _Part(BaseModel):
    model_config = ConfigDict(extra="forbid", frozen=True, validate_default=True, allow_inf_nan=False)


class Obstacle(_Part):
    """A solid block that hides what is behind it."""

    corners: tuple[Place, ...] = Field(min_length=3)


class Wall(_Part):
    """A thin wall along a line of two points or more, as high as an obstacle."""

    line: tuple[Place, ...] = Field(min_length=2)
    thickness: float = Field(0.01, ge=0.002, le=1)  # m

    @field_validator("line")
    @classmethod
    def _drawn(cls, line: tuple[Place, ...]) -> tuple[Place, ...]:
        if any(start == end for start, end in pairwise(line)):
            raise ValueError("has two equal points in a row")
        return line


class Booth(_Part):
    """A booth with a bay that is open on one side and lights in its colour."""

    at: Place  # middle of its square of 0.12 m
    direction: float = 0.0  # degrees, from its mouth into its bay
    colour: Literal["red", "green", "blue", "orange"] = "red"


class Lamp(_Part):
    """A lamp above everything: no wall and no robot hides it."""

    at: Place
    reach: float = Field(2.0, gt=0)  # m, its light falls to e^-2 at this distance


class Floor(_Part):
    """A rectangle of one shade; later ones lie on earlier ones, the bare floor is black."""

    rectangle: Rectangle
    shade: float = Field(ge=0, le=1)


class Arena(_Part):
    """Everything that stands still."""

    outline: tuple[Place, ...] = Field(min_length=3)
    start: Rectangle | None = None  # where robots begin; anywhere if not given
    obstacle: tuple[Obstacle, ...] = ()
    wall: tuple[Wall, ...] = ()
    booth: tuple[Booth, ...] = ()
    lamp: tuple[Lamp, ...] = ()
    floor: tuple[Floor, ...] = ()

    @field_validator("outline")
    @classmethod
    def _sound(cls, corners: tuple[Place, ...]) -> tuple[Place, ...]:
        if max(abs(value) for corner in corners for value in corner) > WIDEST:
            raise ValueError(f"lengths are metres, and no arena reaches farther than {WIDEST:g} m from its origin")
        if _area(corners) < 0.01:
            raise ValueError("encloses less than 0.01 m2: name the corners in order, in metres")
        return corners

    @property
    def solids(self) -> list[np.ndarray]:
        """Outlines (K, 2) of obstacles and walls, m."""
        blocks = [np.array(block.corners) for block in self.obstacle]
        return blocks + [leg for wall in self.wall for leg in _legs(wall)]

    @property
    def booths(self) -> list[tuple[float, float, float]]:
        """Middle (m) of every booth and the direction into its bay (rad)."""
        return [(*booth.at, math.radians(booth.direction)) for booth in self.booth]

    def segments(self) -> np.recarray:
        """Return the scenery: outline, then booth k as group k + 1, then obstacles and walls."""
        corners = np.array(self.outline)
        pieces: list[np.ndarray] = [outline(_points(corners), tall=not _convex(corners))]
        pieces += [booth_outline(x, y, way, WALL_FRICTION, k + 1) for k, (x, y, way) in enumerate(self.booths)]
        first = len(self.booth) + 1
        pieces += [
            chain(_points([*block, block[0]]), tall=True, group=first + k) for k, block in enumerate(self.solids)
        ]
        return joined(*pieces)

    def patches(self) -> np.recarray:
        """Return the floor."""
        return patches([(*floor.rectangle, floor.shade) for floor in self.floor])


class BadArena(ValueError):
    """The text of an arena cannot be used; says where and why."""


def read_arena(text: str, said: str = "arena") -> Arena:
    """Return the arena of a TOML text.

    Args:
        text: in the format shown above.
        said: name of the file, for messages.

    Raises:
        BadArena: if it is no TOML, or a key or a value is wrong; names file, key and value.
    """
    try:
        return Arena.model_validate(tomllib.loads(text))
    except tomllib.TOMLDecodeError as error:
        raise BadArena(f"{said} is no TOML: {error}") from error
    except ValidationError as error:
        first = error.errors()[0]
        place = ".".join(map(str, first["loc"]))
        raise BadArena(
            f"{said}: {place}: {first['msg'].removeprefix('Value error, ')} (got {first['input']!r})"
        ) from None


def _plan(value: Any) -> Any:
    """Take the name of a file for what is in it: a run is then whole without the file."""
    if not isinstance(value, str) or not value or "\n" in value:
        return value
    try:
        text = Path(value).read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError) as error:
        raise ValueError(f"cannot read the arena {value}: {error}") from error
    read_arena(text, value)
    return text if "\n" in text else text + "\n"


class ArenaTable(Table):
    """An arena that may be read from a file; systems add numbers of their own."""

    plan: Annotated[str, BeforeValidator(_plan)] = number(
        "", "1", "TOML file with the arena, instead of the system's own; its text is kept with the run"
    )


def _points(corners: Any) -> list[Place]:
    return [(float(x), float(y)) for x, y in corners]


def _area(corners: tuple[Place, ...]) -> float:
    x, y = np.array(corners).T
    return 0.5 * abs(float(np.dot(x, np.roll(y, -1)) - np.dot(y, np.roll(x, -1))))


def _convex(corners: np.ndarray) -> bool:
    ahead = np.roll(corners, -1, axis=0) - corners
    after = np.roll(ahead, -1, axis=0)
    turns = ahead[:, 0] * after[:, 1] - ahead[:, 1] * after[:, 0]
    return bool((turns >= 0).all() or (turns <= 0).all())


def _legs(wall: Wall) -> list[np.ndarray]:
    points = np.array(wall.line)
    legs = []
    for start, end in pairwise(points):
        along = (end - start) / math.hypot(*(end - start))
        aside = 0.5 * wall.thickness * np.array([-along[1], along[0]])
        legs.append(np.array([start - aside, end - aside, end + aside, start + aside]))
    return legs

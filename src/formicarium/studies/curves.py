"""The description of a figure of curves. ``views.curves`` draws it."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np


class Line(NamedTuple):
    """One curve."""

    label: str
    across: np.ndarray  # (S,)
    up: np.ndarray  # (S,)
    shade: int = 0  # place in the row of colours
    band: tuple[np.ndarray, np.ndarray] | None = None  # lower and upper end, (S,) each


class Marks(NamedTuple):
    """Published values, as points in the colour of a line."""

    label: str
    across: np.ndarray
    up: np.ndarray
    shade: int = 0


class CurvePanel(NamedTuple):
    """One pair of axes."""

    title: str
    across: str
    up: str
    lines: Sequence[Line]
    marks: Sequence[Marks] = ()
    limits: Sequence[tuple[float, str]] = ()  # level lines, with labels
    span: tuple[float, float] | None = None  # of the axis up
    logarithmic: bool = True  # the axis up


class CurveSheet(NamedTuple):
    """A figure: rows of panels."""

    title: str
    note: str
    panels: Sequence[Sequence[CurvePanel]]

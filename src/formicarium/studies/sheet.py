"""The description of a figure: which numbers go on which axes. ``views.sheets`` draws it."""

from collections.abc import Sequence
from typing import NamedTuple

from formicarium.statistics.intervals import Share
from formicarium.statistics.lines import Line
from formicarium.statistics.runtimes import RunTimes


class Curve(NamedTuple):
    """A run-time distribution."""

    times: RunTimes
    style: str = "solid"  # solid, dashed, dashdot or dotted
    shade: int | None = None  # place in the row of shades, from 0; None: ink
    band: bool = False  # with its 95 % band


class Box(NamedTuple):
    """Values of one cell as a box with whiskers to the least and the most; flagged ones also as crosses beside it."""

    place: float  # on the axis across
    values: Sequence[float]  # all of them
    flagged: Sequence[float] = ()  # those among them that are marked
    shade: int | None = None


class Panel(NamedTuple):
    """One pair of axes."""

    title: str
    note: str  # how many runs it stands on
    across: str  # what is on the axis across, with its unit
    up: str
    curves: Sequence[Curve] = ()
    boxes: Sequence[Box] = ()
    ticks: Sequence[str] = ()  # labels of the boxes; their places if there are none
    line: tuple[Line, str] | None = None  # with its label
    start: float = 0.0  # of the axis across; above 0: a logarithmic one
    end: float | None = None
    limits: Sequence[tuple[float, str]] = ()  # upright lines, with labels
    ratios: Sequence[tuple[float, Share, str]] = ()  # place across, share with its interval, label


class Sheet(NamedTuple):
    """A figure: rows of panels, with keys of what is drawn how."""

    name: str  # of the file
    title: str
    panels: Sequence[Sequence[Panel]]
    shades: Sequence[str] = ()  # labels of the shades, in order
    colours: Sequence[str] = ()  # names of the shades' colours; a row from light to dark if there are none
    styles: Sequence[tuple[str, str]] = ()  # (style, label)
    flag: str = ""  # what flagged values are

"""The description of a chart of means, bars or boxes. ``views.charts`` draws it."""

from collections.abc import Sequence
from typing import NamedTuple

from formicarium.statistics.means import Mean


class Trace(NamedTuple):
    """Means over a number, joined by a line."""

    label: str
    across: Sequence[float]
    means: Sequence[Mean]


class Stack(NamedTuple):
    """One bar of parts that lie on each other, from the bottom."""

    tick: str
    parts: Sequence[float]


class Spread(NamedTuple):
    """A box: 5th, 25th, 50th, 75th and 95th percentile."""

    tick: str
    percentiles: Sequence[float]


class Panel(NamedTuple):
    """One pair of axes; holds one kind of thing."""

    title: str
    across: str
    up: str
    traces: Sequence[Trace] = ()
    stacks: Sequence[Stack] = ()
    spreads: Sequence[Spread] = ()
    limit: tuple[float, str] | None = None  # an upright line with its label


class Chart(NamedTuple):
    """A figure: panels side by side."""

    name: str  # of the file
    title: str
    note: str  # on how many runs it stands
    panels: Sequence[Panel]
    keys: Sequence[str] = ()  # of the parts of stacks, from the bottom

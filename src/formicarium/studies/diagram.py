"""Descriptions of drawings: diagrams of states and plans of places. ``views.diagrams`` draws them."""

from collections.abc import Mapping, Sequence
from typing import NamedTuple

import numpy as np


class Arc(NamedTuple):
    """A transition; one with a label is a robot's choice."""

    start: str
    end: str
    label: str = ""


class Machine(NamedTuple):
    """A diagram of states."""

    title: str
    note: str
    places: Mapping[str, tuple[float, float]]  # of the states, inches from the lower left
    colours: Mapping[str, str]  # of the states, names as in a Scene or of matplotlib
    arcs: Sequence[Arc]
    bends: Mapping[tuple[str, str], float]  # how far an arc bulges to the right of its way, share of its length


class Area(NamedTuple):
    """A filled outline."""

    points: np.ndarray  # (K, 2) m
    colour: str  # "wall", "arena" for the floor inside the outer wall, a name as in a Scene, or "none"


class Disc(NamedTuple):
    """A robot."""

    x: float  # m
    y: float
    heading: float  # rad
    loaded: bool


class Mark(NamedTuple):
    """A word with a place that it is about; the word stands ``shift`` (m) away and a thin line leads to the place."""

    text: str
    x: float  # m
    y: float
    shift: tuple[float, float] = (0.0, 0.0)


class Plan(NamedTuple):
    """One drawing of places, seen from above."""

    title: str
    areas: Sequence[Area]
    discs: Sequence[Disc] = ()
    marks: Sequence[Mark] = ()
    lines: Sequence[tuple[np.ndarray, str]] = ()  # (K, 2) points in m, colour; dashed
    dots: Sequence[tuple[float, float, str]] = ()  # lights: place in m, colour
    box: tuple[float, float, float, float] | None = None  # left, bottom, right, top in m; all of it if not given


class Plans(NamedTuple):
    """A figure of plans side by side, to one scale."""

    title: str
    note: str
    plans: Sequence[Plan]
    radius: float  # of the robots, m
    scale: float  # inches a metre

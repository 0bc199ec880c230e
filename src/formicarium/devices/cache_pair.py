"""The cache: pairs of booths, back to back, that keep one object between them (TP-43, Fig. 5).

    state     source side   nest side   what happens                        next
    EMPTY     blue          off         a robot is inside the source side   DROPPING
    DROPPING  red           off         it has left                         FULL
    FULL      off           green       a robot is inside the nest side     PICKING
    PICKING   off           red         it has left                         EMPTY

A side that is dark shows red while a robot is inside, and nothing comes of it. The cache cannot see whether a robot
carries anything: who blunders in leaves an object that nobody brought, or takes one that nobody carries (TP-46).
"""

from enum import IntEnum

import numpy as np

from formicarium.compiled import compiled
from formicarium.robots.records import Colour


class Pair(IntEnum):
    """What a pair is at."""

    EMPTY = 0
    DROPPING = 1
    FULL = 2
    PICKING = 3


PAIR = np.dtype([("state", "i8")], align=True)  # Pair


@compiled
def came_in(pair, nest_side):
    """A robot is now inside one side; tell whether the cache takes notice."""
    if nest_side == 0 and pair.state == Pair.EMPTY:
        pair.state = Pair.DROPPING
        return True
    if nest_side == 1 and pair.state == Pair.FULL:
        pair.state = Pair.PICKING
        return True
    return False


@compiled
def went_out(pair, nest_side):
    """The robot whose visit the cache took notice of has left that side."""
    if nest_side == 0 and pair.state == Pair.DROPPING:
        pair.state = Pair.FULL
    elif nest_side == 1 and pair.state == Pair.PICKING:
        pair.state = Pair.EMPTY


@compiled
def colour_of(pair, nest_side, occupied):
    """Return what the lights of one side show."""
    if occupied == 1:
        return Colour.RED
    if nest_side == 0 and pair.state == Pair.EMPTY:
        return Colour.BLUE
    if nest_side == 1 and pair.state == Pair.FULL:
        return Colour.GREEN
    return Colour.OFF

"""Booths of a foraging arena: source, nest and both sides of the cache (TP-40 to TP-45).

The bay and its two light barriers are those of ``devices.booth``. The light stands at the bottom of the bay, where a
robot inside has it before its forward camera and a robot outside sees it through the mouth only.
"""

from enum import IntEnum

import numpy as np

from formicarium.compiled import compiled
from formicarium.devices.booth import watch_barriers
from formicarium.devices.cache_pair import came_in, colour_of, went_out
from formicarium.robots.records import Colour


class Place(IntEnum):
    """What a booth belongs to."""

    SOURCE = 0
    NEST = 1
    CACHE_DROP = 2  # the cache's side towards the source
    CACHE_PICK = 3  # its side towards the nest


DEPOT = np.dtype(
    [
        ("x", "f8"),  # m, middle of the cube
        ("y", "f8"),
        ("cosine", "f8"),  # of the direction into the bay
        ("sine", "f8"),
        ("place", "i8"),  # Place
        ("pair", "i8"),  # number of the cache pair, -1 for none
        ("cache", "i8"),  # number of the cache: its interfacing times
        ("occupied", "i8"),  # as the light barriers have it
        ("visitor", "i8"),  # index of the robot inside, -1 if none
        ("since", "i8"),  # cycle at which the visit began
        ("noticed", "i8"),  # 1 if the cache took notice of this visit
        ("blocked", "i8"),  # 1 while a person keeps it dark and unaware
    ],
    align=True,
)

INTERFACING = np.dtype(
    [
        ("give_time", "f8"),  # s, Pi_1: a robot stays so long to drop
        ("take_time", "f8"),  # s, Pi_2: and so long to pick up
        ("switch_cycle", "i8"),  # from here on the other two hold; -1 for never
        ("switched_give_time", "f8"),  # s
        ("switched_take_time", "f8"),  # s
    ],
    align=True,
)


@compiled
def serve_depots(depots, pairs, lights, grips, bodies, interfacing, cycle, cycle_time):
    """Let every booth look for a robot, carry the cache's states on, and set all lights.

    The interfacing time of a visit is the one in force when it begins, and counts from then (TP-45); ``interfacing``
    has a row for each cache.
    """
    for b in range(len(depots)):
        depot = depots[b]
        was_occupied = depot.occupied
        deepest = watch_barriers(depot, bodies)
        if depot.occupied == 1 and was_occupied == 0:
            depot.visitor = deepest
            depot.since = cycle
            depot.noticed = 0
            aware = depot.pair >= 0 and depot.blocked == 0
            if aware and came_in(pairs[depot.pair], depot.place == Place.CACHE_PICK):
                depot.noticed = 1
                seconds = interfacing_time(interfacing[depot.cache], depot.place, cycle)
                grips[deepest].busy_until = cycle + 1 + max(1, int(seconds / cycle_time + 0.5))
        elif depot.occupied == 0 and was_occupied == 1:
            if depot.noticed == 1:
                went_out(pairs[depot.pair], depot.place == Place.CACHE_PICK)
            depot.noticed = 0
    for b in range(len(depots)):
        depot = depots[b]
        if depot.blocked == 1:
            lights[b].colour = Colour.OFF
        elif depot.pair >= 0:
            lights[b].colour = colour_of(pairs[depot.pair], depot.place == Place.CACHE_PICK, depot.occupied)
        elif depot.occupied == 1:
            lights[b].colour = Colour.RED
        else:
            lights[b].colour = Colour.GREEN if depot.place == Place.SOURCE else Colour.BLUE


@compiled
def interfacing_time(interfacing, place, cycle):
    """Return how long (s) a visit that begins now lasts at least."""
    switched = 0 <= interfacing.switch_cycle <= cycle
    if place == Place.CACHE_DROP:
        return interfacing.switched_give_time if switched else interfacing.give_time
    return interfacing.switched_take_time if switched else interfacing.take_time

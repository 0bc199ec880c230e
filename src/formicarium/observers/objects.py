"""The observer of objects: sees every visit to the cache and what the visitor believes to carry (TP-46).

An object is a belief of a robot and a state of the cache; where the two part, one is a phantom or is lost. Nothing
is repaired, and no robot hears of it.
"""

import numpy as np

from formicarium.compiled import compiled

CLEAN = 0
PHANTOM = 1  # the cache has an object that nobody dropped
LOST = 2  # the cache has given away an object that nobody took

# What the observer knows of one booth.
VISIT = np.dtype(
    [
        ("occupied", "i8"),  # as it was in the last cycle
        ("visitor", "i8"),
        ("noticed", "i8"),  # 1 if the cache took notice
        ("loaded", "i8"),  # 1 if the visitor believed to carry an object when it came in
        ("began", "i8"),  # cycle
    ],
    align=True,
)


@compiled
def see_arrival(visit, depot, loaded, cycle):
    """Write down who came in, and with what."""
    visit.occupied = 1
    visit.visitor = depot.visitor
    visit.noticed = depot.noticed
    visit.loaded = loaded
    visit.began = cycle


@compiled
def see_departure(visit, nest_side, loaded):
    """Compare what the visitor believes to carry now with what the cache makes of its visit."""
    visit.occupied = 0
    if visit.noticed == 0:
        return CLEAN
    if nest_side:
        return CLEAN if visit.loaded == 0 and loaded == 1 else LOST
    return CLEAN if visit.loaded == 1 and loaded == 0 else PHANTOM

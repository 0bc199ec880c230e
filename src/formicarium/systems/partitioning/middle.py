"""Work between two caches: the sub-task in the middle of three in a row (TP-O1), beyond the paper.

A robot there takes an object from the first cache, drops it at the second, and decides then, as it does after a store,
where to fetch the next. Who gives up a cache goes one area on with the object, or one back to fetch it: so the middle
gets its robots. With two areas, as in the paper, none of this happens.
"""

from formicarium.compiled import compiled
from formicarium.systems.partitioning.choices import choose, close_timer
from formicarium.systems.partitioning.memory import Area, Ground, Label, State, enter
from formicarium.systems.partitioning.navigation import arrive


@compiled
def at_middle(memory):
    """Tell whether the floor is that of the middle area or of a cache's access zone there."""
    place = memory.ground
    return place == Ground.MIDDLE_AREA or place == Ground.MIDDLE_PICK_ZONE or place == Ground.MIDDLE_DROP_ZONE


@compiled
def begin_in_middle(reading, memory, strategy, chart):
    """Begin: decide where to fetch an object, as if one had just been dropped."""
    memory.area = Area.MIDDLE
    choose(reading, memory, strategy, chart)
    go_and_fetch(reading, memory)


@compiled
def dropped_in_middle(reading, memory, strategy, chart):
    """Close the timer at the drop and decide where to fetch the next object."""
    close_timer(reading, memory, strategy, chart, False)
    choose(reading, memory, strategy, chart)


@compiled
def picked_in_middle(reading, memory, strategy, chart):
    """Decide where to take the object, with a tree of tasks (TP-O2); without one it goes to the second cache."""
    if strategy.hierarchical == 1:
        close_timer(reading, memory, strategy, chart, False)
        choose(reading, memory, strategy, chart)


@compiled
def leave_after_drop(reading, memory):
    """Come out of the second cache's booth and go where it was decided."""
    go_and_fetch(reading, memory)


@compiled
def go_and_fetch(reading, memory):
    """Go to the first cache, or through the corridor to the source."""
    if memory.label == Label.CACHE:
        enter(memory, State.TO_CACHE_PICK, reading.cycle)
    else:
        enter(memory, State.CORRIDOR_TO_SOURCE, reading.cycle)
        memory.area = Area.SOURCE


@compiled
def leave_after_pick(reading, memory):
    """Come out of the first cache's booth and carry the object to the second, or where it was decided."""
    if memory.label == Label.CORRIDOR:  # with a tree of tasks only
        enter(memory, State.CORRIDOR_TO_NEST, reading.cycle)
        memory.area = Area.NEST
    else:
        enter(memory, State.TO_CACHE_DROP, reading.cycle)


@compiled
def walk_on_in_middle(reading, memory, table):
    """Come out of the corridor into the middle area: to the second cache with an object, to the first without."""
    enter(memory, State.TO_CACHE_DROP if memory.loaded == 1 else State.TO_CACHE_PICK, reading.cycle)
    arrive(reading, memory, table.arrival_cycles)

"""One cycle of one robot: the finite state machine of Figure 3 (TP-30), one function a state.

A robot sees its Reading and its Memory and writes its Command, and nothing else. It never learns the interfacing
time: it stays in a cache booth while its gripper is busy.
"""

from formicarium.compiled import compiled
from formicarium.control.moves import drive, stop
from formicarium.robots.records import Colour
from formicarium.systems.partitioning.choices import (
    choose,
    close_timer,
    gives_up,
    note_deed,
    note_stay,
    start_wait,
)
from formicarium.systems.partitioning.docking import ACKNOWLEDGED, LOST, begin_leaving, dock, leave, strayed
from formicarium.systems.partitioning.hierarchy import turn_away
from formicarium.systems.partitioning.memory import Area, Deed, Ground, Label, State, enter
from formicarium.systems.partitioning.middle import (
    at_middle,
    begin_in_middle,
    dropped_in_middle,
    leave_after_drop,
    leave_after_pick,
    picked_in_middle,
    walk_on_in_middle,
)
from formicarium.systems.partitioning.navigation import (
    BACK,
    FORWARD,
    arrive,
    corridor_heading,
    escape,
    follow_corridor,
    look,
    look_about,
    walk,
)
from formicarium.systems.partitioning.perception import nearest_blob, perceive


@compiled
def decide(reading, memory, command, table, strategy, chart, epuck):
    """Read, remember, decide.

    Args:
        reading: READING record of the forager, what it senses now.
        memory: MEMORY record, changed in place.
        command: COMMAND record, written.
        table: record of BehaviourTable.
        strategy: record of StrategyTable.
        chart: CHART record, what it was told of the arena.
        epuck: record of the robot's own table.
    """
    stop(command)
    memory.deed = Deed.NONE
    asleep = memory.oriented == 0
    perceive(reading, memory, table, chart, epuck)
    if memory.oriented == 0:
        drive(command, 0.0, table.turn_rate, epuck.wheel_distance)  # on a border between two shades: feel about
        return
    if asleep:
        wake(reading, memory, strategy, chart)
    if memory.leaving > 0 or (is_walking(memory) and strayed(reading, memory, table)):
        leave(reading, memory, command, table, epuck)
    elif not escape(reading, memory, command, table, epuck):
        if memory.state == State.GO_SOURCE:
            go_source(reading, memory, command, table, chart, epuck)
        elif memory.state == State.ENTER_SOURCE:
            enter_source(reading, memory, command, table, strategy, chart, epuck)
        elif memory.state == State.TO_CACHE_DROP:
            to_cache(reading, memory, command, table, strategy, chart, epuck, False)
        elif memory.state == State.WAIT_DROP:
            wait(reading, memory, command, table, strategy, chart, epuck, False)
        elif memory.state == State.ENTER_DROP:
            enter_drop(reading, memory, command, table, strategy, chart, epuck)
        elif memory.state == State.DROPPING:
            dropping(reading, memory, strategy, chart)
        elif memory.state == State.CORRIDOR_TO_NEST:
            corridor_to_nest(reading, memory, command, table, chart, epuck)
        elif memory.state == State.GO_NEST:
            go_nest(reading, memory, command, table, chart, epuck)
        elif memory.state == State.ENTER_NEST:
            enter_nest(reading, memory, command, table, strategy, chart, epuck)
        elif memory.state == State.TO_CACHE_PICK:
            to_cache(reading, memory, command, table, strategy, chart, epuck, True)
        elif memory.state == State.WAIT_PICK:
            wait(reading, memory, command, table, strategy, chart, epuck, True)
        elif memory.state == State.ENTER_PICK:
            enter_pick(reading, memory, command, table, strategy, chart, epuck)
        elif memory.state == State.PICKING:
            picking(reading, memory, strategy, chart)
        elif memory.state == State.CORRIDOR_TO_SOURCE:
            corridor_to_source(reading, memory, command, table, chart, epuck)


@compiled
def is_walking(memory):
    """Tell whether the robot has no business in any booth now."""
    state = memory.state
    entering = state == State.ENTER_SOURCE or state == State.ENTER_NEST
    entering = entering or state == State.ENTER_DROP or state == State.ENTER_PICK
    return not entering and state != State.DROPPING and state != State.PICKING


@compiled
def on_nest_side(memory):
    """Tell whether the floor is that of the nest area or of the cache's access zone there."""
    return memory.ground == Ground.NEST_AREA or memory.ground == Ground.PICK_ZONE


@compiled
def on_source_side(memory):
    """Tell whether the floor is that of the source area or of the cache's access zone there."""
    return memory.ground == Ground.SOURCE_AREA or memory.ground == Ground.DROP_ZONE


@compiled
def wake(reading, memory, strategy, chart):
    """Begin: in the nest area as if an object had just been stored, in the source area without a timer (TP-32)."""
    if on_nest_side(memory):
        note_deed(memory, Deed.BEGAN, reading.cycle)
        memory.area = Area.NEST
        choose(reading, memory, strategy, chart)
        enter(memory, State.TO_CACHE_PICK if memory.label == Label.CACHE else State.CORRIDOR_TO_SOURCE, reading.cycle)
        memory.area = Area.NEST if memory.label == Label.CACHE else memory.far
    elif at_middle(memory):
        note_deed(memory, Deed.BEGAN, reading.cycle)
        begin_in_middle(reading, memory, strategy, chart)
    else:
        enter(memory, State.GO_SOURCE, reading.cycle)


# the source's side


@compiled
def go_source(reading, memory, command, table, chart, epuck):
    """Look for a green light in the source area."""
    if not on_source_side(memory):
        arrive(reading, memory, table.return_cycles)
        follow_corridor(reading, memory, command, table, chart, epuck, Area.SOURCE)
    elif nearest_blob(reading, Colour.GREEN) >= 0:
        enter(memory, State.ENTER_SOURCE, reading.cycle)
        dock(reading, memory, command, table, epuck, Colour.GREEN)
    else:
        look_about(reading, memory, command, table, epuck, BACK, table.speed)


@compiled
def enter_source(reading, memory, command, table, strategy, chart, epuck):
    """Drive into a green booth; red there means that an object is harvested."""
    result = dock(reading, memory, command, table, epuck, Colour.GREEN)
    if result == ACKNOWLEDGED:
        harvested(reading, memory, strategy, chart)
    elif result == LOST:
        enter(memory, State.GO_SOURCE, reading.cycle)


@compiled
def harvested(reading, memory, strategy, chart):
    """Close the timer, decide where to leave the object, and go there."""
    memory.loaded = 1
    close_timer(reading, memory, strategy, chart, False)
    note_deed(memory, Deed.HARVESTED, reading.cycle)
    choose(reading, memory, strategy, chart)
    enter(memory, State.TO_CACHE_DROP if memory.label == Label.CACHE else State.CORRIDOR_TO_NEST, reading.cycle)
    memory.area = Area.SOURCE if memory.label == Label.CACHE else memory.far
    begin_leaving(memory, reading.cycle, FORWARD)


@compiled
def enter_drop(reading, memory, command, table, strategy, chart, epuck):
    """Drive into a blue booth of the cache; red there means that the object is dropped."""
    result = dock(reading, memory, command, table, epuck, Colour.BLUE)
    if result == ACKNOWLEDGED:
        memory.loaded = 0
        memory.waiting = 0
        note_deed(memory, Deed.DROPPED, reading.cycle)
        enter(memory, State.DROPPING, reading.cycle)
        if memory.area == Area.MIDDLE:
            dropped_in_middle(reading, memory, strategy, chart)
    elif result == LOST:
        enter(memory, State.WAIT_DROP if memory.waiting == 1 else State.TO_CACHE_DROP, reading.cycle)


@compiled
def dropping(reading, memory, strategy, chart):
    """Stay while the gripper is busy, then go for the next object: no decision here."""
    if reading.busy == 0 and reading.cycle > memory.since:
        note_stay(reading, memory, strategy, chart)
        enter(memory, State.GO_SOURCE, reading.cycle)
        begin_leaving(memory, reading.cycle, BACK)
        if memory.area == Area.MIDDLE:
            leave_after_drop(reading, memory)


@compiled
def corridor_to_nest(reading, memory, command, table, chart, epuck):
    """Carry the object through the corridor."""
    if on_nest_side(memory):
        enter(memory, State.GO_NEST, reading.cycle)
        memory.area = Area.NEST
        arrive(reading, memory, table.arrival_cycles)
    elif memory.area == Area.MIDDLE and at_middle(memory):
        walk_on_in_middle(reading, memory, table)
    follow_corridor(reading, memory, command, table, chart, epuck, memory.area)


# the nest's side


@compiled
def go_nest(reading, memory, command, table, chart, epuck):
    """Look for a blue light in the nest area."""
    if not on_nest_side(memory):
        arrive(reading, memory, table.return_cycles)
        follow_corridor(reading, memory, command, table, chart, epuck, Area.NEST)
    elif nearest_blob(reading, Colour.BLUE) >= 0:
        enter(memory, State.ENTER_NEST, reading.cycle)
        dock(reading, memory, command, table, epuck, Colour.BLUE)
    else:
        look_about(reading, memory, command, table, epuck, FORWARD, table.speed)


@compiled
def enter_nest(reading, memory, command, table, strategy, chart, epuck):
    """Drive into a blue booth of the nest; red there means that the object is stored."""
    result = dock(reading, memory, command, table, epuck, Colour.BLUE)
    if result == ACKNOWLEDGED:
        stored(reading, memory, strategy, chart)
    elif result == LOST:
        enter(memory, State.GO_NEST, reading.cycle)


@compiled
def stored(reading, memory, strategy, chart):
    """Close the timer, decide where to fetch the next object, and go there."""
    memory.loaded = 0
    close_timer(reading, memory, strategy, chart, True)
    note_deed(memory, Deed.STORED, reading.cycle)
    choose(reading, memory, strategy, chart)
    enter(memory, State.TO_CACHE_PICK if memory.label == Label.CACHE else State.CORRIDOR_TO_SOURCE, reading.cycle)
    memory.area = Area.NEST if memory.label == Label.CACHE else memory.far
    begin_leaving(memory, reading.cycle, BACK)


@compiled
def enter_pick(reading, memory, command, table, strategy, chart, epuck):
    """Drive into a green booth of the cache; red there means that an object is picked up."""
    result = dock(reading, memory, command, table, epuck, Colour.GREEN)
    if result == ACKNOWLEDGED:
        memory.loaded = 1
        memory.waiting = 0
        note_deed(memory, Deed.PICKED, reading.cycle)
        enter(memory, State.PICKING, reading.cycle)
        if memory.area == Area.MIDDLE:
            picked_in_middle(reading, memory, strategy, chart)
    elif result == LOST:
        enter(memory, State.WAIT_PICK if memory.waiting == 1 else State.TO_CACHE_PICK, reading.cycle)


@compiled
def picking(reading, memory, strategy, chart):
    """Stay while the gripper is busy, then carry the object to the nest: no decision here."""
    if reading.busy == 0 and reading.cycle > memory.since:
        note_stay(reading, memory, strategy, chart)
        enter(memory, State.GO_NEST, reading.cycle)
        begin_leaving(memory, reading.cycle, FORWARD)
        if memory.area == Area.MIDDLE:
            leave_after_pick(reading, memory)


@compiled
def corridor_to_source(reading, memory, command, table, chart, epuck):
    """Go back through the corridor, empty."""
    if on_source_side(memory):
        enter(memory, State.GO_SOURCE, reading.cycle)
        memory.area = Area.SOURCE
        arrive(reading, memory, table.arrival_cycles)
    elif memory.area == Area.MIDDLE and at_middle(memory):
        walk_on_in_middle(reading, memory, table)
    follow_corridor(reading, memory, command, table, chart, epuck, memory.area)


# the cache, from either side


@compiled
def to_cache(reading, memory, command, table, strategy, chart, epuck, to_pick):
    """Go to the cache; who has looked about there and seen no booth in its colour begins to wait (TP-17)."""
    cycle = reading.cycle
    if nearest_blob(reading, Colour.GREEN if to_pick else Colour.BLUE) >= 0 and at_cache(memory, to_pick):
        enter_cache(reading, memory, command, table, epuck, to_pick)
    elif memory.ground == zone_of(memory, to_pick):
        look(reading, memory, command, table, epuck, BACK if to_pick else FORWARD)
        if memory.looks >= 2:
            enter(memory, State.WAIT_PICK if to_pick else State.WAIT_DROP, cycle)
            start_wait(reading, memory, strategy, chart)
    else:
        approach_cache(reading, memory, command, table, chart, epuck, to_pick)


@compiled
def at_cache(memory, to_pick):
    """Tell whether the robot stands on the cache's side of the arena that it wants to use."""
    if memory.area == Area.MIDDLE:
        return at_middle(memory)
    return on_nest_side(memory) if to_pick else on_source_side(memory)


@compiled
def zone_of(memory, to_pick):
    """Return the access zone of the cache's side that the robot wants to use."""
    if memory.area == Area.MIDDLE:
        return Ground.MIDDLE_PICK_ZONE if to_pick else Ground.MIDDLE_DROP_ZONE
    return Ground.PICK_ZONE if to_pick else Ground.DROP_ZONE


@compiled
def approach_cache(reading, memory, command, table, chart, epuck, to_pick):
    """Walk to the cache's access zone."""
    if reading.cycle < memory.roam_until and not in_zone(memory):
        walk(reading, memory, command, table, epuck, memory.roam_heading, table.speed)
    elif at_cache(memory, to_pick):
        walk(reading, memory, command, table, epuck, BACK if to_pick else FORWARD, table.speed)
    else:
        arrive(reading, memory, table.return_cycles)
        walk(reading, memory, command, table, epuck, corridor_heading(memory, chart, memory.area), table.speed)


@compiled
def next_area(memory, strategy, chart, to_pick):
    """Return where who gives up does the neighbouring sub-task as well: one area on with the object, or one back.

    With a tree of tasks, the part that is left decides (TP-O2).
    """
    if strategy.hierarchical == 1:
        return turn_away(memory, strategy)
    if chart.subtasks == 3 and memory.area != Area.MIDDLE:
        return Area.MIDDLE
    return Area.SOURCE if to_pick else Area.NEST


@compiled
def in_zone(memory):
    """Tell whether the robot stands in an access zone of the cache."""
    outer = memory.ground == Ground.DROP_ZONE or memory.ground == Ground.PICK_ZONE
    return outer or memory.ground == Ground.MIDDLE_DROP_ZONE or memory.ground == Ground.MIDDLE_PICK_ZONE


@compiled
def enter_cache(reading, memory, command, table, epuck, to_pick):
    """Make for the nearest booth in one's colour."""
    enter(memory, State.ENTER_PICK if to_pick else State.ENTER_DROP, reading.cycle)
    dock(reading, memory, command, table, epuck, Colour.GREEN if to_pick else Colour.BLUE)


@compiled
def wait(reading, memory, command, table, strategy, chart, epuck, to_pick):
    """Wait before the cache for a booth in one's colour, unless patience ends (equations 3 and 4)."""
    if nearest_blob(reading, Colour.GREEN if to_pick else Colour.BLUE) >= 0 and at_cache(memory, to_pick):
        enter_cache(reading, memory, command, table, epuck, to_pick)
    elif gives_up(reading, memory, strategy, chart, to_pick):
        enter(memory, State.CORRIDOR_TO_SOURCE if to_pick else State.CORRIDOR_TO_NEST, reading.cycle)
        memory.area = next_area(memory, strategy, chart, to_pick)
    elif memory.ground == zone_of(memory, to_pick):
        heading = BACK if to_pick else FORWARD
        look_about(reading, memory, command, table, epuck, heading, 0.5 * table.speed)
    else:
        approach_cache(reading, memory, command, table, chart, epuck, to_pick)

"""What one foraging robot remembers: its state in Figure 3, its estimates, and its way."""

from enum import IntEnum

import numpy as np

from formicarium.compiled import compiled
from formicarium.control.odometry import ODOMETER, TRACK

NEVER = -1_000_000  # cycle long before the trial


class State(IntEnum):
    """The states of Figure 3, numbered as in TP-30; HARVESTED and STORED last no time and are functions."""

    GO_SOURCE = 0
    ENTER_SOURCE = 1
    TO_CACHE_DROP = 2
    WAIT_DROP = 3
    ENTER_DROP = 4
    DROPPING = 5
    CORRIDOR_TO_NEST = 6
    GO_NEST = 7
    ENTER_NEST = 8
    TO_CACHE_PICK = 9
    WAIT_PICK = 10
    ENTER_PICK = 11
    PICKING = 12
    CORRIDOR_TO_SOURCE = 13


class Label(IntEnum):
    """How the trip under way was chosen: it decides what its time is a measurement of (TP-21)."""

    NONE = 0
    CACHE = 1
    CORRIDOR = 2
    GAVE_UP = 3


class Ground(IntEnum):
    """Where a robot takes itself to be, by the shade of the floor."""

    SOURCE_AREA = 0
    DROP_ZONE = 1
    LEFT_LEG = 2
    BOTTOM = 3
    RIGHT_LEG = 4
    PICK_ZONE = 5
    NEST_AREA = 6
    MIDDLE_PICK_ZONE = 7  # from here on: with three areas only
    MIDDLE_AREA = 8
    MIDDLE_DROP_ZONE = 9
    MIDDLE_LEG = 10  # of the corridor, from its bottom up to the middle area
    CROSSING = 11  # of that leg and the corridor's bottom


class Area(IntEnum):
    """The areas in which robots work, from source to nest."""

    SOURCE = 0
    MIDDLE = 1  # with three areas only
    NEST = 2


class Way(IntEnum):
    """Trips with an end at a cache of the middle area, each timed on its own by a tree of tasks (TP-O2)."""

    SOURCE_TO_SECOND = 0  # with an object past the first cache
    SECOND_TO_SOURCE = 1
    FIRST_TO_NEST = 2  # with an object past the second cache
    NEST_TO_FIRST = 3
    FIRST_TO_SECOND = 4
    SECOND_TO_FIRST = 5


class Estimate(IntEnum):
    """The three times a robot estimates, and which it has just updated."""

    NONE = 0
    HARVEST = 1  # phi_1
    STORE = 2  # phi_2
    WHOLE = 3  # t_NP
    MIDDLE = 4  # phi_2 of three
    WAY = 5  # with a tree of tasks only: a Way


class Deed(IntEnum):
    """What a robot has just done: for the observers, who read it off its memory."""

    NONE = 0
    HARVESTED = 1
    STORED = 2
    DROPPED = 3
    PICKED = 4
    GAVE_UP = 5
    BEGAN = 6  # decided at the start, in the nest area


MEMORY = np.dtype(
    [
        ("walks", "u8"),  # the robot's own random streams: how it moves,
        ("choices", "u8"),  # whether it partitions,
        ("patience", "u8"),  # and whether it gives up (TP-71)
        ("state", "i8"),
        ("since", "i8"),  # cycle at which the state began
        ("loaded", "i8"),  # 1 if it believes to carry an object
        # strategy
        ("harvest", "f8"),  # s, estimates of phi_1,
        ("store", "f8"),  # s, phi_2
        ("whole", "f8"),  # s, of the whole task
        ("middle", "f8"),  # s, and of the sub-task between two caches, 0 if there is none
        ("area", "i8"),  # Area in which it works or to which it is on its way
        ("set_out", "i8"),  # Area in which it decided last
        ("far", "i8"),  # Area to which the corridor leads it if it does not take the cache
        ("ways", "f8", len(Way)),  # s, of each Way, 0 without a tree of tasks
        ("measured_at", "i8", len(Estimate)),  # cycle of each Estimate's last measurement of its own, NEVER if none
        ("stay", "f8"),  # s, its stays in cache booths, averaged like an estimate; negative: none yet
        ("timer", "i8"),  # cycle of the last harvest or store, NEVER if none
        ("label", "i8"),
        ("waiting", "i8"),  # 1 while it waits at the cache
        ("wait_began", "i8"),  # cycle
        ("draws_made", "i8"),  # of P_g in this wait
        ("draw_due", "i8"),  # cycle of the next one
        ("limit", "f8"),  # the wait's threshold of P_g, if waits have one
        # the deed of this cycle
        ("deed", "i8"),
        ("deed_cycle", "i8"),
        ("updated", "i8"),  # Estimate
        ("measured", "f8"),  # s
        ("probability", "f8"),  # P_p of the decision, P_g of giving up
        # way
        ("odometer", ODOMETER),
        ("compass", "f8"),  # rad, heading by its own reckoning; 0 points from the source to the nest
        ("oriented", "i8"),  # 1 once it has a heading
        ("lamp", "f8"),  # rad, bearing of the lamp
        ("ground", "i8"),  # Ground, -1 until known
        ("path_side", "i8"),  # 1 the path was last seen to the left, -1 to the right
        ("path_seen", "i8"),  # cycle
        ("swerve", "f8"),  # 1 or -1, side on which it goes round what is ahead
        ("swerve_until", "i8"),  # cycle
        ("pressed", "i8"),  # cycles of being stuck
        ("escape_until", "i8"),  # cycle
        ("escape_turn", "f8"),  # 1 or -1
        ("escapes", "i8"),  # how often it has backed off
        # booths
        ("target", TRACK),  # light of the booth it makes for
        ("target_seen", "i8"),  # cycle
        ("leaving", "i8"),  # 1 turning, 2 driving out of a booth
        ("leaving_since", "i8"),
        ("exit_heading", "f8"),  # rad
        ("travelled", "f8"),  # m, on the way out
        ("look_side", "f8"),  # 1 or -1
        ("looks", "i8"),  # turns of looking completed
        ("roam_until", "i8"),  # cycle
        ("roam_heading", "f8"),  # rad
    ],
    align=True,
)


@compiled
def enter(memory, state, cycle):
    """Begin a state."""
    memory.state = state
    memory.since = cycle
    memory.looks = 0
    memory.roam_until = NEVER


# What the robots are told of the arena before they are switched on; headings as on the compass.
CHART = np.dtype(
    [
        ("shades", "f8", len(Ground)),  # of the floor
        ("lamps", "f8", len(Ground)),  # rad, direction of the lamp from the middle of the areas and zones
        ("lamp_behind", "f8"),  # cosine: the lamp lies so far behind at the end of the corridor's bottom
        ("subtasks", "i8"),  # areas in a row
        ("cycle_time", "f8"),  # s
    ],
    align=True,
)

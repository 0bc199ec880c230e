"""What one robot of the coverage system remembers."""

from enum import IntEnum

import numpy as np

from formicarium.robots.footbot import ARM, ARMS

NEVER = -1_000_000  # cycle long before the trial
LINKS = 32  # links that a robot can keep at once (safe)
SLOTS = 16  # of a mission, at most
TALLIED = 63  # tasks of a mission whose work the master tells apart, a bit each


class Mode(IntEnum):
    """The phases that the master calls out; an epoch is one call, four are a round, one slot of a mission."""

    WAIT = 0  # nothing heard yet
    FLOCK = 1
    ERUPT = 2
    HOLD = 3
    GATHER = 4


class Shape(IntEnum):
    """Into what arms grow."""

    STAR = 0
    FRACTAL = 1
    NETWORK = 2


class Stage(IntEnum):
    """What a robot is at."""

    WAITING = 0
    FLOCKING = 1
    SPIRALLING = 2  # towards its arm
    ALIGNED = 3  # in its arm, under the potential alone
    BLIND = 4  # its reference was not heard just now
    LOST = 5  # it has no reference, or no way to the master
    HOLDING = 6
    GATHERING = 7


class Planning(IntEnum):
    """Whether the master wants a new plan of what is left."""

    NONE = 0
    ASKED = 1
    ANSWERED = 2


# A neighbour whose link must not break (safe).
LINK = np.dtype(
    [
        ("who", "i8"),  # number of the neighbour
        ("heard", "i8"),  # cycle
        ("before", "f8"),  # m, where it is: ahead,
        ("beside", "f8"),  # m, and aside
    ],
    align=True,
)

# Tasks that are done at the same time round one point: places by way, in the frame in which the master starts.
SLOT = np.dtype(
    [
        ("point_ahead", "f8"),  # m, point of deployment
        ("point_aside", "f8"),
        ("travel", "i8"),  # 1 if the swarm flocks there first
        ("task_count", "i8"),
        ("task", "i8", ARMS),  # number of each arm's task
        ("task_ahead", "f8", ARMS),  # m
        ("task_aside", "f8", ARMS),
        ("wanted", "f8", ARMS),  # weight of each arm
        ("hold_cycles", "i8"),  # for which all tasks are held at once
        ("hold_limit", "i8"),  # cycles after which the swarm gathers whether they were or not
    ],
    align=True,
)

MEMORY = np.dtype(
    [
        ("draws", "u8"),  # the robot's own random stream
        ("master", "i8"),  # 1 for the master
        ("sequence", "i8"),  # of its messages
        ("stage", "i8"),
        # what the master called out, as far as it has come here
        ("epoch", "i8"),
        ("mode", "i8"),
        ("spacing", "f8"),  # m
        ("since", "i8"),  # cycle at which it was heard
        ("correction", "i8"),  # newest word on the arms
        ("drawn", "i8"),  # the round in which the robot last thought about its arm
        ("arm_count", "i8"),
        ("arms", ARM, ARMS),
        ("arm", "i8"),  # its own, 0: none yet
        # the way to the master
        ("linked", "i8"),
        ("gradient", "f8"),  # m
        ("hops", "i8"),
        ("parent", "i8"),
        ("parent_heard", "i8"),  # cycle
        ("linked_at", "i8"),  # cycle at which it last had a way
        ("farthest", "f8"),  # m
        ("counted", "i8"),
        # the robot it aligns with
        ("reference", "i8"),  # number, 0: none
        ("reference_place", "i8"),  # in the reading's packets, -1: not heard just now
        ("reference_heard", "i8"),  # cycle
        ("way_back", "f8"),  # rad, where it last was
        ("offset", "f8"),  # rad, phi: how far off the arm's line, as the reference sees it
        ("aligned", "i8"),
        ("flips", "i8"),  # how often that has changed
        # where it is in an arm that branches
        ("branch", "i8"),
        ("place", "i8"),
        ("place_since", "i8"),  # cycle since which it has that place
        ("followers", "i8"),  # itself and all that align with it, directly or not
        ("conductance", "f8"),  # C of its tube
        ("withered", "i8"),  # how often it has left one
        ("doubted", "i8"),  # cycles for which it has seemed to be nearer to the root
        ("spiral", "f8"),  # rad, how the present spiral opens
        ("turning", "i8"),  # Turning of the wheels
        # where it is by its own odometry, from where it started; once it is placed, in the map's frame
        ("way_ahead", "f8"),  # m
        ("way_aside", "f8"),  # m
        ("facing", "f8"),  # rad
        # links to be kept (safe)
        ("anchor", "i8"),  # number of the neighbour upstream
        ("link_count", "i8"),
        ("links", LINK, LINKS),  # of them so many
        # who leads, and what a successor has to know (ST-48)
        ("term", "i8"),  # counts the masters; 0: nobody follows the first
        ("leader", "i8"),  # number of the robot where its ways end, 0: none known
        ("office", "i8"),  # 1 if that one leads, 0 if it only stands for the part
        ("beat", "i8"),  # newest word of it: its own clock when it said it
        ("beat_heard", "i8"),  # cycle
        ("given_up", "i8"),  # number of the last one that was silent for too long
        ("given_up_beat", "i8"),  # newest word of that one
        ("standing", "i8"),  # cycle since which it stands for the part itself
        ("home_ahead", "f8"),  # m, where the last master was, in the map's frame
        ("home_aside", "f8"),
        ("placed", "i8"),  # 1 if it knows where it is in the map's frame
        ("credited", "i8"),  # a bit for each task that is known to be done
        # the master's own
        ("corrected", "i8"),  # cycle of the last correction of the arms
        ("tally", "i8", ARMS),  # robots of each arm, counted in the last cycle
        ("agreed", "i8"),  # cycles for which that was everybody and has not changed
        ("slots", SLOT, SLOTS),  # the plan in hand
        ("slot_count", "i8"),  # of them so many
        ("slot", "i8"),  # the plan's, that it is at
        ("planning", "i8"),
        ("plans", "i8"),  # new ones so far
        ("owing", "i8"),  # 1 if it has taken over and not gone on yet
        ("worked", "i8", TALLIED),  # cycles of work on each task that it has had word of
        ("word", "i8", ARMS),  # how new the newest word from each arm's task is
        ("tries", "i8"),  # of it before
        ("held", "i8"),  # cycles for which all tasks of the slot were held
        ("crew", "i8"),  # how many robots it reckons with, itself too
        ("before", "i8"),  # counted in the last cycle
        ("most", "i8"),  # counted in two cycles running since the last census
        ("census", "i8"),  # cycle of that
        ("all_heard", "i8"),  # cycle at which everybody was last counted
        ("done", "i8"),  # 1 when the programme is over
    ],
    align=True,
)

# A task of the map.
CHARTED = np.dtype(
    [
        ("ahead", "f8"),  # m, in the map's frame
        ("aside", "f8"),
        ("cycles", "i8"),  # of work
        ("after", "i8"),  # a bit for each task that comes in an earlier slot
    ],
    align=True,
)

# Into what arms grow.
FORMATION = np.dtype(
    [
        ("kind", "i8"),  # Shape; a field of that name would hide behind an array's own in interpreted code
        ("branch_robots", "i8"),  # of a branch; the last is the root of the next
        ("branches", "i8"),  # that one root has
        ("angle", "f8"),  # rad, between the outermost of them and their stem
        ("ratio", "f8"),  # of delta, a branch to the one before it
        ("depth", "i8"),  # branchings between the master and the last tips
        ("queue_share", "f8"),  # of delta, between robots to spare
        ("patience", "i8"),  # cycles for which a robot is to spare before it goes
        ("flux_power", "f8"),  # m of the conductance rule
        ("tube_cycles", "f8"),  # its unit of time
        ("thinnest", "f8"),  # conductance at which a tube withers
    ],
    align=True,
)

# What a robot is told before the trial. Only the master is told of tasks, unless others may follow it.
CHART = np.dtype(
    [
        ("robots", "i8"),
        ("programme", "i8"),
        ("slot_count", "i8"),
        ("slots", SLOT, SLOTS),
        ("stop", "i8"),
        ("erupt_cycles", "i8"),
        ("gather_cycles", "i8"),
        ("attempts", "i8"),  # at a slot
        ("correction_limit", "i8"),  # cycles
        ("task_count", "i8"),
        ("tasks", CHARTED, TALLIED),
        ("replans", "i8"),  # new plans at most
        ("planning_range", "f8"),  # m of arm for each robot of it
        ("paths", "i8"),  # robot-disjoint ones to a task
        ("region", "f8", 4),  # m, where a master may stand: ahead and aside from, to
        ("cycle_time", "f8"),
        ("formation", FORMATION),
    ],
    align=True,
)

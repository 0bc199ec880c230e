"""The foot-bot and its kin as tables: discs that hear who is where. And what crosses the controller's boundary.

Robot frame: ``ahead`` is forward, ``aside`` left, bearings counter-clockwise from the heading, in (-pi, pi]. SI units.
Rows: Panerati et al. 2018 [paper], their public ARGoS and Python files [files], the foot-bot's simulator model [model],
and engineering choices where all are silent [choice].
"""

import math
from typing import Literal

import numpy as np

from formicarium.tables import Table, number

ARMS = 6  # arms that a message has room for
TASKS = 127  # a task's number and whether its direction is known share a byte of a message
PACKETS = 128  # messages a robot can hear in one cycle; a swarm has no more robots
IDENTITIES = 256  # robots have numbers below this
ENTRIES = 50  # neighbours whose bearing a message has room for


class Footbot(Table):
    """Body, drive, radio and beacon sensor."""

    radius: float = number(0.085, "m", "17 cm wide [model]; the paper says about 10 cm", gt=0, le=0.2)
    mass: float = number(1.6, "kg", "[model]; nothing depends on it without forces", gt=0)
    inertia: float = number(0.006, "kg m2", "moment of inertia, a disc's [choice]", gt=0)
    force_limit: float = number(1.5, "N", "largest force of the drive [choice]", gt=0)
    torque_limit: float = number(1.5, "N m", "largest torque of the drive [choice]", gt=0)
    drive: Literal["wheels", "holonomic"] = number(
        "wheels", "1", "two wheels that turn in three states [files, ST-24], or any direction at once [notebook]"
    )
    wheel_distance: float = number(0.14, "m", "between the wheels [model]", gt=0)
    speed: float = number(0.15, "m/s", "v_max, of the body [paper]", gt=0, le=0.6)
    wheel_noise: float = number(0.0, "1", "standard deviation of a wheel's speed, relative", ge=0, le=0.5)
    wheel_bias: float = number(
        0.0, "1", "standard deviation over robots of a constant error of the left wheel", ge=0, le=0.2
    )
    lag: float = number(0.0, "s", "time constant with which the wheels follow their command", ge=0, le=2)
    odometry_drift: float = number(
        0.0, "1", "standard deviation over robots of the error in path and turn", ge=0, le=0.1
    )

    radio_range: float = number(3.0, "m", "r, centre to centre; a link if not farther [paper]", gt=0, le=10)
    occlusion: bool = number(True, "1", "a body on the line between two robots blocks their messages [model]")
    radio_loss: float = number(
        0.0, "1", "probability that a message is lost, each receiver by itself [files: 0]", ge=0, le=1
    )
    range_noise: float = number(0.0, "m", "standard deviation of a measured range [files: 0]", ge=0, le=0.5)
    bearing_noise: float = number(0.0, "rad", "standard deviation of a measured bearing [files: 0]", ge=0, le=1)
    message_bytes: int = number(500, "bytes", "longest message, one a cycle [files]", ge=100, le=500)
    beacon_range: float = number(
        0.5, "m", "from the middle, at which a task's beacon is noticed [choice ST-43]", gt=0, le=3
    )

    @classmethod
    def layout(cls) -> np.dtype:
        """Return the layout with the drive as a switch."""
        inherited = super().layout()
        fields = [(name, inherited[name]) for name in inherited.names or ()]
        return np.dtype([*fields, ("holonomic", "i8")], align=True)

    def record(self) -> np.recarray:
        """Return the numbers as a record."""
        record = np.zeros(1, self.layout()).view(np.recarray)
        for name, value in self:
            if isinstance(value, bool | int | float):
                record[0][name] = value
        record[0].holonomic = self.drive == "holonomic"
        return record


# Rows: the numbers in which a published setting differs from the table's own.
PAPER_2018 = {"radius": 0.05, "wheel_distance": 0.08}  # diameter about 10 cm [paper]; wheels within it [choice]
NOTEBOOK_2018 = {  # the idealised scenario [notebook, ST-26]
    "radius": 0.02,  # points there; the smallest disc that leaves room for 30 in the start square [choice]
    "wheel_distance": 0.03,
    "drive": "holonomic",
    "speed": 0.03,
    "radio_range": 1.0,
    "occlusion": False,
    "beacon_range": 0.17,  # as far from the range as 0.5 m from 3 m [choice]
}
LABORATORY_2018 = {  # stand-in for seven Khepera IV (ST-67)
    "radius": 0.07,  # diameter 14 cm [data sheet]
    "wheel_distance": 0.105,  # [data sheet]
    "wheel_noise": 0.02,
    "wheel_bias": 0.02,  # ST-67
    "lag": 0.2,  # [choice ST-67]
    "odometry_drift": 0.02,  # choice 9
    "radio_loss": 0.1,  # ST-67
    "range_noise": 0.02,  # choice 29
    "bearing_noise": math.radians(2.0),  # choice 29
}

# What is said of one arm.
ARM = np.dtype(
    [
        ("task", "i8"),  # number of the task that the arm is for, as its beacon says it
        ("known", "i8"),  # 1 if the direction is known; no angle stands for "unknown"
        ("direction", "f8"),  # rad, T_j: of the arm in the speaker's own frame when it spoke
        ("weight", "f8"),  # share of the robots that the master wants there
        ("leave", "f8"),  # probability with which a robot of this arm draws again in this round
        ("count", "i8"),  # robots of this arm among the speaker and those behind it
        ("reached", "i8"),  # hops for which word that the arm's tip is at its task still travels; 0: none
        ("open", "i8"),  # of networks: 1 if a way to the arm's tip is known
        ("way", "f8"),  # m, its length
        ("next", "i8"),  # number of the robot that it goes through first; 0: none
        ("load", "i8"),  # tips that send to that tip through the speaker
        ("told", "i8"),  # cycle at which the way was last found; stays with the robot
    ],
    align=True,
)

# The head of a message: what every neighbour may read.
SAID = [
    ("sender", "i8"),  # the speaker's number, 1..255
    ("sequence", "i8"),  # counts the speaker's messages
    ("epoch", "i8"),  # counts the phases that the master has called out; 0: none heard yet
    ("mode", "i8"),  # the phase
    ("spacing", "f8"),  # m, delta of the phase
    ("correction", "i8"),  # counts the master's corrections of the arms
    ("arm", "i8"),  # the speaker's own, 1..ARMS; 0: none
    ("aligned", "i8"),
    ("linked", "i8"),  # 1 if the speaker has a way to the master; without it gradient and hops say nothing
    ("gradient", "f8"),  # m, D_j: length of that way
    ("hops", "i8"),  # and its hops; 0: the speaker is the master
    ("parent", "i8"),  # number of the robot that the way goes through first, 0: none
    ("reference", "i8"),  # number of the robot that it aligns with, 0: none
    ("anchor", "i8"),  # number of the robot upstream whose link it keeps, 0: none
    ("ahead", "f8"),  # m/s, v_j in the speaker's frame
    ("aside", "f8"),
    ("farthest", "f8"),  # m, greatest gradient among the speaker and those behind it
    ("counted", "i8"),  # how many those are
    # where a master may be followed by another one (ST-48); nothing of it is sent elsewhere
    ("term", "i8"),  # counts the masters; 0: nobody follows the first
    ("leader", "i8"),  # number of the robot where the speaker's ways end, 0: none known
    ("office", "i8"),  # 1 if that one leads, 0 if it only stands for the part
    ("beat", "i8"),  # newest word of it: its own clock when it said it
    ("home_ahead", "f8"),  # m, where the master was then, in the map's frame
    ("home_aside", "f8"),
    ("placed", "i8"),  # 1 if the speaker knows where it is in the map's frame
    ("way_ahead", "f8"),  # m, where that is
    ("way_aside", "f8"),
    ("facing", "f8"),  # rad
    ("credited", "i8"),  # a bit for each task that is known to be done
    ("branch", "i8"),  # of arms that branch: which of its arm, 0: the stem
    ("place", "i8"),  # counted along the branch from 1; 0: none
    ("followers", "i8"),  # the speaker and all that align with it, directly or not
    ("arm_count", "i8"),  # arms spoken of
    ("arms", ARM, ARMS),
]

# A message with what is sent to single neighbours: their bearings, M_ji.
ENTRY = np.dtype([("receiver", "i8"), ("bearing", "f8")], align=True)

# A message as one robot hears it.
PACKET = np.dtype(
    [
        *SAID,
        ("named", "i8"),  # 1 if the message tells this robot its bearing
        ("bearing_of_me", "f8"),  # rad, M_ji: direction of this robot in the speaker's frame when it spoke
        ("range", "f8"),  # m, measured when it was heard
        ("bearing", "f8"),  # rad, O_ij: direction of the speaker, measured when it was heard
    ],
    align=True,
)

READING = np.dtype(
    [
        ("identity", "i8"),  # the robot's own number, 1..255
        ("cycle", "i8"),  # the robot's own clock, control cycles since it was switched on
        ("moved_ahead", "f8"),  # m, by its drive in the last cycle
        ("moved_aside", "f8"),
        ("turned", "f8"),  # rad, by its drive in the last cycle
        ("beacon", "i8"),  # number of the task that is near, 1..TASKS; 0: none
        ("beacon_range", "f8"),  # m
        ("beacon_bearing", "f8"),  # rad
        ("packet_count", "i8"),
        ("packets", PACKET, PACKETS),  # of the last cycle, one a speaker at most
    ],
    align=True,
)

MESSAGE = np.dtype([*SAID, ("entry_count", "i8"), ("entries", ENTRY, ENTRIES), ("bytes", "i8")], align=True)

COMMAND = np.dtype(
    [
        ("ahead", "f8"),  # m/s, wanted velocity
        ("aside", "f8"),
        ("left", "f8"),  # m/s, wheel speeds at the rim that the motion layer makes of it
        ("right", "f8"),
        ("colour", "i8"),  # Colour of the body's lights
        ("enabled", "i8", 1),  # 1 if it speaks
        ("message", MESSAGE),
    ],
    align=True,
)

# What the simulator keeps of a foot-bot beside ROBOT. A controller never sees this record.
CHASSIS = np.dtype(
    [
        ("left_error", "f8"),  # 1, constant error of the left wheel
        ("path_error", "f8"),  # 1, of its odometer
        ("turn_error", "f8"),
        ("left_now", "f8"),  # m/s, wheel speeds that follow the command with a lag
        ("right_now", "f8"),
        ("moved_ahead", "f8"),  # m, what the drive did in the last cycle
        ("moved_aside", "f8"),
        ("turned", "f8"),  # rad
    ],
    align=True,
)

# A task's beacon.
BEACON = np.dtype([("x", "f8"), ("y", "f8"), ("task", "i8")], align=True)

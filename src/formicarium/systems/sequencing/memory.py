"""What one robot of the sequencing swarm remembers: roles, states, and everything it has learnt by itself."""

from enum import IntEnum

import numpy as np

from formicarium.compiled import compiled
from formicarium.control.odometry import ODOMETER, TRACK
from formicarium.robots.records import PACKETS
from formicarium.systems.sequencing.messages import MESSAGE
from formicarium.systems.sequencing.ring import RING

COLOURS = 5  # task colours are 1..4; place 0 stays empty
NEVER = -1_000_000  # cycle long before the trial


class Role(IntEnum):
    """The four roles of the paper."""

    RUNNER = 0
    GUARDIAN = 1
    TAIL = 2
    LINK = 3


class State(IntEnum):
    """The states within the roles."""

    # runner
    WALK = 0  # random walk, straight on
    TURN = 1  # turning on the spot, by chance or away from a task
    FOLLOW = 2  # along the chain
    APPROACH = 3  # towards a booth and into it
    EXCHANGE = 4  # in the bay, waiting for the verdict
    TURN_ROUND = 5  # in the bay, turning towards the mouth
    LEAVE = 6  # a visitor on its way out
    STAND_OFF = 7  # a future guardian on its way out
    PAUSE = 8  # outside, before entering again
    JOIN = 9  # has asked to become the tail
    INHIBITED = 10  # keeps clear of a task
    # tail, and guardian acting as one
    POSITION = 11  # takes its distance to the predecessor
    OPEN = 12  # invites a successor
    OFFER = 13  # has chosen one
    SWEEP = 14  # moves the branch's tip to the left
    DOCK = 15  # aligns with a guardian
    STAY = 16  # link, and guardian that is no tail
    MEND = 17  # link that adjusts its place


# What a robot has heard of one task's guardian.
ADVERT = np.dtype(
    [
        ("heard", "i8"),  # cycle
        ("bearing", "f8"),  # rad
        ("identity", "i8"),
        ("branch", "i8"),
        ("in_chain", "i8"),
        ("established", "i8"),
        ("tail", "i8"),
        ("count", "i8"),  # CND
        ("confident", "i8"),
        ("number", "i8"),  # M4PI (Mark II)
        ("solved", "i8"),  # (Mark II)
    ],
    align=True,
)

MEMORY = np.dtype(
    [
        ("draws", "u8"),  # the robot's own random stream
        ("role", "i8"),
        ("state", "i8"),
        ("since", "i8"),  # cycle at which the state began
        ("odometer", ODOMETER),
        # hearing
        ("message", MESSAGE),  # being written
        ("heard", MESSAGE, PACKETS),  # this cycle's packets, decoded
        ("adverts", ADVERT, COLOURS),  # by task colour
        ("inhibitor", "i8"),  # identity of the robot whose inhibition was heard last
        ("inhibition_heard", "i8"),  # cycle
        ("inhibition_ahead", "i8"),  # cycle of the last one whose sender was ahead
        ("echo_heard", "i8"),  # cycle of the last one that a guardian repeated
        # runner
        ("count", "i8"),  # CNT
        ("turn_left", "f8"),  # rad still to turn
        ("travelled", "f8"),  # m since the state began
        ("queued", "i8"),  # cycles for which it has waited beside a guardian for who stands ahead
        ("chain_seen", "i8"),  # cycle at which a chain member was seen last
        ("colour", "i8"),  # task approached, being done or guarded
        ("candidate", "i8"),  # 1 if it goes on to guard that task
        ("watched", "i8"),  # task colour in view whose guardian is not heard
        ("watched_since", "i8"),  # cycle
        ("target", TRACK),  # the booth's lights
        ("exchange", "i8"),  # last byte heard from the booth
        ("retries", "i8"),
        ("verdict", "i8"),  # 1 success, 0 failure of the last task
        ("reported", "i8"),  # CNT that goes into the notification; in Mark II M4PI
        ("notifying", "i8"),  # 1 while a notification is due
        ("verdict_heard", "i8"),  # cycle
        ("last_success", "i8"),  # colour of the task just done with success
        ("invited_by", "i8"),  # branch whose tail invited it last
        ("step", "i8"),  # M4PI of the permutation that it is trying (Mark II)
        ("step_heard", "i8"),  # cycle at which a guardian said that M4PI last
        ("inhibiting_until", "i8"),  # cycle; sends inhibitions until then
        ("refuse_until", "i8"),  # cycle; ignores invitations until then
        ("abstain_until", "i8"),  # cycle; begins no visit until then
        ("wander_until", "i8"),  # cycle; ignores chain and inhibition until then
        # chain member
        ("branch", "i8"),  # BRN; in Mark II the identity of the guardian that the branch starts from
        ("link_number", "i8"),  # LNK_NO
        ("established", "i8"),  # EST
        ("predecessor", TRACK),
        ("successor", TRACK),
        ("sector", "f8"),  # rad, middle of the sector invited last
        ("chosen", "i8"),  # identity of the runner, or guardian, chosen as successor
        ("stranger_heard", "i8"),  # cycle at which the tail of another branch was heard last (Mark II)
        ("asked", "i8"),  # identity of the guardian that this tail has asked last to take over (Mark II)
        ("ring", RING),  # of the closed loop (Mark II)
        ("requested", "i8"),  # cycle of the last request, or of the last sweep
        ("sweep_due", "i8"),  # cycles after ``requested`` at which to sweep
        ("settled", "i8"),  # cycle since which it is in place
        # guardian
        ("tail", "i8"),  # 1 while it acts as tail
        ("in_chain", "i8"),
        ("condition", "i8"),  # CND
        ("confident", "i8"),  # CONF
        ("notified_by", "i8"),  # identity of the runner whose notification changed CND or CONF last
        ("restarts", "i8"),  # how often CND had to start again at 1 (TS-61)
        ("echoed", "i8"),  # identity whose inhibition it repeats
        ("echo_until", "i8"),  # cycle
    ],
    align=True,
)


@compiled
def enter(memory, state, cycle):
    """Begin a state."""
    memory.state = state
    memory.since = cycle
    memory.travelled = 0.0

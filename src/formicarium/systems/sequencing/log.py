"""What the log of a sequencing trial tells, and what its monitor remembers to write it (TS-136 to TS-138)."""

from enum import IntEnum

import numpy as np


class EventKind(IntEnum):
    """What the log tells; ``robot`` is always the identity of the robot concerned, 0 for none."""

    ROLE = 0  # subject: task colour (guardian) or branch (tail, link); value: new role; detail: old role
    VISIT = 1  # subject: booth's colour; value: 1 came in, 0 went out
    EXECUTED = 2  # subject: task colour; value: 1 success, 0 failure, 2 noted; detail: claimed task number
    SEQUENCE = 3  # value: how many correct sequences the swarm has done
    CONDITION = 4  # subject: task colour; value: CND; detail: CONF of its guardian
    BRANCH = 5  # subject: branch that reached its guardian, in Mark II the colour it starts from; value: its links
    CHAIN = 6  # all branches established, in Mark II the loop is closed; value: guardians + links + tails
    DISPLACED = 7  # a settled chain member was pushed off; subject: as in ROLE; value: role
    DIED = 8  # value: role
    NO_ANSWER = 9  # a visit whose infrared exchange failed; subject: booth's colour
    PROTOCOL_FAULT = 10  # the coordinator's record and a claim disagreed; subject: colour; value: claim
    DISAGREEMENT = 11  # referee and booth disagree about an execution; subject: colour
    UNFOUNDED = 12  # a guardian learnt from a runner that did not do its task last; subject: colour
    STATE = 13  # value: new state; detail: old state (on request)
    MESSAGE = 14  # subject: bytes as one number; value: mask of emitters (on request)
    # Mark II
    ELECTION = 15  # a guardian has begun the election; subject: its colour
    LABEL = 16  # a guardian has a label; subject: its colour; value: 1 = a, 2 = b, ...
    STEP = 17  # a guardian goes on to another permutation; subject: its colour; value: UPI, not wrapped
    SOLVED = 18  # a guardian stops searching; subject: its colour; value: UPI, not wrapped
    MIXED = 19  # tasks of two permutations in one sequence; subject: colour; value, detail: UPI now and at its start
    CROSSING = 20  # a runner has crossed the closed loop; value: 1 inwards, 0 outwards
    HOPELESS = 21  # the trial ends here and counts as run to its cap; value: 0 nobody is a runner, 1 no progress


# What the chain monitor knows of each robot since the last cycle.
MEMBER = np.dtype(
    [
        ("role", "i8"),
        ("state", "i8"),
        ("established", "i8"),
        ("condition", "i8"),
        ("confident", "i8"),
        ("settled", "i8"),  # 1 while its place below is the one to keep
        ("x", "f8"),  # m
        ("y", "f8"),
        ("dead", "i8"),
        # Mark II
        ("election", "i8"),
        ("label", "i8"),
        ("upi", "i8"),
        ("solved", "i8"),
        ("begun", "i8"),  # UPI, not wrapped, under which a runner did the first task of its sequence
        ("next", "i8"),  # index of the successor in the closed loop
        ("side", "i8"),  # of a runner: 1 outside the closed loop, 2 inside, 0 not looked at yet
    ],
    align=True,
)

CHAIN = np.dtype(
    [
        ("sequences", "i8"),  # correct sequences by the referee
        ("faults", "i8"),  # coordinator's faults already logged
        ("complete", "i8"),  # cycle at which the chain was complete, 0 if not yet
        ("members_complete", "i8"),  # chain members then
        ("idle", "i8"),  # cycles for which nobody has been a runner, counted if the trial may end for that
        ("progress", "i8"),  # cycle in which the chain was complete, a search went on or a sequence was done last
        ("visits", "i8", 8),  # per booth: cycle at which the visit in progress began, 0 if none
    ],
    align=True,
)

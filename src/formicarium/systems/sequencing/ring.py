"""What goes round the closed loop of Mark II, and what each member makes of it (TS-113 to TS-130).

Every member keeps saying its latest words; it listens to its successor alone, so words travel clockwise, one hop a
cycle at best, and a lost packet only delays them. A link repeats what it hears. A guardian also remembers its label,
how many permutations it has left behind, and whether the search is over: nothing about other tasks or guardians.
"""

import numpy as np

from formicarium.compiled import compiled
from formicarium.systems.sequencing.permutations import place_of

NOBODY = 7  # CND that no runner reaches: before there is an initial sequence (TS-112)
STEPS = 4  # M4PI counts so far

RING = np.dtype(
    [
        # the words that it says
        ("election", "i8"),
        ("number", "i8"),  # M4PI; during the election the label that is handed on, 0 for none
        ("solved", "i8"),
        ("source", "i8"),  # identity of the guardian whose words these are
        # of a guardian
        ("out", "i8"),  # 1 once its own branch is established at the next guardian
        ("label", "i8"),  # 1 = a, 2 = b, ...; 0 none yet
        ("upi", "i8"),  # permutations tried so far; not wrapped, M4PI = upi mod 4 (TS-129)
    ],
    align=True,
)


@compiled
def is_word_of(message, identity):
    """Tell whether a message is what the robot of that identity says on its own behalf (TS-134)."""
    return message.identity == identity and message.inhibit == 0 and message.request == 0


@compiled
def repeat(ring, message):
    """Take over the words of the successor, as a link."""
    ring.election = message.election
    ring.number = message.number
    ring.solved = message.report
    ring.source = message.source


@compiled
def searches(ring):
    """Tell whether the guardian has its label and the initial sequence exists."""
    return ring.label > 0 and ring.election == 0


@compiled
def condition(ring, tasks):
    """Return CND: how many tasks a runner must have done for this guardian's (TS-118)."""
    return place_of(ring.label, ring.upi, tasks) if searches(ring) else NOBODY


@compiled
def go_on(ring, steps, source):
    """Leave so many permutations behind."""
    ring.upi += steps
    ring.number = ring.upi % STEPS
    ring.source = source


@compiled
def hear_step(ring, message):
    """Follow the others to the next permutation, or stop searching (TS-121, TS-126).

    Guardians are never more than one step apart, so M4PI one or two ahead is newer and three ahead is one behind.
    """
    ahead = (message.number - ring.upi) % STEPS
    if message.election == 1 or ring.solved == 1 or ahead > 2:
        return
    if ahead > 0:
        go_on(ring, ahead, message.source)
    if message.report == 1:
        ring.solved = 1
        ring.source = message.source


@compiled
def hear_report(ring, success, number, identity):
    """Act on a runner's verdict about the permutation of M4PI ``number``, if it is the present one (TS-120, TS-127)."""
    if not searches(ring) or ring.solved == 1 or number != ring.upi % STEPS:
        return
    if success:
        ring.solved = 1
        ring.source = identity
    else:
        go_on(ring, 1, identity)

"""The election of the leader and the first order of the guardians (Chang & Roberts 1979; TS-113 to TS-115, TS-123).

Identities travel clockwise, against the growth of the branches; who is larger than what it hears says its own. An
identity that comes back to its owner proves that the loop is closed and that nobody's is larger. The leader takes the
last label and hands the next lower one on, to the next guardian clockwise, and so on. Who takes label a ends the
election; that goes round once more and releases everybody.
"""

from formicarium.compiled import compiled


@compiled
def begin_election(ring, identity):
    """Enter the election with the own identity."""
    ring.election = 1
    ring.number = 0
    ring.source = identity


@compiled
def take_label(ring, label):
    """Take a label and hand on the next lower one; with label a (1) the initial sequence is complete."""
    ring.label = label
    ring.number = label - 1
    ring.election = 1 if label > 1 else 0


@compiled
def hear_election(ring, message, identity, tasks):
    """Act on the words of the successor during the election; the first matching rule applies."""
    if message.election == 0:
        if ring.label > 0:  # else the loop is not closed yet
            ring.election = 0
            ring.number = 0
    elif ring.label > 0:
        return
    elif message.number > 0:
        ring.source = message.source
        take_label(ring, message.number)
    elif message.source == identity:
        take_label(ring, tasks)
    elif message.source > ring.source:
        ring.source = message.source

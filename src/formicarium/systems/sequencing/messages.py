"""The four-byte message of Mark I, bit by bit (Fig. S2; docs/choices.md).

DATA[0]        identity: own; in T_RES the chosen runner's; in an inhibition echo the initiator's
DATA[1] bit 0  request: T_REQ of a runner, T_RES of a tail
        bit 1  direction: T_DIR of a tail (only in its sector), FEED of a runner's notification
        bit 2  tail
        bit 3  inhibit
        bits 6:4  branch (BRN)
DATA[2] bits 4:0  link_number (LNK_NO), 0 for whoever is not a link or a tail
        bit 5  in_chain
        bit 6  established (EST)
        bit 7  confident (CONF)
DATA[3] bits 2:0  count (CND of a guardian, CNT of a runner's notification)
        bits 5:3  colour of the guarded task
        bit 6  guardian
"""

import numpy as np

from formicarium.compiled import compiled

MESSAGE = np.dtype(
    [
        ("identity", "i8"),
        ("request", "i8"),
        ("direction", "i8"),
        ("tail", "i8"),
        ("inhibit", "i8"),
        ("branch", "i8"),
        ("link_number", "i8"),
        ("in_chain", "i8"),
        ("established", "i8"),
        ("confident", "i8"),
        ("count", "i8"),
        ("colour", "i8"),
        ("guardian", "i8"),
        # of Mark II alone, 0 in Mark I (messages_ii.py)
        ("number", "i8"),
        ("report", "i8"),
        ("election", "i8"),
        ("source", "i8"),
    ],
    align=True,
)

LINK_NUMBER_LIMIT = 31  # five bits


@compiled
def encode(message, payload):
    """Write a message into four bytes."""
    payload[0] = message.identity
    payload[1] = (
        message.request | message.direction << 1 | message.tail << 2 | message.inhibit << 3 | message.branch << 4
    )
    payload[2] = message.link_number | message.in_chain << 5 | message.established << 6 | message.confident << 7
    payload[3] = message.count | message.colour << 3 | message.guardian << 6


@compiled
def decode(payload, message):
    """Read a message from four bytes."""
    byte = int(payload[1])
    message.identity = int(payload[0])
    message.request = byte & 1
    message.direction = byte >> 1 & 1
    message.tail = byte >> 2 & 1
    message.inhibit = byte >> 3 & 1
    message.branch = byte >> 4 & 7
    byte = int(payload[2])
    message.link_number = byte & 31
    message.in_chain = byte >> 5 & 1
    message.established = byte >> 6 & 1
    message.confident = byte >> 7 & 1
    byte = int(payload[3])
    message.count = byte & 7
    message.colour = byte >> 3 & 7
    message.guardian = byte >> 6 & 1


@compiled
def clear(message):
    """Empty a message: all fields 0."""
    message.identity = 0
    message.request = 0
    message.direction = 0
    message.tail = 0
    message.inhibit = 0
    message.branch = 0
    message.link_number = 0
    message.in_chain = 0
    message.established = 0
    message.confident = 0
    message.count = 0
    message.colour = 0
    message.guardian = 0
    message.number = 0
    message.report = 0
    message.election = 0
    message.source = 0


@compiled
def from_runner(message):
    """Tell whether a runner sent it: GUA = TAIL = LNK_NO = 0 (TS-132)."""
    return message.guardian == 0 and message.tail == 0 and message.link_number == 0


@compiled
def is_notification(message):
    """Tell a runner's G_NTF from its requests and inhibitions: only there is the count not 0 (TS-62)."""
    return from_runner(message) and message.request == 0 and message.count != 0

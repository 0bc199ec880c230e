"""What one node holds, what it says, and the numbers that all nodes know."""

from enum import IntEnum

import numpy as np

NODE = np.dtype(
    [
        ("value", "f8"),  # entry of the vector f (PI1, PI2), or the signal s (Wave)
        ("previous", "f8"),  # signal one iteration earlier (Wave)
        ("average", "f8"),  # what consensus works on
        ("found_mean", "f8"),  # of f over all nodes, as consensus found it (PI2)
        ("estimate", "f8"),  # of lambda2 (PI1, PI2), or the signal, to be read out (Wave)
        ("phase", "i8"),  # of the method's cycle
        ("count", "i8"),  # iterations in this phase
        ("told_norm", "f8"),  # 2-norm of f over all nodes: from global memory, author mode only
        ("told_sum", "f8"),  # sum of f over all nodes: from global memory, author mode only
    ],
    align=True,
)

MESSAGE = np.dtype([("value", "f8"), ("average", "f8")], align=True)  # broadcast by every node in every iteration

RULES = np.dtype(
    [
        ("method", "i8"),  # Method
        ("nodes", "i8"),  # K, which all nodes know
        ("clock", "i8"),  # Clock: what ends a consensus
        ("norm_source", "i8"),  # Source of the norm
        ("mean_source", "i8"),  # Source of the mean (PI2)
        ("rows", "i8"),  # Rows (Wave)
        ("printed", "i8"),  # whether Wave's formula is as printed
        ("rounds", "i8"),  # of a consensus on an average
        ("flood", "i8"),  # of a consensus on a maximum
        ("tolerance", "f8"),  # of the global clock
        ("mixing", "f8"),  # gamma of consensus
        ("diffusions", "i8"),  # iterations of step B of PI1
        ("alpha", "f8"),  # divisor of L in step B of PI1
        ("epsilon", "f8"),  # of PI2
        ("wave_speed", "f8"),  # c of Wave
    ],
    align=True,
)


class Method(IntEnum):
    """The three estimators."""

    PI1 = 0  # Bertrand and Moonen
    PI2 = 1  # Di Lorenzo and Barbarossa
    WAVE = 2  # Sahai et al.


class Clock(IntEnum):
    """What ends a consensus."""

    ROUNDS = 0  # a number of rounds that all nodes know
    GLOBAL = 1  # somebody who sees all nodes (ST-6)


class Source(IntEnum):
    """Where a node has the norm or the mean of f from."""

    CONSENSUS = 0  # on an average
    GLOBAL = 1  # computed from the memories of all nodes
    MAXIMUM = 2  # consensus on a maximum: the norm of f is its largest entry


class Rows(IntEnum):
    """Whose packets count in Wave."""

    OWN = 0  # those that the node itself has heard
    MIRRORED = 1  # of each pair those of the first node, for both (ST-13)


class Drops(IntEnum):
    """What a dropped packet means."""

    DIRECTED = 0  # i may hear j while j does not hear i
    SYMMETRIC = 1  # both directions are lost together
    HOLD_LAST = 2  # directed, and the last packet that came goes on counting

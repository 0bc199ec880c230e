"""The experimenter's computer behind the booths: it alone knows the order of the tasks (TS-20, TS-30).

It keeps, per robot identity, how many tasks it has done in a row, and judges by this record, not by what the
robot claims. Immediate feedback (TS-26): every task gets a verdict, and one that is wrong ends the row. Delayed
feedback (TS-28): only the last task of a row gets one, on the whole row; the others are noted.
"""

import numpy as np

from formicarium.compiled import compiled
from formicarium.robots.infrared import FAILURE, NOTED, SUCCESS

IDENTITIES = 256

COORDINATOR = np.dtype(
    [
        ("tasks", "i8"),  # m, number of tasks
        ("order", "i8", 8),  # task colours in the correct order
        ("delayed", "i8"),  # 1 if only whole sequences get a verdict
        ("done", "i8", IDENTITIES),  # tasks done in a row by the robot of that identity
        ("wrong", "i8", IDENTITIES),  # 1 if one of them was out of order (delayed feedback)
        ("faults", "i8"),  # claims that disagreed with the record
        (
            "always_negative",
            "i8",
        ),  # colour of a booth that answers failure to everybody, 0 for none (for tests)
    ],
    align=True,
)


@compiled
def judge(coordinator, identity, claim, colour):
    """Return the verdict byte for a robot that did the task ``colour`` as its number ``claim``.

    A robot that claims number 1 starts afresh. A claim that disagrees with the record is a failure and is
    counted as a fault of the protocol. After a failure, and after the last task, the robot starts afresh.
    """
    if claim == 1:
        coordinator.done[identity] = 0
        coordinator.wrong[identity] = 0
    done = coordinator.done[identity]
    fault = claim != done + 1
    if fault:
        coordinator.faults += 1
    right = not fault and coordinator.order[done] == colour and coordinator.always_negative != colour
    if coordinator.delayed == 1 and not fault:
        coordinator.wrong[identity] |= 0 if right else 1
        if claim < coordinator.tasks:
            coordinator.done[identity] = claim
            return NOTED
        right = coordinator.wrong[identity] == 0
    if right:
        coordinator.done[identity] = (done + 1) % coordinator.tasks
    else:
        coordinator.done[identity] = 0
    return SUCCESS if right else FAILURE

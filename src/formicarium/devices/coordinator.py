"""The experimenter's computer behind the booths: it alone knows the order of the tasks (TS-20, TS-30).

It keeps, per robot identity, how many tasks in a row were right, and judges by this record, not by what the
robot claims. Immediate feedback (TS-26): every task gets a verdict.
"""

import numpy as np

from formicarium.compiled import compiled
from formicarium.robots.infrared import FAILURE, SUCCESS

IDENTITIES = 256

COORDINATOR = np.dtype(
    [
        ("tasks", "i8"),  # m, number of tasks
        ("order", "i8", 8),  # task colours in the correct order
        ("done", "i8", IDENTITIES),  # tasks done in a row by the robot of that identity
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
    done = coordinator.done[identity]
    fault = claim != done + 1
    if fault:
        coordinator.faults += 1
    right = not fault and coordinator.order[done] == colour and coordinator.always_negative != colour
    if right:
        coordinator.done[identity] = (done + 1) % coordinator.tasks
    else:
        coordinator.done[identity] = 0
    return SUCCESS if right else FAILURE

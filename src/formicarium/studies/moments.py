"""The moments of a trial that the paper's snapshots show (Fig. 2)."""

import numpy as np

from formicarium.systems.sequencing.log import EventKind
from formicarium.systems.sequencing.memory import Role
from formicarium.trial.record import Trial

START, GUARDIANS, BRANCH, CHAIN, SEQUENCE = (
    "start",
    "every task has a guardian",
    "first branch established",
    "chain complete",
    "first sequence",
)


def moments(trial: Trial, tasks: int) -> dict[str, int]:
    """Return the cycle of every moment that came."""
    events = trial.events
    guards = events[(events["kind"] == EventKind.ROLE) & (events["value"] == Role.GUARDIAN)]
    found = {START: 0}
    if len(guards) >= tasks:
        found[GUARDIANS] = int(guards["cycle"][tasks - 1])
    for name, kind in ((BRANCH, EventKind.BRANCH), (CHAIN, EventKind.CHAIN), (SEQUENCE, EventKind.SEQUENCE)):
        chosen = events[events["kind"] == kind]
        if len(chosen):
            found[name] = int(chosen["cycle"][0])
    return found


def frame_at(trial: Trial, cycle: int) -> int:
    """Return the number of the first frame after a cycle, or of the last one."""
    assert trial.frames is not None
    return min(int(np.searchsorted(trial.frames.cycle, cycle, side="right")), len(trial.frames.cycle) - 1)

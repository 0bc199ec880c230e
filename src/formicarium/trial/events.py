"""Writing events from compiled code into a log that Python empties between looks."""

import numpy as np

from formicarium.compiled import compiled
from formicarium.physics.records import records
from formicarium.trial.record import EVENT

CLOCK = np.dtype(
    [
        ("cycle", "i8"),  # control cycles since the start
        ("last_cycle", "i8"),  # the trial ends here at the latest
        ("finished", "i8"),  # 1 when the trial has reached its goal
        ("event_count", "i8"),  # events in the log since it was emptied
        ("events_lost", "i8"),  # events that did not fit; an error when the log is emptied
    ],
    align=True,
)


def make_log(most: int) -> np.recarray:
    """Return an empty log with room for the most events of a look, twice: it is emptied when it is half full."""
    return records(EVENT, 2 * most)


@compiled
def write_event(clock, events, kind, robot, subject, value, detail):
    """Append one event to the log."""
    n = clock.event_count
    if n == len(events):
        clock.events_lost += 1
        return
    event = events[n]
    event.cycle = clock.cycle
    event.kind = kind
    event.robot = robot
    event.subject = subject
    event.value = value
    event.detail = detail
    clock.event_count = n + 1

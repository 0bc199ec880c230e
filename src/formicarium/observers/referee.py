"""The referee: counts tasks and sequences from physical presence, independent of robots and coordinator (TS-31)."""

import numpy as np

from formicarium.compiled import compiled

TASKS = 8  # longest history that is kept

REFEREE = np.dtype(
    [
        ("booth", "i8"),  # index of the booth the robot's centre is inside, -1 if none
        ("since", "i8"),  # cycle at which it came in
        (
            "history",
            "i8",
            TASKS,
        ),  # colours of the last tasks done since the last counted sequence, newest last
        ("length", "i8"),
        ("last", "i8"),  # colour of the last task done, 0 if none
        ("executions", "i8"),
        ("sequences", "i8"),
    ],
    align=True,
)


@compiled
def locate(record, body, booths, half, half_width, end, cycle):
    """Note in which booth's bay (frame x in -half..end, |y| < half_width, metres) a body's centre is."""
    inside = -1
    for b in range(len(booths)):
        dx = body.x - booths[b].x
        dy = body.y - booths[b].y
        if dx * dx + dy * dy > 4.0 * half * half:
            continue
        depth = booths[b].cosine * dx + booths[b].sine * dy
        side = -booths[b].sine * dx + booths[b].cosine * dy
        if -half < depth < end and -half_width < side < half_width:
            inside = b
    if inside != record.booth:
        record.booth = inside
        record.since = cycle


@compiled
def executed(record, colour, order, tasks):
    """Add a task to a robot's history and tell whether its last ``tasks`` tasks are the correct sequence."""
    if record.length == TASKS:
        for k in range(TASKS - 1):
            record.history[k] = record.history[k + 1]
        record.length -= 1
    record.history[record.length] = colour
    record.length += 1
    record.executions += 1
    record.last = colour
    if record.length < tasks:
        return False
    for k in range(tasks):
        if record.history[record.length - tasks + k] != order[k]:
            return False
    record.length = 0
    record.sequences += 1
    return True

"""How far arms reach, seen from outside: only robots that are connected to the master count (ST-61)."""

import numpy as np

from formicarium.compiled import compiled

TARGETS = 6
LATERAL = 0.5  # m, off the axis at most
SHORT = 0.1  # m, so much short of a target still counts
HELD = 1.0  # s
DETACHED_LATERAL = 2.0  # m, for robots that ran away: they count where they are seen at all

# An arm's axis and how far it was reached.
AXIS = np.dtype(
    [
        ("x", "f8"),  # m, where it begins
        ("y", "f8"),
        ("cosine", "f8"),  # of its direction
        ("sine", "f8"),
        ("front", "f8"),  # m, greatest projection of a connected robot now
        ("members", "i8"),  # connected robots on it now
        ("longest", "f8"),  # m, greatest front so far
        ("longest_at", "i8"),  # cycle
        ("longest_members", "i8"),  # members then
        ("longest_detached", "f8"),  # m, greatest projection of any robot, connected or not
        ("target", "f8", TARGETS),  # m
        ("since", "i8", TARGETS),  # cycle since which the front has been beyond it, -1: it is not
        ("first", "i8", TARGETS),  # cycle from which it was so for a second, -1: never yet
    ],
    align=True,
)


@compiled
def see_front(axis, state, master):
    """Note how far a connected backbone robot is along an axis now."""
    axis.front = 0.0
    axis.members = 0
    for i in range(len(state.robots)):
        if i == master or state.robots[i].alive == 0:
            continue
        dx = state.world.bodies[i].x - axis.x
        dy = state.world.bodies[i].y - axis.y
        along = axis.cosine * dx + axis.sine * dy
        across = axis.cosine * dy - axis.sine * dx
        if along <= 0.0:
            continue
        connected = state.places[i].reached[0] == 1
        if connected and -LATERAL <= across <= LATERAL:
            axis.members += 1
            axis.front = max(axis.front, along)
        if -DETACHED_LATERAL <= across <= DETACHED_LATERAL:
            axis.longest_detached = max(axis.longest_detached, along)


@compiled
def see_axis(axis, state, master):
    """Bring an axis up to date; return the number of a target that counts as reached from now on, -1 for none."""
    cycle = state.clock[0].cycle
    see_front(axis, state, master)
    if axis.front > axis.longest:
        axis.longest = axis.front
        axis.longest_at = cycle
        axis.longest_members = axis.members
    found = -1
    held = int(HELD / state.world.settings[0].cycle_time + 0.5)
    for k in range(TARGETS):
        if axis.front < axis.target[k] - SHORT:
            axis.since[k] = -1
        elif axis.since[k] < 0:
            axis.since[k] = cycle
        if axis.since[k] >= 0 and axis.first[k] < 0 and cycle - axis.since[k] + 1 >= held:
            axis.first[k] = axis.since[k]
            found = k
    return found

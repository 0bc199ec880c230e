"""Who can reach the master, in three graphs of the same robots: a measurer that sees everything (ST-69).

0, range: not farther than r; 1, sight: and no body between; 2, heard: both had a message from the other of late.
"""

from enum import IntEnum

import numpy as np

from formicarium.compiled import compiled

GRAPHS = 3
LATELY = 5  # cycles in which a message must have come through, 0.5 s


class Graph(IntEnum):
    """What counts as a link."""

    RANGE = 0
    SIGHT = 1
    HEARD = 2


# What is known of one graph over the trial.
CONNECTION = np.dtype(
    [
        ("reached", "i8"),  # living robots that can reach the master, with itself
        ("living", "i8"),
        ("components", "i8"),
        ("lost_since", "i8"),  # cycle, -1 while it is whole
        ("first_loss", "i8"),  # cycle, -1 for never
        ("losses", "i8"),
        ("lost_cycles", "i8"),
        ("longest_loss", "i8"),  # cycles
    ],
    align=True,
)

# Scratch and findings for each robot.
PLACE = np.dtype([("reached", "i8", GRAPHS), ("queue", "i8"), ("mark", "i8")], align=True)


@compiled
def is_link(state, graph, i, n):
    """Tell whether body i and its n-th neighbour are linked."""
    near = state.world.neighbours[i, n]
    j = near.index
    if state.robots[j].alive == 0 or near.distance > state.footbot[0].radio_range:
        return False
    if graph == Graph.SIGHT:
        return state.sight[i, j] == 1
    if graph == Graph.HEARD:
        oldest = state.clock[0].cycle - LATELY
        return state.heard[i, j] > oldest and state.heard[j, i] > oldest
    return True


@compiled
def flood(state, graph, start, without, mark):
    """Mark all that can be reached from body ``start`` but not through body ``without``; return how many they are."""
    places = state.places
    places[0].queue = start
    places[start].mark = mark
    count = 1
    done = 0
    while done < count:
        i = places[done].queue
        done += 1
        for n in range(state.world.neighbour_count[i]):
            j = state.world.neighbours[i, n].index
            if places[j].mark != mark and j != without and is_link(state, graph, i, n):
                places[j].mark = mark
                places[count].queue = j
                count += 1
    return count


@compiled
def see_connection(state, graph, master):
    """Note who reaches the master (body ``master``) in one graph, and keep count of losses; tell if that changed."""
    connection = state.connections[graph]
    living = 0
    for i in range(len(state.robots)):
        state.places[i].mark = 0
        living += state.robots[i].alive
    connection.living = living
    connection.reached = flood(state, graph, master, -1, 1) if state.robots[master].alive == 1 else 0
    connection.components = 1 if connection.reached > 0 else 0
    for i in range(len(state.robots)):
        state.places[i].reached[graph] = state.places[i].mark
    if connection.reached < living:
        for i in range(len(state.robots)):
            if state.places[i].mark == 0 and state.robots[i].alive == 1:
                flood(state, graph, i, -1, 2)
                connection.components += 1
    return note_loss(connection, state.clock[0].cycle)


@compiled
def note_loss(connection, cycle):
    """Keep count of losses; tell if one began or ended now."""
    if connection.reached == connection.living:
        ended = connection.lost_since >= 0
        connection.lost_since = -1
        return ended
    began = connection.lost_since < 0
    if began:
        connection.lost_since = cycle
        connection.losses += 1
        if connection.first_loss < 0:
            connection.first_loss = cycle
    connection.lost_cycles += 1
    connection.longest_loss = max(connection.longest_loss, cycle - connection.lost_since + 1)
    return began


@compiled
def count_cut_robots(state, graph):
    """Return how many robots would part the others by their loss (articulation points); the graph must be whole."""
    count = 0
    living = state.connections[graph].living
    for i in range(len(state.robots)):
        if state.robots[i].alive == 0 or living < 3:
            continue
        start = 0
        while state.robots[start].alive == 0 or start == i:
            start += 1
        for k in range(len(state.robots)):
            state.places[k].mark = 0
        if flood(state, graph, start, i, 3) < living - 1:
            count += 1
    return count

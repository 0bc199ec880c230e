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
PLACE = np.dtype(
    [
        ("reached", "i8", GRAPHS),  # 1 if the robot reaches the master
        ("queue", "i8"),  # a list of its own, and so on: scratch
        ("mark", "i8"),
        ("order", "i8"),
        ("low", "i8"),
        ("next", "i8"),
    ],
    align=True,
)


@compiled
def find_links(state):
    """Write for every body and neighbour in which graphs they are linked: links (N, N - 1), a bit for each graph."""
    oldest = state.clock[0].cycle - LATELY
    radio_range = state.footbot[0].radio_range
    for i in range(len(state.robots)):
        for n in range(state.world.neighbour_count[i]):
            near = state.world.neighbours[i, n]
            j = near.index
            bits = 0
            if near.distance <= radio_range and state.robots[i].alive == 1 and state.robots[j].alive == 1:
                bits = 1 << Graph.RANGE
                if state.sight[i, j] == 1:
                    bits |= 1 << Graph.SIGHT
                if state.heard[i, j] > oldest and state.heard[j, i] > oldest:
                    bits |= 1 << Graph.HEARD
            state.links[i, n] = bits


@compiled
def flood(neighbours, neighbour_count, links, places, graph, start, mark, most):
    """Mark all that can be reached from body ``start``; return how many they are; there are at most ``most``."""
    bit = 1 << graph
    places[0].queue = start
    places[start].mark = mark
    count = 1
    done = 0
    while done < count and count < most:
        i = places[done].queue
        done += 1
        for n in range(neighbour_count[i]):
            j = neighbours[i, n].index
            if links[i, n] & bit != 0 and places[j].mark != mark:
                places[j].mark = mark
                places[count].queue = j
                count += 1
    return count


@compiled
def see_connection(state, graph, master):
    """Note who reaches the master (body ``master``) in one graph, and keep count of losses; tell if that changed."""
    connection = state.connections[graph]
    neighbours, counts = state.world.neighbours, state.world.neighbour_count
    living = 0
    for i in range(len(state.robots)):
        state.places[i].mark = 0
        living += state.robots[i].alive
    connection.living = living
    connection.reached = 0
    connection.components = 0
    if state.robots[master].alive == 1:
        connection.reached = flood(neighbours, counts, state.links, state.places, graph, master, 1, living)
        connection.components = 1
    for i in range(len(state.robots)):
        state.places[i].reached[graph] = state.places[i].mark
    if connection.reached < living:
        for i in range(len(state.robots)):
            if state.places[i].mark == 0 and state.robots[i].alive == 1:
                flood(neighbours, counts, state.links, state.places, graph, i, 2, living)
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
def count_cut_robots(neighbours, neighbour_count, links, places, graph, start):
    """Return how many robots would part the others by their loss; the graph, seen from body ``start``, must be whole.

    Articulation points by depth-first search (Hopcroft and Tarjan 1973): a robot is one if a child in the tree has no
    way back above it, and the root if it has two children.
    """
    bit = 1 << graph
    for k in range(len(places)):
        places[k].order = 0
        places[k].next = 0
        places[k].mark = 0
    order = 1
    depth = 1
    root_children = 0
    count = 0
    places[0].queue = start
    places[start].order = order
    places[start].low = order
    while depth > 0:
        i = places[depth - 1].queue
        n = places[i].next
        if n < neighbour_count[i]:
            places[i].next += 1
            j = neighbours[i, n].index
            if links[i, n] & bit == 0:
                continue
            if places[j].order > 0:
                places[i].low = min(places[i].low, places[j].order)
                continue
            order += 1
            places[j].order = order
            places[j].low = order
            places[depth].queue = j
            depth += 1
            continue
        depth -= 1
        if depth == 0:
            break
        above = places[depth - 1].queue
        places[above].low = min(places[above].low, places[i].low)
        if above == start:
            root_children += 1
        elif places[i].low >= places[above].order and places[above].mark == 0:
            places[above].mark = 1
            count += 1
    return count + 1 if root_children > 1 else count

"""The safe variant: no step that could break a link that somebody depends on (ST-46).

Every robot keeps the link to one neighbour upstream, its anchor, and to each neighbour whose anchor it is. All anchors
together are a tree to the master, so the swarm holds together as long as each of these links does.
"""

import math

from formicarium.compiled import compiled
from formicarium.systems.coverage.listening import goes_with
from formicarium.systems.coverage.memory import LINKS

HYSTERESIS = 0.8  # another anchor must be nearer by this factor


@compiled
def link_of(memory, who):
    """Return the place of a link in memory, -1 for none."""
    for k in range(memory.link_count):
        if memory.links[k].who == who:
            return k
    return -1


@compiled
def keep_link(memory, packet, cycle):
    """Note where a neighbour is whose link must not break."""
    k = link_of(memory, packet.sender)
    if k < 0 and memory.link_count < LINKS:
        k = memory.link_count
        memory.link_count += 1
    if k >= 0:
        link = memory.links[k]
        link.who = packet.sender
        link.heard = cycle
        link.before = packet.range * math.cos(packet.bearing)
        link.beside = packet.range * math.sin(packet.bearing)


@compiled
def drop_link(memory, k):
    """Forget a link; the last one takes its place."""
    memory.link_count -= 1
    last = memory.links[memory.link_count]
    link = memory.links[k]
    link.who = last.who
    link.heard = last.heard
    link.before = last.before
    link.beside = last.beside


@compiled
def choose_anchor(reading, memory, table, limit):
    """Hold on to the nearest neighbour that is clearly nearer to the master; change only for a much nearer one.

    A link that is nearly as long as ``limit`` (m) ties both its ends down, so it is changed for any that is shorter.
    """
    if memory.master == 1:
        return
    best = -1
    own = -1
    for k in range(reading.packet_count):
        packet = reading.packets[k]
        if packet.linked == 0 or packet.gradient > memory.gradient - table.anchor_margin:
            continue
        if not goes_with(memory, packet):
            continue
        if packet.sender == memory.anchor:
            own = k
        if best < 0 or packet.range < reading.packets[best].range:
            best = k
    if memory.linked == 0 or best < 0:
        return
    if own < 0 or is_better(reading.packets[best].range, reading.packets[own].range, table, limit):
        memory.anchor = reading.packets[best].sender


@compiled
def is_better(other, own, table, limit):
    """Tell whether a link of the length ``other`` is worth giving up one's own for (m)."""
    if own > table.taut_share * limit:
        return other < own - table.anchor_margin
    return other < HYSTERESIS * own


@compiled
def note_links(reading, memory, table, limit):
    """Bring the links up to date: the anchor, those whose anchor one is, and nobody who was silent too long."""
    choose_anchor(reading, memory, table, limit)
    for k in range(reading.packet_count):
        packet = reading.packets[k]
        if packet.sender == memory.anchor or packet.anchor == reading.identity:
            keep_link(memory, packet, reading.cycle)
        else:
            place = link_of(memory, packet.sender)
            if place >= 0:
                drop_link(memory, place)
    for k in range(memory.link_count - 1, -1, -1):
        if reading.cycle - memory.links[k].heard > table.keep_cycles:
            drop_link(memory, k)


@compiled
def allowed(memory, ahead, aside, other, limit, cycle):
    """Return which share of a step (m) is allowed so that no kept link can exceed ``limit`` (m).

    Of the other end nothing is known but that it moves at most ``other`` metres in a cycle, since it was last heard.
    A step that shortens a link is always allowed.
    """
    share = 1.0
    square = ahead * ahead + aside * aside
    if square == 0.0:
        return share
    for k in range(memory.link_count):
        link = memory.links[k]
        reach = limit - other * (cycle - link.heard + 1)
        # |link - share step|^2 = reach^2; the larger root is where the step leaves the circle.
        along = link.before * ahead + link.beside * aside
        rest = link.before * link.before + link.beside * link.beside - reach * reach
        if reach <= 0.0 or rest >= 0.0:
            if along <= 0.0:
                share = 0.0
            elif along < square * share:
                share = along / square
            continue
        root = (along + math.sqrt(along * along - square * rest)) / square
        share = min(share, root)
    return share


@compiled
def restrain_wish(memory, command, footbot, limit, cycle, cycle_time):
    """Shorten the wanted velocity; a robot that may not move at all closes up to the link that is too long."""
    other = footbot.speed * cycle_time
    share = allowed(memory, command.ahead * cycle_time, command.aside * cycle_time, other, limit, cycle)
    command.ahead *= share
    command.aside *= share
    if share < 1.0:
        worst = -1
        longest = limit
        for k in range(memory.link_count):
            link = memory.links[k]
            length = math.sqrt(link.before * link.before + link.beside * link.beside)
            if length > longest:
                longest = length
                worst = k
        if worst >= 0:
            link = memory.links[worst]
            command.ahead += (1.0 - share) * footbot.speed * link.before / longest
            command.aside += (1.0 - share) * footbot.speed * link.beside / longest
            again = allowed(memory, command.ahead * cycle_time, command.aside * cycle_time, other, limit, cycle)
            command.ahead *= again
            command.aside *= again


@compiled
def restrain_wheels(memory, command, footbot, limit, cycle, cycle_time):
    """Shorten what the wheels would do: they go along the heading, not where the robot wants to."""
    forward = 0.5 * (command.left + command.right)
    half = 0.5 * (command.right - command.left)
    share = allowed(memory, forward * cycle_time, 0.0, footbot.speed * cycle_time, limit, cycle)
    command.left = share * forward - half
    command.right = share * forward + half

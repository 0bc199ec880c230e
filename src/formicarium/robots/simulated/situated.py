"""Situated communication: a broadcast comes with range and bearing of its speaker (ST-22, ST-25)."""

import math

from formicarium.angles import wrapped
from formicarium.compiled import compiled
from formicarium.streams import advanced, normal


@compiled
def find_sight(world, sight, radio_range, rows):
    """Write into ``sight`` (N, N) for every pair within ``radio_range`` (m) 1 if no body is between them, else 0.

    As ``physics.rays.bodies_in_line_of_sight``, for a world without scenery: pairs are looked at once, and a body's
    neighbours in the order of their distances: the nearest, which hide most, come first, and those behind not at all.

    Args:
        world: the bodies, with the lists of their neighbours.
        sight: written.
        radio_range: m, farther pairs are not in sight.
        rows: (4, N) scratch.
    """
    sight[:] = 0
    widest = 0.0
    for i in range(len(world.bodies)):
        widest = max(widest, world.bodies[i].radius)
    for i in range(len(world.bodies)):
        rank = world.lists[i].rank
        count = sort_by_distance(world, i, rows)
        for n in range(world.neighbour_count[i]):
            near = world.neighbours[i, n]
            if near.distance <= radio_range and world.lists[near.index].rank > rank:
                if is_clear(rows, count, near, widest):
                    sight[i, near.index] = 1
                    sight[near.index, i] = 1


@compiled
def sort_by_distance(world, i, rows):
    """Write dx, dy, distance, radius (m) of a body's neighbours into four rows, nearest first; return their number."""
    count = world.neighbour_count[i]
    for n in range(count):
        near = world.neighbours[i, n]
        place = n
        while place > 0 and rows[2, place - 1] > near.distance:
            for row in range(4):
                rows[row, place] = rows[row, place - 1]
            place -= 1
        rows[0, place] = near.dx
        rows[1, place] = near.dy
        rows[2, place] = near.distance
        rows[3, place] = world.bodies[near.index].radius
    return count


@compiled
def is_clear(rows, count, near, widest):
    """Tell whether no other of ``count`` neighbours in ``rows``, at most ``widest`` (m), is on the line to one."""
    distance = near.distance
    square = distance * distance
    for n in range(count):
        if rows[2, n] > distance + widest:
            return True
        along = rows[0, n] * near.dx + rows[1, n] * near.dy
        if 0.0 < along < square:
            across = rows[0, n] * near.dy - rows[1, n] * near.dx
            hidden = rows[3, n] * distance
            if across * across < hidden * hidden and (rows[0, n] != near.dx or rows[1, n] != near.dy):
                return False
    return True


@compiled
def measure_speaker(packet, near, heading, noise, footbot):
    """Measure range + N(0, sigma_r) and bearing + N(0, sigma_b) of a speaker; ``near`` leads from it to here."""
    noise = advanced(noise)
    packet.range = max(0.0, near.distance + footbot.range_noise * normal(noise))
    noise = advanced(noise)
    direction = math.atan2(-near.dy, -near.dx) - heading
    packet.bearing = wrapped(direction + footbot.bearing_noise * normal(noise))


@compiled
def hear(packet, message, entry):
    """Copy the head of a message, and of what it tells to single neighbours only one ``entry``, none if that is -1."""
    packet.sender = message.sender
    packet.sequence = message.sequence
    packet.epoch = message.epoch
    packet.mode = message.mode
    packet.spacing = message.spacing
    packet.correction = message.correction
    packet.arm = message.arm
    packet.aligned = message.aligned
    packet.linked = message.linked
    packet.gradient = message.gradient
    packet.hops = message.hops
    packet.parent = message.parent
    packet.reference = message.reference
    packet.anchor = message.anchor
    packet.ahead = message.ahead
    packet.aside = message.aside
    packet.farthest = message.farthest
    packet.counted = message.counted
    packet.term = message.term
    if message.term > 0:
        hear_of_leader(packet, message)
    packet.branch = message.branch
    packet.place = message.place
    packet.followers = message.followers
    packet.arm_count = message.arm_count
    for k in range(message.arm_count):
        packet.arms[k].task = message.arms[k].task
        packet.arms[k].known = message.arms[k].known
        packet.arms[k].direction = message.arms[k].direction
        packet.arms[k].weight = message.arms[k].weight
        packet.arms[k].leave = message.arms[k].leave
        packet.arms[k].count = message.arms[k].count
        packet.arms[k].reached = message.arms[k].reached
        packet.arms[k].open = message.arms[k].open
        packet.arms[k].way = message.arms[k].way
        packet.arms[k].next = message.arms[k].next
        packet.arms[k].load = message.arms[k].load
    packet.named = 1 if entry >= 0 else 0
    packet.bearing_of_me = message.entries[entry].bearing if entry >= 0 else 0.0


@compiled
def hear_of_leader(packet, message):
    """Copy what is said of the master, of the map and of what is done."""
    packet.leader = message.leader
    packet.office = message.office
    packet.beat = message.beat
    packet.home_ahead = message.home_ahead
    packet.home_aside = message.home_aside
    packet.placed = message.placed
    packet.way_ahead = message.way_ahead
    packet.way_aside = message.way_aside
    packet.facing = message.facing
    packet.credited = message.credited

"""Situated communication: a broadcast comes with range and bearing of its speaker (ST-22, ST-25)."""

import math

from formicarium.angles import wrapped
from formicarium.compiled import compiled
from formicarium.streams import advanced, normal


@compiled
def find_sight(world, sight, radio_range):
    """Write into ``sight`` (N, N) for every pair within ``radio_range`` (m) 1 if no body is between them, else 0.

    As ``physics.rays.bodies_in_line_of_sight``, for a world without scenery: pairs are looked at once.
    """
    sight[:] = 0
    bodies = world.bodies
    neighbours = world.neighbours
    for i in range(len(bodies)):
        rank = world.lists[i].rank
        for n in range(world.neighbour_count[i]):
            j = neighbours[i, n].index
            if neighbours[i, n].distance <= radio_range and world.lists[j].rank > rank:
                if is_clear(bodies, neighbours, i, n, world.neighbour_count[i]):
                    sight[i, j] = 1
                    sight[j, i] = 1


@compiled
def is_clear(bodies, neighbours, i, n, count):
    """Tell whether no third body is on the line from body ``i``, which has ``count`` neighbours, to its n-th."""
    x = neighbours[i, n].dx
    y = neighbours[i, n].dy
    distance = neighbours[i, n].distance
    square = distance * distance
    for between in range(count):
        near = neighbours[i, between]
        along = near.dx * x + near.dy * y
        if between != n and 0.0 < along < square:
            across = near.dx * y - near.dy * x
            hidden = bodies[near.index].radius * distance
            if across * across < hidden * hidden:
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
def hear(packet, message, identity):
    """Copy the head of a message, and of what it tells to single neighbours only the own part."""
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
    packet.arm_count = message.arm_count
    for k in range(message.arm_count):
        packet.arms[k].known = message.arms[k].known
        packet.arms[k].direction = message.arms[k].direction
        packet.arms[k].weight = message.arms[k].weight
        packet.arms[k].leave = message.arms[k].leave
        packet.arms[k].count = message.arms[k].count
        packet.arms[k].reached = message.arms[k].reached
    packet.named = 0
    packet.bearing_of_me = 0.0
    for e in range(message.entry_count):
        if message.entries[e].receiver == identity:
            packet.named = 1
            packet.bearing_of_me = message.entries[e].bearing
            return

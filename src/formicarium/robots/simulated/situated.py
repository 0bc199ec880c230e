"""Situated communication: a broadcast comes with range and bearing of its speaker (ST-22, ST-25)."""

import math

from formicarium.angles import wrapped
from formicarium.compiled import compiled
from formicarium.physics.rays import bodies_in_line_of_sight
from formicarium.streams import advanced, normal


@compiled
def find_sight(world, sight, radio_range):
    """Write for every pair of bodies within ``radio_range`` (m) whether no body is between them: sight (N, N), 1 or 0."""
    sight[:] = 0
    for i in range(len(world.bodies)):
        for n in range(world.neighbour_count[i]):
            near = world.neighbours[i, n]
            if near.distance <= radio_range and world.lists[near.index].rank > world.lists[i].rank:
                if bodies_in_line_of_sight(world, i, n):
                    sight[i, near.index] = 1
                    sight[near.index, i] = 1


@compiled
def measure_speaker(packet, near, heading, noise, footbot):
    """Measure range + N(0, sigma_r) and bearing + N(0, sigma_b) of a speaker; ``near`` points from it to the listener."""
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
    packet.round = message.round
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

"""Sums of Lennard-Jones forces over the neighbours heard just now."""

import math

from formicarium.compiled import compiled
from formicarium.control.potentials import lennard_jones, lennard_jones_printed, saturated, smooth_depth

PRINTED, SMOOTH = 1, 2  # places among the forces
LEAST = 0.01  # m, no distance is taken for less
STILL = 1e-12  # m/s


@compiled
def clear(command):
    """Want to stand still."""
    command.ahead = 0.0
    command.aside = 0.0


@compiled
def wish(command, bearing, speed):
    """Want to move towards a bearing (rad) at a speed (m/s)."""
    command.ahead = speed * math.cos(bearing)
    command.aside = speed * math.sin(bearing)


@compiled
def push_from(command, packet, spacing, table):
    """Add the force of one neighbour."""
    distance = max(LEAST, packet.range)
    if table.force == PRINTED:
        force = lennard_jones_printed(distance, spacing, table.depth)
    elif table.force == SMOOTH:
        force = lennard_jones(distance, spacing, smooth_depth(table.smooth_rate, spacing))
    else:
        force = lennard_jones(distance, spacing, table.depth)
    command.ahead -= force * math.cos(packet.bearing)
    command.aside -= force * math.sin(packet.bearing)


@compiled
def cut(command, table, limit):
    """Cut the wanted velocity to the top speed (m/s), or let the smooth force near it."""
    length = math.sqrt(command.ahead * command.ahead + command.aside * command.aside)
    if length <= STILL:
        clear(command)
        return
    share = 1.0
    if table.force == SMOOTH:
        share = saturated(length, limit) / length
    elif length > limit:
        share = limit / length
    command.ahead *= share
    command.aside *= share


@compiled
def press(reading, memory, command, table, spacing, arm, limit):
    """Follow the potential of the neighbours: of one's own arm and the master (ST-38), or of all if ``arm`` is 0.

    Velocity = sum of the forces, cut to the top speed (ST-29).
    """
    clear(command)
    for k in range(reading.packet_count):
        packet = reading.packets[k]
        if arm == 0 or packet.arm == arm or (packet.linked == 1 and packet.hops == 0):
            push_from(command, packet, spacing, table)
    cut(command, table, limit)

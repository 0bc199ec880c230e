"""Flocking (equation 3, ST-30) and rendez-vous."""

import math

from formicarium.compiled import compiled
from formicarium.control.bearings import carried_over
from formicarium.systems.coverage.forces import LEAST, clear, cut

PRINTED = 1


@compiled
def flock(reading, memory, command, table, limit):
    """Stay with the others on the way.

    v_i = 1/|N| sum over j of (e x_ij + f v_j) - g sum over j with d_ij < q of x_ij / d_ij^2 + l x_iL, with x_ij the way
    to neighbour j in one's own frame, v_j its velocity carried over into it, and L the master if it is heard, else the
    parent, as long as it is beyond q. Divided by |N| too, or with a pull from nearby, separation would be so weak in a
    crowd that robots touch and box the master in.

    As printed: sum over j of (e x_ij + f v_j - g 1(d_ij < q) d_ij x_ij): separation vanishes as robots touch, and
    nothing pulls towards the master.
    """
    clear(command)
    printed = table.flocking == PRINTED
    share = 1.0 if printed else 1.0 / max(1, reading.packet_count)
    leader = -1
    for k in range(reading.packet_count):
        packet = reading.packets[k]
        is_master = packet.linked == 1 and packet.hops == 0
        if is_master or (leader < 0 and packet.sender == memory.parent):
            leader = k
        distance = max(LEAST, packet.range)
        pull = share * table.cohesion
        if distance < table.separation_range:
            pull -= table.separation * (distance if printed else 1.0 / (distance * distance))
        wanted_from(command, packet, pull)
        speed = math.sqrt(packet.ahead * packet.ahead + packet.aside * packet.aside)
        if packet.named == 1 and speed > 0.0:
            direction = carried_over(math.atan2(packet.aside, packet.ahead), packet.bearing_of_me, packet.bearing)
            command.ahead += share * table.agreement * speed * math.cos(direction)
            command.aside += share * table.agreement * speed * math.sin(direction)
    if leader >= 0 and not printed and reading.packets[leader].range > table.separation_range:
        wanted_from(command, reading.packets[leader], table.leading)
    cut(command, table, limit)


@compiled
def wanted_from(command, packet, rate):
    """Add a velocity of ``rate`` (1/s) times the way to a neighbour."""
    command.ahead += rate * packet.range * math.cos(packet.bearing)
    command.aside += rate * packet.range * math.sin(packet.bearing)

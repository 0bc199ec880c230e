"""Where a robot is in the map's frame: told hop by hop from the master on, and kept by its own odometry."""

import math

from formicarium.angles import wrapped
from formicarium.compiled import compiled
from formicarium.control.bearings import carried_over


@compiled
def find_place(reading, memory, table):
    """Correct one's own place and heading a little by what the next robot on the way to the master says of its own.

    It stands at p_j, heads along h_j and sees this robot at the bearing M_ji and the range d: p_i = p_j +
    d (cos, sin)(h_j + M_ji). What leads along the map's x-axis has the bearing -h_j in its frame, which is carried over
    as the direction of an arm is (ST-36).
    """
    for k in range(reading.packet_count):
        packet = reading.packets[k]
        if packet.sender != memory.parent or packet.named == 0 or packet.term == 0 or packet.placed == 0:
            continue
        towards = packet.facing + packet.bearing_of_me
        ahead = packet.way_ahead + packet.range * math.cos(towards)
        aside = packet.way_aside + packet.range * math.sin(towards)
        facing = -carried_over(-packet.facing, packet.bearing_of_me, packet.bearing)
        share = table.placing_share if memory.placed == 1 else 1.0
        memory.way_ahead += share * (ahead - memory.way_ahead)
        memory.way_aside += share * (aside - memory.way_aside)
        memory.facing += share * wrapped(facing - memory.facing)
        memory.placed = 1

"""Into a booth by its light, and out of it by the compass (TP-34, TP-44)."""

import math

from formicarium.angles import wrapped
from formicarium.compiled import compiled
from formicarium.control.moves import drive, steer, stop
from formicarium.control.odometry import bearing_to, distance_to, place
from formicarium.robots.records import Colour
from formicarium.systems.partitioning.navigation import BACK, FORWARD, back_off, is_area, walk
from formicarium.systems.partitioning.perception import nearest_blob

FRONT_LEFT = 7  # sensor that looks ahead, like number 0: the only two that do not see the walls of a bay
RIGHT, LEFT = 2, 5  # sensors that look straight aside

GOING = 0  # results of ``dock``
ACKNOWLEDGED = 1
LOST = 2


@compiled
def sight_target(reading, memory, table, colour):
    """Find the light of the booth made for: the one nearest to where it should be, or, at first, to the robot."""
    best = -1
    if memory.target.known == 0:
        best = nearest_blob(reading, colour)
    else:
        nearest = table.target_gate
        for k in range(reading.blob_count):
            blob = reading.blobs[k]
            if blob.colour == colour:
                dx = blob.distance * math.cos(blob.bearing) - memory.target.x
                dy = blob.distance * math.sin(blob.bearing) - memory.target.y
                away = math.sqrt(dx * dx + dy * dy)
                if away < nearest:
                    nearest = away
                    best = k
    if best >= 0:
        blob = reading.blobs[best]
        place(memory.target, blob.distance, blob.bearing, reading.cycle)
        memory.target_seen = reading.cycle


@compiled
def dock(reading, memory, command, table, epuck, colour):
    """Drive into the booth whose light has this colour; return GOING, ACKNOWLEDGED or LOST.

    Acknowledged is a robot that has just seen the colour and now has red right before it. Blind it does not drive: the
    booth may have gone dark.
    """
    if memory.since == reading.cycle or memory.target.known == 0:
        memory.target.known = 0
        memory.target_seen = reading.cycle
    sight_target(reading, memory, table, colour)
    far = distance_to(memory.target) if memory.target.known == 1 else 10.0
    unseen = reading.cycle - memory.target_seen
    if red_ahead(reading, table) and memory.target.known == 1 and unseen <= table.blind_cycles:
        memory.target.known = 0
        stop(command)
        return ACKNOWLEDGED
    late = reading.cycle - memory.since > table.docking_patience
    if late:
        back_off(reading, memory, table)
    if late or unseen > table.lost_cycles or memory.target.known == 0:
        memory.target.known = 0
        if far < table.committed:
            begin_leaving(memory, reading.cycle, out_of(memory))
        return LOST
    direction = bearing_to(memory.target)
    if unseen > table.blind_cycles:
        stop(command)
    elif far > table.committed:
        walk(reading, memory, command, table, epuck, memory.compass + direction, table.speed)
    else:
        steer(command, direction, table.speed, table.steering_gain, table.turn_rate, epuck.wheel_distance)
    return GOING


@compiled
def out_of(memory):
    """Return the heading out of a booth that the robot faces: all booths open towards source or nest."""
    return BACK if math.cos(memory.compass) > 0.0 else FORWARD


@compiled
def red_ahead(reading, table):
    """Tell whether the robot has the red light of its own booth right before it."""
    red = nearest_blob(reading, Colour.RED)
    return red >= 0 and reading.blobs[red].distance < table.inside


@compiled
def walled(reading, memory, table):
    """Tell whether there are walls close by on both sides of a robot that faces into or out of a bay."""
    right = reading.proximity[RIGHT]
    left = reading.proximity[LEFT]
    level = math.fabs(math.cos(memory.compass)) > 0.7 and is_area(memory.ground)
    return level and min(left, right) > table.bay_least and left + right > table.bay_sum


@compiled
def strayed(reading, memory, table):
    """Tell whether the robot is in a bay without meaning to, with red right before it; get ready to leave it."""
    if not red_ahead(reading, table):
        return False
    begin_leaving(memory, reading.cycle, out_of(memory))
    return True


@compiled
def begin_leaving(memory, cycle, heading):
    """Get ready to leave a booth whose mouth lies in the direction ``heading``."""
    memory.leaving = 1
    memory.leaving_since = cycle
    memory.exit_heading = heading
    memory.travelled = 0.0
    memory.pressed = 0


@compiled
def leave(reading, memory, command, table, epuck):
    """Turn round in the bay and drive out; inside, who stands before the mouth is waited for."""
    error = wrapped(memory.exit_heading - memory.compass)
    if memory.leaving == 1:
        if math.fabs(error) > 0.1:
            drive(command, 0.0, math.copysign(table.turn_rate, error), epuck.wheel_distance)
            return
        memory.leaving = 2
        memory.leaving_since = reading.cycle
    if red_ahead(reading, table):
        begin_leaving(memory, reading.cycle, out_of(memory))  # it faces the back of the bay
        return
    inside = walled(reading, memory, table)
    blocked = max(reading.proximity[0], reading.proximity[FRONT_LEFT]) > table.exit_value
    if not blocked:
        memory.travelled += memory.odometer.forward
    if not inside:
        walk(reading, memory, command, table, epuck, memory.exit_heading, table.speed)
        late = reading.cycle - memory.leaving_since > table.exit_patience
        if late or memory.travelled > table.exit_distance:
            memory.leaving = 0
    elif not blocked:
        steer(command, error, table.speed, table.steering_gain, table.turn_rate, epuck.wheel_distance)

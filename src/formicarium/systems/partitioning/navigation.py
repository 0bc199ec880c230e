"""Ways to move between booths: walking round obstacles, through the corridor, looking about (TP-34).

Headings are the robot's own reckoning: 0 points from source to nest, a quarter turn away from the lamp.
"""

import math

from formicarium.angles import wrapped
from formicarium.compiled import compiled
from formicarium.control.moves import drive, steer
from formicarium.robots.epuck import PROXIMITY_COSINES, PROXIMITY_SINES
from formicarium.streams import advanced, uniform
from formicarium.systems.partitioning.memory import NEVER, Area, Ground

FORWARD = 0.0  # rad, from source to nest
AWAY = 0.5 * math.pi  # from the lamp
BACK = math.pi
DOWN = -0.5 * math.pi
AHEAD = 0.6  # cosine of a sensor's angle from which on it looks ahead


@compiled
def any_number(memory):
    """Draw a number in [0, 1) for the way."""
    memory.walks = advanced(memory.walks)
    return uniform(memory.walks)


@compiled
def obstacle_ahead(reading, table):
    """Return the greatest proximity ahead, above noise; 0 if nothing is there."""
    ahead = 0.0
    for k in range(len(reading.proximity)):
        if PROXIMITY_COSINES[k] > AHEAD:
            ahead = max(ahead, reading.proximity[k] - table.obstacle_value)
    return ahead


@compiled
def free_side(reading, memory, table):
    """Return the side on which to go round what is ahead: the freer one, or one drawn at random."""
    if table.keep_right == 1:
        return -1.0
    difference = 0.0
    for k in range(len(reading.proximity)):
        difference += reading.proximity[k] * PROXIMITY_SINES[k]
    if math.fabs(difference) < table.side_value:
        return -1.0 if any_number(memory) < 0.5 else 1.0
    return -1.0 if difference > 0.0 else 1.0


@compiled
def walk(reading, memory, command, table, epuck, heading, speed):
    """Walk towards a heading; obstacles and the lights of booths close by repel, and what is ahead is gone round.

    direction = goal - repulsion sum p_k s_k + swerve p_ahead side across, with sensor directions s_k.
    """
    direction = wrapped(heading - memory.compass)
    x = math.cos(direction)
    y = math.sin(direction)
    ahead = obstacle_ahead(reading, table)
    if ahead > 0.0:
        if reading.cycle >= memory.swerve_until:
            memory.swerve = free_side(reading, memory, table)
            memory.swerve_until = reading.cycle + table.swerve_cycles
        across = table.swerve * ahead * memory.swerve
        x, y = x - across * y, y + across * x
    for k in range(len(reading.proximity)):
        value = reading.proximity[k] - table.obstacle_value
        if value > 0.0:
            x -= table.repulsion * value * PROXIMITY_COSINES[k]
            y -= table.repulsion * value * PROXIMITY_SINES[k]
    for k in range(reading.blob_count):
        blob = reading.blobs[k]
        if blob.distance < table.mouth_distance:
            x -= table.mouth_repulsion * math.cos(blob.bearing)
            y -= table.mouth_repulsion * math.sin(blob.bearing)
    slow = speed * (1.0 - ahead)
    steer(command, math.atan2(y, x), slow, table.steering_gain, table.turn_rate, epuck.wheel_distance)
    if ahead > table.pressed_value:
        memory.pressed += 1
    else:
        memory.pressed = max(0, memory.pressed - 2)


@compiled
def escape(reading, memory, command, table, epuck):
    """Back off while turning, if stuck; tell whether the robot is doing so."""
    if memory.pressed > table.pressed_cycles:
        back_off(reading, memory, table)
    if reading.cycle >= memory.escape_until:
        return False
    behind = 0.0
    for k in range(len(reading.proximity)):
        if PROXIMITY_COSINES[k] < 0.0:
            behind = max(behind, reading.proximity[k])
    speed = 0.0 if behind > table.pressed_value else -0.5 * table.speed
    drive(command, speed, memory.escape_turn * 0.5 * table.turn_rate, epuck.wheel_distance)
    return True


@compiled
def back_off(reading, memory, table):
    """Begin to back off, turning to a side drawn at random."""
    memory.pressed = 0
    memory.escapes += 1
    memory.escape_until = reading.cycle + int(table.escape_cycles * (1.0 + any_number(memory)))
    memory.escape_turn = -1.0 if any_number(memory) < 0.5 else 1.0


@compiled
def is_area(place):
    """Tell whether a place is outside the corridor."""
    in_corridor = place == Ground.LEFT_LEG or place == Ground.BOTTOM or place == Ground.RIGHT_LEG
    return not in_corridor and place != Ground.MIDDLE_LEG and place != Ground.CROSSING


@compiled
def corridor_heading(memory, chart, area):
    """Return where to go from here to get to an area through the corridor: down, along the bottom, up.

    Along the bottom the lamp tells when to turn: at the end it lies well behind, and it stands before the middle leg.
    """
    place = memory.ground
    if place == Ground.DROP_ZONE:
        return BACK if area == Area.SOURCE else DOWN - 0.8
    if place == Ground.PICK_ZONE:
        return FORWARD if area == Area.NEST else DOWN + 0.8
    if place == Ground.SOURCE_AREA or place == Ground.LEFT_LEG:
        return AWAY if area == Area.SOURCE else DOWN
    if place == Ground.NEST_AREA or place == Ground.RIGHT_LEG:
        return AWAY if area == Area.NEST else DOWN
    if place == Ground.MIDDLE_PICK_ZONE:
        return FORWARD if area == Area.MIDDLE else DOWN + 0.8
    if place == Ground.MIDDLE_DROP_ZONE:
        return BACK if area == Area.MIDDLE else DOWN - 0.8
    if place == Ground.MIDDLE_AREA or place == Ground.MIDDLE_LEG:
        return AWAY if area == Area.MIDDLE else DOWN
    lamp_ahead = math.cos(memory.compass + memory.lamp)
    if area == Area.MIDDLE:
        if place == Ground.CROSSING:
            return AWAY
        return FORWARD if lamp_ahead > 0.0 else BACK
    side = 1.0 if area == Area.NEST else -1.0
    if lamp_ahead * side < -chart.lamp_behind:
        return AWAY
    return FORWARD if area == Area.NEST else BACK


@compiled
def follow_corridor(reading, memory, command, table, chart, epuck, area):
    """Walk through the corridor, on the path where it is found, back to it where it was left."""
    heading = corridor_heading(memory, chart, area)
    if not is_area(memory.ground):
        unseen = reading.cycle - memory.path_seen
        if unseen > table.path_patience:
            memory.path_side = 1 if any_number(memory) < 0.5 else -1
            memory.path_seen = reading.cycle
        heading += memory.path_side * (table.path_nudge if unseen == 0 else table.path_return)
    walk(reading, memory, command, table, epuck, heading, table.speed)


@compiled
def look(reading, memory, command, table, epuck, heading):
    """Turn on the spot to both sides of a heading, and give way to who comes near."""
    if memory.look_side == 0.0:
        memory.look_side = 1.0
    error = wrapped(heading + memory.look_side * table.look_half_width - memory.compass)
    if math.fabs(error) < 0.1:
        memory.look_side = -memory.look_side
        memory.looks += 1
    near = 0.0
    for k in range(len(reading.proximity)):
        near = max(near, reading.proximity[k])
    if near > table.pressed_value:
        walk(reading, memory, command, table, epuck, memory.compass, 0.5 * table.speed)
    else:
        drive(command, 0.0, math.copysign(table.turn_rate, error), epuck.wheel_distance)


@compiled
def look_about(reading, memory, command, table, epuck, heading, speed):
    """Look round a heading, walk a little, more or less the other way, and look again.

    Away from the booths looked for: more of them are in view from there, and their mouths stay clear.
    """
    if reading.cycle < memory.roam_until:
        walk(reading, memory, command, table, epuck, memory.roam_heading, speed)
    elif memory.looks < 2:
        look(reading, memory, command, table, epuck, heading)
        if memory.looks == 2:
            memory.roam_until = reading.cycle + int(table.roam_cycles * (1.0 + any_number(memory)))
            memory.roam_heading = wrapped(heading + BACK + table.roam_spread * (2.0 * any_number(memory) - 1.0))
    else:
        memory.looks = 0
        memory.roam_until = NEVER
        look(reading, memory, command, table, epuck, heading)


@compiled
def arrive(reading, memory, cycles):
    """Come out of the corridor, or stray back into it: walk on into the area for so long before looking about."""
    memory.looks = 2
    memory.roam_until = reading.cycle + cycles
    memory.roam_heading = AWAY

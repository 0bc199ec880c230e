"""The link of a chain (section 7; Fig. S6): keeps distance and alignment with its two neighbours until told to stay."""

import math

from formicarium.compiled import compiled
from formicarium.angles import wrapped
from formicarium.control.moves import shift
from formicarium.control.odometry import bearing_to
from formicarium.robots.records import Colour
from formicarium.systems.sequencing.member import begin_message, distance_error, send
from formicarium.systems.sequencing.memory import Role, State, enter
from formicarium.systems.sequencing.perception import track_neighbours

ALIGNED = 1e-9  # below this the mean direction of the neighbours is undefined: perfectly aligned


@compiled
def become_link(memory, cycle):
    """Turn from tail to link; the place in the branch stays."""
    memory.role = Role.LINK
    enter(memory, State.STAY, cycle)


@compiled
def distance_component(predecessor, successor, spacing, tolerance):
    """Return (x, y, error): a unit vector to or from the neighbour whose distance is most wrong (TS-67).

    Zero within the tolerance. ``error`` is that neighbour's distance less ``spacing``, m.
    """
    behind = distance_error(predecessor, spacing)
    ahead = distance_error(successor, spacing)
    worst = behind if abs(behind) > abs(ahead) else ahead
    if abs(worst) <= tolerance:
        return 0.0, 0.0, worst
    bearing = bearing_to(predecessor) if abs(behind) > abs(ahead) else bearing_to(successor)
    sign = 1.0 if worst > 0.0 else -1.0
    return sign * math.cos(bearing), sign * math.sin(bearing), worst


@compiled
def alignment_component(alpha, beta, tolerance):
    """Return (x, y, error): a unit vector at gamma, the mean direction of the neighbours' bearings (TS-68).

    gamma = atan2(sin alpha + sin beta, cos alpha + cos beta); error = pi - |alpha - beta|, in [0, pi] (TS-69).
    Zero within the tolerance and where gamma is undefined.
    """
    error = math.pi - abs(wrapped(alpha - beta))
    y = math.sin(alpha) + math.sin(beta)
    x = math.cos(alpha) + math.cos(beta)
    length = math.sqrt(x * x + y * y)
    if error <= tolerance or length < ALIGNED:
        return 0.0, 0.0, error
    return x / length, y / length, error


@compiled
def keep_in_line(predecessor, successor, command, table, tolerance, wheel_distance):
    """Move by the sum of the distance and the alignment component; tell whether both were within tolerance.

    Full speed at an error of twice the printed tolerance, less in proportion below (TS-74).
    """
    distance_x, distance_y, gap = distance_component(predecessor, successor, table.spacing, tolerance)
    align_x, align_y, angle = alignment_component(
        bearing_to(successor), bearing_to(predecessor), table.alignment_tolerance
    )
    x = distance_x + align_x
    y = distance_y + align_y
    if x * x + y * y < ALIGNED:
        return distance_x == 0.0 and align_x == 0.0 and distance_y == 0.0 and align_y == 0.0
    urgency = max(
        abs(gap) / (2.0 * table.spacing_tolerance) if distance_x != 0.0 or distance_y != 0.0 else 0.0,
        angle / (2.0 * table.alignment_tolerance) if align_x != 0.0 or align_y != 0.0 else 0.0,
    )
    speed = table.member_speed * min(1.0, urgency)
    shift(command, math.atan2(y, x), speed, table.steering_gain, table.turn_rate, wheel_distance)
    return False


@compiled
def in_view(track, cycle, table):
    """Tell whether a neighbour has been seen lately."""
    return track.known == 1 and cycle - track.seen <= table.track_lost


@compiled
def hear_established(reading, memory):
    """Tell whether the branch is complete: the guardian it reached, or a link beyond, says so (TS-51)."""
    for n in range(reading.packet_count):
        message = memory.heard[n]
        if message.established == 0:
            continue
        if message.guardian == 1 and message.branch == memory.branch + 1:
            return True
        if message.guardian == 0 and message.link_number > 0 and message.branch == memory.branch:
            return True
    return False


@compiled
def speak(reading, memory, command):
    """Broadcast place, branch and whether it is established (TS-71)."""
    begin_message(memory, reading.identity)
    memory.message.branch = memory.branch
    memory.message.link_number = memory.link_number
    memory.message.established = memory.established
    send(memory, command)


@compiled
def link(reading, memory, command, table, epuck):
    """Live one cycle as a link."""
    command.colour = Colour.YELLOW
    if memory.established == 0:
        track_neighbours(reading, memory, table)
        cycle = reading.cycle
        if in_view(memory.predecessor, cycle, table) and in_view(memory.successor, cycle, table):
            keep_in_line(
                memory.predecessor, memory.successor, command, table, table.spacing_tolerance, epuck.wheel_distance
            )
        if hear_established(reading, memory):
            memory.established = 1
    speak(reading, memory, command)

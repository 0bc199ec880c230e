"""The link of a chain (section 7; Fig. S6): keeps distance and alignment with its two neighbours until told to stay."""

import math

from formicarium.angles import wrapped
from formicarium.compiled import compiled
from formicarium.control.moves import shift
from formicarium.control.odometry import bearing_to
from formicarium.robots.records import Colour
from formicarium.systems.sequencing.member import begin_message, distance_error, send
from formicarium.systems.sequencing.memory import Role, State, enter
from formicarium.systems.sequencing.perception import track_neighbours
from formicarium.systems.sequencing.ring import is_word_of, repeat

ALIGNED = 1e-9  # a sum of unit vectors shorter than this has no direction


@compiled
def become_link(memory, cycle):
    """Turn from tail to link; the place in the branch stays."""
    memory.role = Role.LINK
    enter(memory, State.STAY, cycle)


@compiled
def distance_component(predecessor, successor, spacing):
    """Return (x, y, error): a unit vector to or from the neighbour whose distance is most wrong (TS-67).

    ``error`` is that neighbour's distance less ``spacing``, m.
    """
    behind = distance_error(predecessor, spacing)
    ahead = distance_error(successor, spacing)
    bearing = bearing_to(predecessor) if abs(behind) > abs(ahead) else bearing_to(successor)
    worst = behind if abs(behind) > abs(ahead) else ahead
    sign = 1.0 if worst > 0.0 else -1.0
    return sign * math.cos(bearing), sign * math.sin(bearing), worst


@compiled
def alignment_component(alpha, beta):
    """Return (x, y, error): a unit vector at gamma, the mean direction of the neighbours' bearings (TS-68).

    gamma = atan2(sin alpha + sin beta, cos alpha + cos beta), zero vector where that is undefined;
    error = pi - |alpha - beta|, in [0, pi] (TS-69).
    """
    error = math.pi - abs(wrapped(alpha - beta))
    y = math.sin(alpha) + math.sin(beta)
    x = math.cos(alpha) + math.cos(beta)
    length = math.sqrt(x * x + y * y)
    if length < ALIGNED:
        return 0.0, 0.0, error
    return x / length, y / length, error


@compiled
def keep_in_line(predecessor, successor, command, table, tolerance, share, wheel_distance):
    """Move by the sum of the distance and the alignment component; tell whether there was nothing to mend.

    It rests while both errors are within ``share`` of their tolerances and else mends both ("every movement of a
    link consists of two components", Fig. S6): each counts in proportion to its error, fully from the tolerance on.
    With ``separate_tolerances`` a component within its tolerance is left out; then aligning shortens the branch.
    """
    distance_x, distance_y, gap = distance_component(predecessor, successor, table.spacing)
    align_x, align_y, angle = alignment_component(bearing_to(successor), bearing_to(predecessor))
    far = abs(gap) > share * tolerance
    askew = angle > share * table.alignment_tolerance
    if not far and not askew:
        return True
    distance_weight = min(1.0, abs(gap) / tolerance)
    align_weight = min(1.0, angle / table.alignment_tolerance)
    if table.separate_tolerances == 1:
        distance_weight = 1.0 if far else 0.0
        align_weight = 1.0 if askew else 0.0
    x = distance_weight * distance_x + align_weight * align_x
    y = distance_weight * distance_y + align_weight * align_y
    urgency = math.sqrt(x * x + y * y)
    if urgency < ALIGNED:
        return False  # the components cancel: no direction to move in
    speed = table.member_speed * min(1.0, urgency)
    shift(command, math.atan2(y, x), speed, table.steering_gain, table.turn_rate, wheel_distance)
    return False


@compiled
def adjust(memory, command, table, cycle, wheel_distance):
    """Stay while within tolerance; once out of it, mend until well within (TS-69)."""
    share = table.mending_share if memory.state == State.MEND else 1.0
    tolerance = table.spacing_tolerance
    if keep_in_line(memory.predecessor, memory.successor, command, table, tolerance, share, wheel_distance):
        if memory.state == State.MEND:
            enter(memory, State.STAY, cycle)
    elif memory.state == State.STAY:
        enter(memory, State.MEND, cycle)


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
def hear_successor(reading, memory):
    """Learn from the successor, known by its identity, that the branch is established; then repeat its words (U51)."""
    for n in range(reading.packet_count):
        message = memory.heard[n]
        if message.established == 1 and is_word_of(message, memory.chosen):
            if memory.established == 0:
                memory.established = 1
                enter(memory, State.STAY, reading.cycle)
            repeat(memory.ring, message)


@compiled
def speak(reading, memory, command, table):
    """Broadcast place, branch and whether it is established (TS-71); once it is, the words of the loop too."""
    begin_message(memory, reading.identity)
    message = memory.message
    message.branch = memory.branch
    message.link_number = memory.link_number
    message.established = memory.established
    message.source = memory.branch
    if memory.established == 1:
        message.election = memory.ring.election
        message.number = memory.ring.number
        message.report = memory.ring.solved
        message.source = memory.ring.source
    send(memory, command, table)


@compiled
def link(reading, memory, command, table, epuck):
    """Live one cycle as a link."""
    command.colour = Colour.YELLOW
    if memory.established == 0:
        track_neighbours(reading, memory, table)
        cycle = reading.cycle
        if in_view(memory.predecessor, cycle, table) and in_view(memory.successor, cycle, table):
            adjust(memory, command, table, cycle, epuck.wheel_distance)
        if table.mark == 1 and hear_established(reading, memory):
            memory.established = 1
            enter(memory, State.STAY, cycle)
    if table.mark == 2:
        hear_successor(reading, memory)
    speak(reading, memory, command, table)

"""The tail of a growing branch (section 8; Figs S7 to S9): recruits, sweeps, finds the next guardian, hands over."""

import math

from formicarium.angles import wrapped
from formicarium.compiled import compiled
from formicarium.control.moves import shift, stop
from formicarium.control.odometry import bearing_to, distance_to, place
from formicarium.control.speech import in_sector
from formicarium.robots.records import Colour
from formicarium.systems.sequencing import link
from formicarium.systems.sequencing.link import become_link, keep_in_line
from formicarium.systems.sequencing.member import (
    begin_message,
    branch_direction,
    distance_error,
    hear_requests,
    relieved,
    send,
    send_invitation,
)
from formicarium.systems.sequencing.memory import COLOURS, Role, State, enter
from formicarium.systems.sequencing.messages import LINK_NUMBER_LIMIT
from formicarium.systems.sequencing.perception import guarded_colour, track_neighbours
from formicarium.systems.sequencing.ring import is_word_of

CYCLE_TIME = 0.1  # s, the paper's control period
WHOLE = 1.0  # share of the tolerances within which a docking tail is in line
SERVO_GAIN = 2.0  # 1/s, speed per distance error of the tail


@compiled
def become_tail(reading, memory, table, n):
    """Take over from the sender of the n-th packet, a T_RES with the own identity."""
    message = memory.heard[n]
    memory.role = Role.TAIL
    memory.branch = message.branch
    memory.link_number = min(LINK_NUMBER_LIMIT, message.link_number + 1)
    memory.established = 0
    memory.chosen = 0
    memory.asked = 0
    memory.successor.known = 0
    memory.requested = reading.cycle
    memory.sweep_due = table.sweep_idle
    memory.settled = reading.cycle
    memory.count = 0
    memory.notifying = 0
    packet = reading.packets[n]
    place(memory.predecessor, packet.distance, packet.bearing, reading.cycle)
    wanted = Colour.CYAN if message.guardian == 1 else Colour.MAGENTA
    for k in range(reading.blob_count):
        blob = reading.blobs[k]
        if blob.colour == wanted and in_sector(blob.bearing, packet.bearing, table.advert_gate):
            place(memory.predecessor, blob.distance, blob.bearing, reading.cycle)
            break
    enter(memory, State.POSITION, reading.cycle)


@compiled
def radial_speed(memory, table):
    """Return the speed away from the predecessor that restores the spacing; 0 within the dead band (m/s)."""
    error = -distance_error(memory.predecessor, table.spacing)
    if abs(error) <= table.position_band:
        return 0.0
    return min(table.member_speed, max(-table.member_speed, SERVO_GAIN * error))


@compiled
def move(memory, command, outward, leftward, table, wheel_distance):
    """Move with given speeds along the branch direction and to its left (m/s)."""
    if outward == 0.0 and leftward == 0.0:
        stop(command)
        return
    direction = wrapped(branch_direction(memory) + math.atan2(leftward, outward))
    speed = math.sqrt(outward * outward + leftward * leftward)
    shift(command, direction, speed, table.steering_gain, table.turn_rate, wheel_distance)


@compiled
def is_free(advert, memory, table):
    """Tell whether a guardian may be docked at: reached by no chain yet, and not where the branch starts (U23)."""
    if table.mark == 2:
        return advert.established == 0 and advert.identity != memory.branch
    return advert.in_chain == 0 and advert.tail == 0


@compiled
def spot_guardian(reading, memory, table):
    """Look for a guardian that no chain has reached yet, ahead of the branch (TS-86); sight, then message.

    Sets ``chosen`` and the successor's track and tells whether one was found.
    """
    direction = branch_direction(memory)
    for n in range(reading.blob_count):
        blob = reading.blobs[n]
        if blob.colour != Colour.CYAN or not in_sector(blob.bearing, direction, table.dock_ahead):
            continue
        colour = guarded_colour(memory, blob.bearing, reading.cycle, table)
        if colour == 0:
            continue
        advert = memory.adverts[colour]
        if advert.identity != 0 and is_free(advert, memory, table):
            memory.chosen = advert.identity
            place(memory.successor, blob.distance, blob.bearing, reading.cycle)
            return True
    return False


@compiled
def recruits_for_gap(memory, table, cycle):
    """Tell whether the guardian is too far for this tail alone, so that one more robot is needed (U21).

    In Mark II the tail first pulls the branch forward (TS-87): there are runners round the guardian at once, and each
    that is recruited in haste bends the branch.
    """
    wide = distance_to(memory.predecessor) + distance_to(memory.successor) > table.dock_gaps
    return wide and (table.mark == 1 or cycle - memory.since > table.pull_patience)


@compiled
def hear_guardian(reading, memory, table):
    """Tell whether the guardian has taken over: EST with BRN one above the branch's (TS-50).

    In Mark II, where there is no BRN: EST of the guardian that this tail has asked.
    """
    for n in range(reading.packet_count):
        message = memory.heard[n]
        if message.guardian == 0 or message.established == 0:
            continue
        if message.branch == memory.branch + 1 if table.mark == 1 else is_word_of(message, memory.asked):
            return True
    return False


@compiled
def open_branch(reading, memory, command, table, epuck):
    """Hold the spacing, invite a successor, and see to it that a stuck branch sweeps.

    In Mark II a guardian in view comes before any request: runners go round it already, and one that stands beyond
    it would lead the branch past it.
    """
    cycle = reading.cycle
    move(memory, command, radial_speed(memory, table), 0.0, table, epuck.wheel_distance)
    if table.mark == 1 or not spot_guardian(reading, memory, table):
        hear_requests(reading, memory, table)
    if memory.state == State.OPEN:
        if spot_guardian(reading, memory, table):
            memory.settled = cycle
            enter(memory, State.DOCK, cycle)
        elif cycle - memory.requested > memory.sweep_due:
            enter(memory, State.SWEEP, cycle)


@compiled
def burst(memory, table):
    """Return how long to sweep, cycles: until the branch, link_number * spacing long, has turned by one step.

    The tip of a long branch pauses earlier: the links behind it must keep up.
    """
    length = memory.link_number * table.spacing
    turning = int(table.sweep_angle * length / table.sweep_speed / CYCLE_TIME)
    return min(table.sweep_burst, max(1, turning))


@compiled
def pause_to_realign(memory, table):
    """Return how long the branch is given to realign, cycles: a movement of the tip runs through it link by link."""
    return table.sweep_pause + table.sweep_pause_per_link * memory.link_number


@compiled
def sweep(reading, memory, command, table, epuck):
    """Move slowly to the left of the branch for one burst (TS-84), then pause."""
    cycle = reading.cycle
    move(memory, command, radial_speed(memory, table), table.sweep_speed, table, epuck.wheel_distance)
    if spot_guardian(reading, memory, table):
        memory.settled = cycle
        enter(memory, State.DOCK, cycle)
    elif cycle - memory.since >= burst(memory, table):
        memory.requested = cycle
        memory.sweep_due = pause_to_realign(memory, table)
        enter(memory, State.OPEN, cycle)


@compiled
def is_taken(memory, table):
    """Tell whether another branch has reached the guardian before this tail could ask it (Mark II)."""
    if table.mark == 1 or memory.asked == memory.chosen:
        return False
    for c in range(1, COLOURS):
        if memory.adverts[c].identity == memory.chosen and memory.adverts[c].established == 1:
            return True
    return False


@compiled
def dock(reading, memory, command, table, epuck):
    """Align with predecessor and guardian; recruit one more robot if the gap is too wide (TS-87)."""
    cycle = reading.cycle
    if cycle - memory.successor.seen > table.track_lost or is_taken(memory, table):
        memory.chosen = 0
        memory.successor.known = 0
        memory.requested = cycle
        memory.sweep_due = pause_to_realign(memory, table)
        enter(memory, State.OPEN, cycle)
        return
    if recruits_for_gap(memory, table, reading.cycle):
        memory.settled = cycle
        move(memory, command, radial_speed(memory, table), 0.0, table, epuck.wheel_distance)
        hear_requests(reading, memory, table)
        return
    behind, ahead, tolerance = memory.predecessor, memory.successor, table.dock_band
    if not keep_in_line(behind, ahead, command, table, tolerance, WHOLE, epuck.wheel_distance):
        memory.settled = cycle


@compiled
def hands_over(reading, memory, table):
    """Tell whether a docking tail is aligned long enough, or has tried long enough, to hand over."""
    if memory.state != State.DOCK or recruits_for_gap(memory, table, reading.cycle):
        return False
    cycle = reading.cycle
    return cycle - memory.settled >= table.dock_hold or cycle - memory.since >= table.dock_patience


@compiled
def speak(reading, memory, command, table):
    """Announce the tail; invite through the sector, or answer the chosen one in all directions."""
    if memory.role == Role.LINK:
        link.speak(reading, memory, command, table)
        return
    begin_message(memory, reading.identity)
    memory.message.tail = 1
    memory.message.branch = memory.branch
    memory.message.source = memory.branch
    memory.message.link_number = memory.link_number
    asks = hands_over(reading, memory, table)
    if memory.state == State.OFFER or asks:
        memory.message.request = 1
        memory.message.identity = memory.chosen
        memory.asked = memory.chosen if asks else memory.asked
        send(memory, command, table)
    elif memory.state == State.OPEN:
        send_invitation(memory, command, branch_direction(memory), table)
    elif memory.state == State.DOCK and recruits_for_gap(memory, table, reading.cycle):
        send_invitation(memory, command, bearing_to(memory.successor), table)
    else:
        send(memory, command, table)


@compiled
def tail(reading, memory, command, table, epuck):
    """Live one cycle as a tail."""
    cycle = reading.cycle
    command.colour = Colour.MAGENTA
    track_neighbours(reading, memory, table)
    if hear_guardian(reading, memory, table):
        become_link(memory, cycle)
        memory.established = 1
        if table.mark == 2:
            memory.chosen = memory.asked
    elif memory.state != State.DOCK and relieved(reading, memory, table):
        become_link(memory, cycle)
    elif memory.state == State.POSITION:
        move(memory, command, radial_speed(memory, table), 0.0, table, epuck.wheel_distance)
        if abs(distance_error(memory.predecessor, table.spacing)) > table.spacing_tolerance:
            memory.settled = cycle
        if cycle - memory.settled >= table.position_hold:
            memory.requested = cycle
            enter(memory, State.OPEN, cycle)
    elif memory.state == State.OPEN:
        open_branch(reading, memory, command, table, epuck)
    elif memory.state == State.OFFER:
        if cycle - memory.since > table.offer_patience:
            enter(memory, State.OPEN, cycle)
    elif memory.state == State.SWEEP:
        sweep(reading, memory, command, table, epuck)
    elif memory.state == State.DOCK:
        dock(reading, memory, command, table, epuck)
    speak(reading, memory, command, table)

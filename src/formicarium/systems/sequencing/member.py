"""What all chain members do alike: invite, choose and be relieved (the T protocol, Table S2), and speak."""

import math

from formicarium.angles import wrapped
from formicarium.compiled import compiled
from formicarium.control.odometry import bearing_to, distance_to, place
from formicarium.control.speech import broadcast, emitter_direction, in_sector
from formicarium.robots.records import EMITTERS, Colour
from formicarium.systems.sequencing.memory import State, enter
from formicarium.systems.sequencing.messages import clear, encode, from_runner
from formicarium.systems.sequencing.messages_ii import encode_ii

SUCCESSOR_REACH = 0.30  # m, a magenta light this near in the sector ends an offer (TS-80)


@compiled
def begin_message(memory, identity):
    """Start this cycle's message with the robot's own identity."""
    clear(memory.message)
    memory.message.identity = identity


@compiled
def write(message, payload, table):
    """Write a message into four bytes as the Mark has them."""
    if table.mark == 2:
        encode_ii(message, payload)
    else:
        encode(message, payload)


@compiled
def send(memory, command, table):
    """Send the message in all directions."""
    write(memory.message, command.payload[0], table)
    broadcast(command)


@compiled
def send_invitation(memory, command, sector, table):
    """Send the message in all directions, as T_DIR through the emitters within the sector."""
    memory.sector = sector
    memory.message.direction = 0
    write(memory.message, command.payload[0], table)
    broadcast(command)
    memory.message.direction = 1
    for k in range(EMITTERS):
        if in_sector(emitter_direction(k), sector, table.sector_half_width + 1e-9):
            write(memory.message, command.payload[k], table)


@compiled
def hear_requests(reading, memory, table):
    """Choose the first runner whose request comes from the invited sector (first come, first served)."""
    for n in range(reading.packet_count):
        message = memory.heard[n]
        if message.request == 0 or not from_runner(message):
            continue
        bearing = reading.packets[n].bearing
        if not in_sector(bearing, memory.sector, table.sector_half_width + table.sector_tolerance):
            continue
        memory.requested = reading.cycle
        memory.sweep_due = table.sweep_idle
        memory.chosen = message.identity
        enter(memory, State.OFFER, reading.cycle)
        return


@compiled
def relieved(reading, memory, table):
    """Tell whether the chosen runner has taken over: its T_ACK came, or a magenta light stands in the sector.

    A request names no tail, so in Mark II two may choose the same runner: it takes over on its own branch alone.
    The light counts only while the offer is pending; the acknowledgement counts for ever, so that a lost one
    is made good by the successor's next message (TS-83). Sets the successor's track.
    """
    for n in range(reading.packet_count):
        message = memory.heard[n]
        if memory.chosen != 0 and message.tail == 1 and message.guardian == 0 and message.request == 0:
            if message.identity == memory.chosen and (table.mark == 1 or message.branch == memory.branch):
                packet = reading.packets[n]
                place(memory.successor, packet.distance, packet.bearing, reading.cycle)
                take_light(reading, memory, packet.bearing, table.refind_gate)
                return True
    if memory.state == State.OFFER and (table.mark == 1 or light_counts(reading, memory, table)):
        return take_light(reading, memory, memory.sector, table.sector_half_width)
    return False


@compiled
def light_counts(reading, memory, table):
    """Tell whether a magenta light can only be the successor's, where there are several tails (TS-80, C18).

    It may be another branch's, or the chosen runner may have gone there. So the light counts only if the
    acknowledgement has not come for a while and no tail of another branch has been heard in the meantime.
    """
    for n in range(reading.packet_count):
        message = memory.heard[n]
        if message.tail == 1 and message.guardian == 0 and message.branch != memory.branch:
            memory.stranger_heard = reading.cycle
    return reading.cycle - max(memory.since, memory.stranger_heard) > table.light_patience


@compiled
def take_light(reading, memory, bearing, gate):
    """Put the successor's track on the nearest magenta light within ``gate`` of a bearing, if there is one."""
    for n in range(reading.blob_count):
        blob = reading.blobs[n]
        if blob.colour == Colour.MAGENTA and blob.distance <= SUCCESSOR_REACH:
            if abs(wrapped(blob.bearing - bearing)) <= gate:
                place(memory.successor, blob.distance, blob.bearing, reading.cycle)
                return True
    return False


@compiled
def branch_direction(memory):
    """Return where the branch goes on: the prolongation of predecessor -> self (rad, robot frame)."""
    return wrapped(bearing_to(memory.predecessor) + math.pi)


@compiled
def distance_error(track, spacing):
    """Return how much farther than wanted a neighbour is, m."""
    return distance_to(track) - spacing

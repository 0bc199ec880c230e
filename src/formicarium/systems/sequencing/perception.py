"""What a robot makes of its readings before it decides: tracks, decoded packets, who stands where."""

import math

from formicarium.angles import wrapped
from formicarium.compiled import compiled
from formicarium.control.odometry import carry, measure, place
from formicarium.robots.records import Colour
from formicarium.systems.sequencing.memory import COLOURS
from formicarium.systems.sequencing.messages import decode, from_runner
from formicarium.systems.sequencing.messages_ii import decode_ii

ADVERT_GAIN = 0.3  # share of a new packet in the remembered bearing of a guardian


@compiled
def perceive(reading, memory, table, epuck):
    """Bring the memory up to date with this cycle's readings."""
    measure(memory.odometer, reading, epuck)
    memory.travelled += memory.odometer.forward
    carry(memory.predecessor, memory.odometer)
    carry(memory.successor, memory.odometer)
    carry(memory.target, memory.odometer)
    memory.sector = wrapped(memory.sector - memory.odometer.turn)
    for c in range(1, COLOURS):
        advert = memory.adverts[c]
        advert.bearing = wrapped(advert.bearing - memory.odometer.turn)
    for n in range(reading.packet_count):
        packet = reading.packets[n]
        message = memory.heard[n]
        if table.mark == 2:
            decode_ii(packet.payload, message)
        else:
            decode(packet.payload, message)
        if message.guardian == 1 and 0 < message.colour < COLOURS:
            keep_advert(memory.adverts[message.colour], message, packet.bearing, reading.cycle, table)
        near = packet.distance < table.inhibition_distance
        if message.inhibit == 1 and message.identity != reading.identity and near:
            hear_inhibition(memory, message, packet.bearing, reading.cycle, table)


@compiled
def hear_inhibition(memory, message, bearing, cycle, table):
    """Remember an inhibition: whose, when, whether from ahead, and whether a guardian repeats it."""
    memory.inhibitor = message.identity
    memory.inhibition_heard = cycle
    if abs(bearing) < table.inhibition_ahead:
        memory.inhibition_ahead = cycle
    if message.guardian == 1:
        memory.echo_heard = cycle


@compiled
def keep_advert(advert, message, bearing, cycle, table):
    """Remember what a guardian advertises and where it stands."""
    if cycle - advert.heard > table.advert_memory:
        advert.bearing = bearing
    else:
        advert.bearing = wrapped(advert.bearing + ADVERT_GAIN * wrapped(bearing - advert.bearing))
    advert.heard = cycle
    advert.branch = message.branch
    advert.in_chain = message.in_chain
    advert.established = message.established
    advert.tail = message.tail
    advert.count = message.count
    advert.confident = message.confident
    advert.number = message.number
    advert.solved = message.report
    if message.inhibit == 0 and message.request == 0:  # else DATA[0] carries somebody else's identity
        advert.identity = message.identity


@compiled
def guarded_colour(memory, bearing, cycle, table):
    """Return the task colour of the guardian that is the cyan light at ``bearing``, 0 if it was not heard."""
    found = 0
    best = table.advert_gate
    for c in range(1, COLOURS):
        advert = memory.adverts[c]
        if cycle - advert.heard <= table.advert_memory:
            error = abs(wrapped(advert.bearing - bearing))
            if error < best:
                best = error
                found = c
    return found


@compiled
def is_member(blob, memory, cycle, table):
    """Tell whether a blob is a member of a chain. Guardians without a chain are not followed."""
    if blob.colour == Colour.YELLOW or blob.colour == Colour.MAGENTA:
        return True
    if blob.colour != Colour.CYAN:
        return False
    colour = guarded_colour(memory, blob.bearing, cycle, table)
    return colour != 0 and (memory.adverts[colour].in_chain == 1 or memory.adverts[colour].tail == 1)


@compiled
def nearest_blob(reading, colour, bearing, gate, reach):
    """Return the index of the nearest blob of a colour within ``gate`` rad of a bearing, -1 if there is none."""
    for n in range(reading.blob_count):  # nearest first
        blob = reading.blobs[n]
        if blob.distance > reach:
            return -1
        if blob.colour == colour and abs(wrapped(blob.bearing - bearing)) <= gate:
            return n
    return -1


@compiled
def locate_lights(reading, track, colour):
    """Set a track to the middle of the visible lights of one colour; tell whether there were any."""
    x = 0.0
    y = 0.0
    lights = 0
    for n in range(reading.blob_count):
        blob = reading.blobs[n]
        if blob.colour == colour:
            x += blob.distance * math.cos(blob.bearing)
            y += blob.distance * math.sin(blob.bearing)
            lights += 1
    if lights == 0:
        return False
    track.known = 1
    track.x = x / lights
    track.y = y / lights
    track.seen = reading.cycle
    return True


@compiled
def follow_track(track, reading, table):
    """Draw a tracked neighbour towards the chain member's light that is nearest to where it should be."""
    best = table.track_gate * table.track_gate
    x = 0.0
    y = 0.0
    found = False
    for n in range(reading.blob_count):
        blob = reading.blobs[n]
        if blob.colour < Colour.CYAN:
            continue
        dx = blob.distance * math.cos(blob.bearing) - track.x
        dy = blob.distance * math.sin(blob.bearing) - track.y
        if dx * dx + dy * dy < best:
            best = dx * dx + dy * dy
            x = dx
            y = dy
            found = True
    if found:
        track.x += table.track_gain * x
        track.y += table.track_gain * y
        track.seen = reading.cycle


@compiled
def find_by_bearing(track, reading, bearing, table):
    """Set a track to the nearest chain member's light in the direction of a packet."""
    for n in range(reading.blob_count):
        blob = reading.blobs[n]
        if blob.colour >= Colour.CYAN and abs(wrapped(blob.bearing - bearing)) <= table.refind_gate:
            place(track, blob.distance, blob.bearing, reading.cycle)
            return


@compiled
def coincide(first, second, table):
    """Tell whether two tracks have fallen onto the same robot: nearer to each other than two robots can be."""
    dx = first.x - second.x
    dy = first.y - second.y
    return first.known == 1 and second.known == 1 and dx * dx + dy * dy < (0.5 * table.track_gate) ** 2


@compiled
def track_neighbours(reading, memory, table):
    """Keep predecessor and successor in view; look for a lost one by its packets (LNK_NO one less or more)."""
    if memory.predecessor.known == 1:
        follow_track(memory.predecessor, reading, table)
    if memory.successor.known == 1:
        follow_track(memory.successor, reading, table)
    cycle = reading.cycle
    if coincide(memory.predecessor, memory.successor, table):
        memory.predecessor.seen = cycle - table.track_refind - 1
        memory.successor.seen = cycle - table.track_refind - 1
    predecessor_lost = cycle - memory.predecessor.seen > table.track_refind
    successor_lost = memory.successor.known == 1 and cycle - memory.successor.seen > table.track_refind
    if not predecessor_lost and not successor_lost:
        return
    for n in range(reading.packet_count):
        message = memory.heard[n]
        if message.branch != memory.branch or from_runner(message):
            continue
        if predecessor_lost and message.link_number == memory.link_number - 1:
            find_by_bearing(memory.predecessor, reading, reading.packets[n].bearing, table)
        if successor_lost and message.guardian == 0 and message.link_number == memory.link_number + 1:
            find_by_bearing(memory.successor, reading, reading.packets[n].bearing, table)

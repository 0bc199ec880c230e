"""Eruption of prominences (SECS): find the arm's direction, spiral into line, be pushed (ST-35 to ST-43)."""

import math

from formicarium.angles import wrapped
from formicarium.compiled import compiled
from formicarium.control.bearings import carried_over, carried_over_printed
from formicarium.systems.coverage.arms import chance
from formicarium.systems.coverage.forces import clear, press, wish
from formicarium.systems.coverage.listening import round_of
from formicarium.systems.coverage.memory import Mode, Stage

BUZZ = 1  # place of "buzz" among the variants
RETURN = 1  # place of "return" among what strays do
SWEEP_MIDDLE = 0.65  # of delta; down to 0.2 of it a lone robot comes within 0.5 m of any task nearer than itself
SWEEP_SWING = 0.45  # of delta, each way; 1.1 of 2.4 m is within the safe variant's longest link
# How a spiral opens in the authors' files, by number modulo 20 (ST-40).
BUZZ_SPIRALS = (
    *(0.17, 0.50, 0.73, 0.13, 0.12, 0.21, 0.43, 0.48, 0.61, 0.18),
    *(0.59, 0.37, 0.57, 0.76, 0.05, 0.51, 0.79, 0.62, 0.47, 0.11),
)


@compiled
def find_reference(reading, memory):
    """Choose the robot to align with (ST-35) among those heard just now.

    The master if it is heard; else, of the own arm's robots that are nearer to the master, the one that is least so.
    It must know the arms and name this robot's bearing.
    """
    best = -1
    for k in range(reading.packet_count):
        packet = reading.packets[k]
        if packet.linked == 0 or packet.named == 0 or packet.arm_count == 0:
            continue
        if packet.arms[0].known == 0 or round_of(packet.epoch) != round_of(memory.epoch):
            continue
        if packet.hops == 0:
            best = k
            break
        if memory.arm != 0 and packet.arm != memory.arm:
            continue
        if packet.gradient < memory.gradient:
            if best < 0 or packet.gradient > reading.packets[best].gradient:
                best = k
    memory.reference_place = best if memory.linked == 1 else -1


@compiled
def take_directions(reading, memory, table):
    """Carry the arms' directions over from the reference (ST-36), and note how far off the own arm's line one is."""
    place = memory.reference_place
    if place < 0:
        return
    packet = reading.packets[place]
    memory.reference = packet.sender
    memory.reference_heard = reading.cycle
    memory.way_back = packet.bearing
    for k in range(min(memory.arm_count, packet.arm_count)):
        if packet.arms[k].known == 1:
            told = packet.arms[k].direction
            if table.transform == 1:
                memory.arms[k].direction = carried_over_printed(told, packet.bearing_of_me, packet.bearing)
            else:
                memory.arms[k].direction = carried_over(told, packet.bearing_of_me, packet.bearing)
            memory.arms[k].known = 1
    if memory.arm != 0 and memory.arm <= packet.arm_count:
        memory.offset = wrapped(packet.bearing_of_me - packet.arms[memory.arm - 1].direction)


@compiled
def erupt(reading, memory, command, table, chart, footbot):
    """Do what an eruption asks of a backbone robot.

    Of an arm whose tip is at its task those stand still that are in line; the others go on until they are, or they
    would stand in the way of other arms. So it is while the master counts the time for which all tasks are held: a tip
    may have left since.
    """
    if memory.reference_place >= 0 and memory.arm > 0:
        note_alignment(memory, table)
    stops = chart.stop == 1 or memory.mode == Mode.HOLD
    if stops and memory.arm > 0 and memory.arms[memory.arm - 1].reached > 0 and is_in_place(reading, memory):
        memory.stage = Stage.HOLDING
        clear(command)
    elif memory.reference_place >= 0 and memory.arm > 0:
        if memory.aligned == 1:
            memory.stage = Stage.ALIGNED
            press(reading, memory, command, table, spacing_now(reading, memory, table), memory.arm, footbot.speed)
        else:
            memory.stage = Stage.SPIRALLING
            spiral(reading, memory, command, table, footbot, memory.spacing)
    elif memory.linked == 1 and reading.cycle - memory.reference_heard <= table.fresh_cycles:
        memory.stage = Stage.BLIND
        press(reading, memory, command, table, memory.spacing, memory.arm, footbot.speed)
    else:
        be_lost(reading, memory, command, table, footbot)


@compiled
def spacing_now(reading, memory, table):
    """Return delta (m): that of the phase, or while the arm sweeps, 0.2 to 1.1 of it: 0.65 + 0.45 cos(2 pi t / T)."""
    time = reading.cycle - memory.since - table.sweep_cycles
    if table.sweep_cycles == 0 or time < 0 or memory.arms[memory.arm - 1].reached > 0:
        return memory.spacing
    return memory.spacing * (SWEEP_MIDDLE + SWEEP_SWING * math.cos(2.0 * math.pi * time / table.sweep_cycles))


@compiled
def is_in_place(reading, memory):
    """Tell whether one stands in line or at the arm's task, or has held already; one has an arm."""
    at_task = reading.beacon == memory.arms[memory.arm - 1].task
    return memory.aligned == 1 or at_task or memory.stage == Stage.HOLDING


@compiled
def note_alignment(memory, table):
    """Tell whether one stands in line, and begin a new spiral when one no longer does."""
    aligned = 1 if math.fabs(memory.offset) < table.aligned_angle else 0
    if aligned != memory.aligned:
        memory.flips += 1
        memory.aligned = aligned
        memory.spiral = 0.0
    if aligned == 0 and memory.spiral == 0.0:
        memory.spiral = chance(memory) * table.spiral_most


@compiled
def spiral(reading, memory, command, table, footbot, spacing):
    """Go round the reference towards the arm's line: v (cos a tangent + sin a outward) (ST-39, ST-40)."""
    packet = reading.packets[memory.reference_place]
    speed = footbot.speed
    if packet.range > table.approach_share * spacing or packet.range > table.approach_range:
        wish(command, packet.bearing, speed)
        return
    if packet.range < table.flee_range:
        wish(command, packet.bearing, -speed)
        return
    side = 1.0 if memory.offset > 0.0 else -1.0  # 1: clockwise about the reference
    cosine = math.cos(packet.bearing)
    sine = math.sin(packet.bearing)
    if table.variant == BUZZ:
        opening = BUZZ_SPIRALS[reading.identity % 20]
        command.ahead = -side * speed * sine
        command.aside = side * speed * opening * cosine
        return
    along = speed * math.cos(memory.spiral)
    outward = speed * math.sin(memory.spiral)
    command.ahead = -side * along * sine - outward * cosine
    command.aside = side * along * cosine - outward * sine


@compiled
def be_lost(reading, memory, command, table, footbot):
    """Without a reference: stand for half a second, draw near to others, and without a way to the master turn back.

    The authors' files only draw near. With a way to the master a stray may follow it instead.
    """
    memory.stage = Stage.LOST
    memory.aligned = 0
    silent = reading.cycle - memory.linked_at
    if table.strays == RETURN and memory.linked == 1 and go_to_parent(reading, memory, command, table, footbot):
        return
    if table.variant == BUZZ or (memory.linked == 1 and reading.packet_count > 0):
        press(reading, memory, command, table, table.close_spacing, 0, footbot.speed)
    elif silent <= table.fresh_cycles:
        clear(command)
    elif silent <= table.close_cycles and reading.packet_count > 0:
        press(reading, memory, command, table, table.close_spacing, 0, footbot.speed)
    elif memory.reference != 0:
        wish(command, memory.way_back, footbot.speed)
    else:
        clear(command)


@compiled
def go_to_parent(reading, memory, command, table, footbot):
    """Go towards the next robot on the way to the master; tell whether it was heard and is not at hand already."""
    for k in range(reading.packet_count):
        packet = reading.packets[k]
        if packet.sender == memory.parent and packet.range > table.separation_range:
            wish(command, packet.bearing, footbot.speed)
            return True
    return False

"""The one message that a robot broadcasts in each cycle (ST-33), and how many bytes it takes."""

from formicarium.compiled import compiled
from formicarium.robots.footbot import ENTRIES

# Sequence of three bytes, five numbers of eight, and eleven bytes of small numbers: phase, aligned and linked share one
# (three bits and one each), the own arm and the number of arms another (at most six each).
HEAD_BYTES = 54
LEADER_BYTES = 54  # three numbers of one byte, the clock of three, five of eight and 63 bits with one for "placed"
ARM_BYTES = 27  # three numbers of eight bytes, three of one: the task's goes with whether the direction is known
ENTRY_BYTES = 9  # a receiver's number and a bearing


@compiled
def speak(reading, memory, command, longest):
    """Write the message: what the robot knows now, and to each neighbour that it heard just now its bearing.

    A bearing and the arms' directions are of the same instant (ST-37). If not all bearings fit into ``longest`` bytes,
    robots take turns.
    """
    command.enabled[0] = 1
    message = command.message
    memory.sequence += 1
    message.sender = reading.identity
    message.sequence = memory.sequence
    message.epoch = memory.epoch
    message.mode = memory.mode
    message.spacing = memory.spacing
    message.correction = memory.correction
    message.arm = memory.arm
    message.aligned = memory.aligned
    message.linked = memory.linked
    message.gradient = memory.gradient
    message.hops = memory.hops
    message.parent = memory.parent
    message.reference = memory.reference
    message.anchor = memory.anchor
    message.ahead = command.ahead
    message.aside = command.aside
    message.farthest = memory.farthest
    message.counted = memory.counted
    message.term = memory.term
    if memory.term > 0:
        speak_of_leader(message, memory)
    message.arm_count = memory.arm_count
    for k in range(memory.arm_count):
        message.arms[k].task = memory.arms[k].task
        message.arms[k].known = memory.arms[k].known
        message.arms[k].direction = memory.arms[k].direction
        message.arms[k].weight = memory.arms[k].weight
        message.arms[k].leave = memory.arms[k].leave
        message.arms[k].count = memory.arms[k].count
        message.arms[k].reached = memory.arms[k].reached
    size = HEAD_BYTES + ARM_BYTES * memory.arm_count
    size += LEADER_BYTES if memory.term > 0 else 0
    room = min(ENTRIES, (longest - size) // ENTRY_BYTES)
    count = reading.packet_count
    first = (memory.sequence * room) % count if count > room else 0
    message.entry_count = min(count, room)
    for e in range(message.entry_count):
        packet = reading.packets[(first + e) % count]
        message.entries[e].receiver = packet.sender
        message.entries[e].bearing = packet.bearing
    message.bytes = size + ENTRY_BYTES * message.entry_count


@compiled
def speak_of_leader(message, memory):
    """Write what the robot knows of the master, of its own place in the map and of what is done."""
    message.leader = memory.leader
    message.office = memory.office
    message.beat = memory.beat
    message.home_ahead = memory.home_ahead
    message.home_aside = memory.home_aside
    message.placed = memory.placed
    message.way_ahead = memory.way_ahead
    message.way_aside = memory.way_aside
    message.facing = memory.facing
    message.credited = memory.credited

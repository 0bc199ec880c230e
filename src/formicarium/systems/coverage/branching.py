"""Arms that branch: a tip with robots to spare becomes the root of smaller arms, and theirs do so again (ST-75).

Robots to spare queue up close behind the tip and go over to a child one by one. In a network the children are tubes
to the neighbouring arms (``tubes.py``).
"""

import math

from formicarium.angles import wrapped
from formicarium.compiled import compiled
from formicarium.systems.coverage.branches import (
    DIGIT,
    descends,
    enter,
    is_mate,
    is_root,
    is_to_spare,
    level_of,
    remoteness,
    swing_of,
    swing_to,
)
from formicarium.systems.coverage.eruption import be_lost, note_alignment, spiral
from formicarium.systems.coverage.forces import clear, cut, push_from
from formicarium.systems.coverage.listening import round_of
from formicarium.systems.coverage.memory import Shape, Stage
from formicarium.systems.coverage.tubes import TUBE_BYTES, flow, is_far_end, say_flow, thinnest_tube

BRANCH_BYTES = 4  # two for the branch, one for the place, one for the followers
MOST_FOLLOWERS = 255


@compiled
def take_part(reading, memory, table, formation):
    """Find one's place in an arm that branches, and whom to align with; whose branch is no more goes back to the stem.

    A root goes away when its arm is short of robots, or when it dies.
    """
    if memory.branch > 0 and reading.cycle - max(memory.reference_heard, memory.place_since) > table.close_cycles:
        enter(memory, 0, reading.cycle)
    find_place(reading, memory, table, formation)
    count_followers(reading, memory)
    if formation.kind == Shape.NETWORK:
        flow(reading, memory, formation)
    if memory.aligned == 1 and reading.cycle - memory.place_since >= formation.patience:
        go_over(reading, memory, formation)


@compiled
def find_place(reading, memory, table, formation):
    """Choose the robot to align with, and count one's place.

    As in a star: the root if it is heard; else, of those that come before in the branch, the one that is nearest.
    """
    best = -1
    farthest = -1.0
    rooted = False
    place = 0
    own = remoteness(memory, memory.arm, memory.branch, formation) if memory.arm > 0 else math.inf
    for k in range(reading.packet_count):
        packet = reading.packets[k]
        if memory.arm == 0 or packet.arm_count == 0 or round_of(packet.epoch) != round_of(memory.epoch):
            continue
        root = is_root(packet, memory, formation)
        far = remoteness(packet, memory.arm, memory.branch, formation)
        before = is_mate(packet, memory) and far < own
        if root:
            place = max(place, 1)
        elif before and packet.place > 0:
            place = max(place, packet.place + 1)
        if rooted or packet.named == 0 or packet.arms[0].known == 0:
            continue
        if root or (before and far > farthest):
            best = k
            farthest = far
            rooted = root
    memory.reference_place = best if memory.linked == 1 else -1
    note_place(memory, place, reading.cycle, table)


@compiled
def note_place(memory, place, cycle, table):
    """Take over a place, the first one when in line.

    One that is nearer to the root must have been found for some cycles, for messages get lost.
    """
    if place == 0 or (memory.place == 0 and memory.aligned == 0):
        return
    memory.doubted = memory.doubted + 1 if place < memory.place else 0
    if place > memory.place or memory.doubted > table.fresh_cycles:
        memory.place = place
        memory.place_since = cycle
        memory.doubted = 0


@compiled
def count_followers(reading, memory):
    """Sum up who aligns with this robot, directly or not, itself too."""
    memory.followers = 1
    for k in range(reading.packet_count):
        if reading.packets[k].reference == reading.identity:
            memory.followers = min(MOST_FOLLOWERS, memory.followers + reading.packets[k].followers)


@compiled
def go_over(reading, memory, formation):
    """First in the queue behind the root of children, go over to one of them."""
    if memory.place != formation.branch_robots + 1 or not is_to_spare(memory.branch, memory.place, formation):
        return
    root = 0
    for k in range(reading.packet_count):
        packet = reading.packets[k]
        if is_mate(packet, memory) and packet.place == formation.branch_robots:
            root = packet.sender
    if root == 0:
        return
    if formation.kind == Shape.NETWORK:
        child = thinnest_tube(reading, memory, formation, root)
    else:
        child = fewest(reading, memory, formation, root)
    if child > 0:
        enter(memory, memory.branch * DIGIT + child, reading.cycle)


@compiled
def fewest(reading, memory, formation, root):
    """Return the child with the fewest robots."""
    least = -1
    chosen = 0
    for child in range(1, formation.branches + 1):
        count = 0
        for k in range(reading.packet_count):
            packet = reading.packets[k]
            grown = packet.arm == memory.arm and descends(packet.branch, memory.branch * DIGIT + child)
            if grown and packet.reference == root:
                count += packet.followers
        if least < 0 or count < least:
            least = count
            chosen = child
    return chosen


@compiled
def turn_off(memory, formation):
    """Reckon how far one is off the branch's line, not off the stem's."""
    if memory.reference_place < 0 or memory.branch == 0:
        return
    if formation.kind == Shape.NETWORK:
        memory.offset = wrapped(memory.offset - swing_to(memory, memory.arm, memory.branch))
    else:
        memory.offset = wrapped(memory.offset - swing_of(memory.branch, formation))


@compiled
def grow(reading, memory, command, table, formation, footbot):
    """Do what an eruption with branches asks of a backbone robot; delta shrinks with each branching."""
    spacing = memory.spacing
    if formation.kind == Shape.FRACTAL:
        spacing *= formation.ratio ** level_of(memory.branch)
    if memory.reference_place >= 0 and memory.arm > 0:
        note_alignment(memory, table)
        if memory.aligned == 1:
            memory.stage = Stage.ALIGNED
            press_branch(reading, memory, command, table, formation, spacing, footbot.speed)
        else:
            memory.stage = Stage.SPIRALLING
            spiral(reading, memory, command, table, footbot, spacing)
    elif memory.linked == 1 and reading.cycle - memory.reference_heard <= table.fresh_cycles:
        memory.stage = Stage.BLIND
        press_branch(reading, memory, command, table, formation, spacing, footbot.speed)
    else:
        be_lost(reading, memory, command, table, footbot)


@compiled
def press_branch(reading, memory, command, table, formation, spacing, limit):
    """Follow the potential of one's branch, its root, and a tube's far end.

    Those to spare queue up: each heeds who stands before it alone, and no one else heeds them. If those behind pulled,
    a queue would gather at its end.
    """
    spare = is_to_spare(memory.branch, memory.place, formation)
    wanted = formation.queue_share * spacing if spare else spacing
    clear(command)
    for k in range(reading.packet_count):
        packet = reading.packets[k]
        if is_root(packet, memory, formation):
            push_from(command, packet, wanted, table)
        elif is_mate(packet, memory):
            before = packet.gradient < memory.gradient
            if before if spare else not is_to_spare(packet.branch, packet.place, formation):
                push_from(command, packet, wanted, table)
        elif formation.kind == Shape.NETWORK and is_far_end(packet, memory, formation):
            push_from(command, packet, wanted, table)
    cut(command, table, limit)


@compiled
def bytes_more(memory, formation):
    """Return how many bytes a message is longer than a star's."""
    if formation.kind == Shape.STAR:
        return 0
    return BRANCH_BYTES + (TUBE_BYTES * memory.arm_count if formation.kind == Shape.NETWORK else 0)


@compiled
def say_place(memory, command, formation):
    """Add to the message where one is in one's arm, and in a network what flows through one."""
    command.message.branch = memory.branch
    command.message.place = memory.place
    command.message.followers = memory.followers
    if formation.kind == Shape.NETWORK:
        say_flow(memory, command)
    command.message.bytes += bytes_more(memory, formation)

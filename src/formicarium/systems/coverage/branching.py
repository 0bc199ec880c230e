"""Arms that branch: a tip with robots to spare becomes the root of smaller arms, and theirs do so again (ST-75).

A branch has a number in octal: 0 is the stem, the arm from the master; each digit says which child of the branch
before it is meant. Places count along a branch from 1; robot ``branch_robots`` is the root of the children, as the
master is of the stems. Whoever stands beyond it is to spare, queues up close behind, and goes over to a child.
"""

import math

from formicarium.angles import wrapped
from formicarium.compiled import compiled
from formicarium.systems.coverage.eruption import be_lost, note_alignment, spiral
from formicarium.systems.coverage.forces import clear, cut, push_from
from formicarium.systems.coverage.listening import round_of
from formicarium.systems.coverage.memory import Stage

DIGIT = 8
MOST_FOLLOWERS = 255
BRANCH_BYTES = 4  # two for the branch, one for the place, one for the followers


@compiled
def level_of(branch):
    """Return how many branchings a branch is away from its stem."""
    level = 0
    while branch > 0:
        branch //= DIGIT
        level += 1
    return level


@compiled
def descends(branch, ancestor):
    """Tell whether a branch is another one, or grows from it."""
    while branch > ancestor:
        branch //= DIGIT
    return branch == ancestor


@compiled
def swing_of(branch, formation):
    """Return the angle from an arm's stem to one of its branches (rad): children fan out over twice ``angle``."""
    swing = 0.0
    while branch > 0:
        if formation.branches > 1:
            swing += formation.angle * (2.0 * (branch % DIGIT - 1) / (formation.branches - 1) - 1.0)
        branch //= DIGIT
    return swing


@compiled
def spacing_of(memory, formation):
    """Return the delta of a robot's branch (m): ratio^level of the phase's."""
    return memory.spacing * formation.ratio ** level_of(memory.branch)


@compiled
def is_to_spare(branch, place, formation):
    """Tell whether a place lies beyond the root of a branch's children."""
    return place > formation.branch_robots and level_of(branch) < formation.depth


@compiled
def is_root(packet, memory, formation):
    """Tell whether a speaker is where one's own branch begins."""
    if memory.branch == 0:
        return packet.linked == 1 and packet.hops == 0
    parent = memory.branch // DIGIT
    return packet.arm == memory.arm and packet.branch == parent and packet.place == formation.branch_robots


@compiled
def is_mate(packet, memory):
    """Tell whether a speaker is of one's own branch."""
    return packet.linked == 1 and packet.arm == memory.arm and packet.branch == memory.branch


@compiled
def find_place(reading, memory, table, formation):
    """Choose the robot to align with, count one's place, and go over to a child when it is one's turn.

    As in a star: the root if it is heard; else, of the branch's robots that are nearer to the master, the one that is
    least so.
    """
    best = -1
    rooted = False
    place = 0
    for k in range(reading.packet_count):
        packet = reading.packets[k]
        if round_of(packet.epoch) != round_of(memory.epoch):
            continue
        root = is_root(packet, memory, formation)
        before = is_mate(packet, memory) and packet.gradient < memory.gradient
        if root:
            place = max(place, 1)
        elif before and packet.place > 0:
            place = max(place, packet.place + 1)
        if rooted or packet.named == 0 or packet.arm_count == 0 or packet.arms[0].known == 0:
            continue
        if root or (before and (best < 0 or packet.gradient > reading.packets[best].gradient)):
            best = k
            rooted = root
    memory.reference_place = best if memory.linked == 1 else -1
    count_followers(reading, memory)
    note_place(memory, place, reading.cycle, table)
    if memory.aligned == 1 and reading.cycle - memory.placed >= formation.patience:
        go_over(reading, memory, formation)


@compiled
def count_followers(reading, memory):
    """Sum up who aligns with this robot, directly or not, itself too."""
    memory.followers = 1
    for k in range(reading.packet_count):
        if reading.packets[k].reference == reading.identity:
            memory.followers = min(MOST_FOLLOWERS, memory.followers + reading.packets[k].followers)


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
        memory.placed = cycle
        memory.doubted = 0


@compiled
def go_over(reading, memory, formation):
    """First in the queue behind the root of children, go over to the child with the fewest robots."""
    if memory.place != formation.branch_robots + 1 or not is_to_spare(memory.branch, memory.place, formation):
        return
    root = 0
    for k in range(reading.packet_count):
        packet = reading.packets[k]
        if is_mate(packet, memory) and packet.place == formation.branch_robots:
            root = packet.sender
    if root == 0:
        return
    least = -1
    chosen = 0
    for child in range(1, formation.branches + 1):
        branch = memory.branch * DIGIT + child
        count = 0
        for k in range(reading.packet_count):
            packet = reading.packets[k]
            if packet.arm == memory.arm and packet.reference == root and descends(packet.branch, branch):
                count += packet.followers
        if least < 0 or count < least:
            least = count
            chosen = branch
    memory.branch = chosen
    memory.place = 0
    memory.placed = reading.cycle
    memory.aligned = 0
    memory.reference_place = -1


@compiled
def turn_off(memory, formation):
    """Reckon how far one is off the branch's line, not off the stem's."""
    if memory.reference_place >= 0:
        memory.offset = wrapped(memory.offset - swing_of(memory.branch, formation))


@compiled
def grow(reading, memory, command, table, formation, footbot):
    """Do what an eruption with branches asks of a backbone robot."""
    spacing = spacing_of(memory, formation)
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
    """Follow the potential of one's branch and its root.

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
    cut(command, table, limit)


@compiled
def say_place(memory, command):
    """Add to the message where one is in one's arm, four bytes more."""
    command.message.branch = memory.branch
    command.message.place = memory.place
    command.message.followers = memory.followers
    command.message.bytes += BRANCH_BYTES

"""What a robot makes of the messages of the last cycle: the phase, its way to the master, who stands behind it."""

import math

from formicarium.angles import wrapped
from formicarium.compiled import compiled
from formicarium.systems.coverage.memory import Stage

BUZZ = 1  # place of "buzz" among the variants
PHASES = 4  # epochs of a round: flock, erupt, hold, gather
BUZZ_RESET = 100  # cycles between two resets of the gradient in the authors' files


@compiled
def round_of(epoch):
    """Return the number of the round of four phases that an epoch belongs to: a slot, or another try at one."""
    return max(0, epoch - 1) // PHASES


@compiled
def forget_arms(memory):
    """Begin a round: nothing said of the arms before is true of those to come."""
    memory.arm = 0
    memory.arm_count = 0
    memory.correction = 0
    memory.drawn = 0
    memory.branch = 0
    memory.place = 0
    for k in range(len(memory.arms)):
        arm = memory.arms[k]
        arm.task = 0
        arm.known = 0
        arm.direction = 0.0
        arm.weight = 0.0
        arm.leave = 0.0
        arm.count = 0
        arm.reached = 0
        arm.open = 0
        arm.next = 0


@compiled
def carry(reading, memory):
    """Turn and shift what is kept in one's own frame against one's own motion."""
    cosine = math.cos(reading.turned)
    sine = math.sin(reading.turned)
    for k in range(memory.arm_count):
        memory.arms[k].direction = wrapped(memory.arms[k].direction - reading.turned)
    memory.way_back = wrapped(memory.way_back - reading.turned)
    for k in range(memory.link_count):
        link = memory.links[k]
        before = link.before - reading.moved_ahead
        beside = link.beside - reading.moved_aside
        link.before = cosine * before + sine * beside
        link.beside = cosine * beside - sine * before
    ahead = math.cos(memory.facing)
    aside = math.sin(memory.facing)
    memory.way_ahead += ahead * reading.moved_ahead - aside * reading.moved_aside
    memory.way_aside += aside * reading.moved_ahead + ahead * reading.moved_aside
    memory.facing += reading.turned


@compiled
def hear_phase(reading, memory):
    """Take over the newest phase that anybody speaks of, and the newest word on the arms; both spread as a flood.

    Whoever has not heard of a new round yet speaks of arms that are no more.
    """
    for k in range(reading.packet_count):
        packet = reading.packets[k]
        if packet.epoch > memory.epoch:
            if round_of(packet.epoch) != round_of(memory.epoch):
                forget_arms(memory)
            memory.epoch = packet.epoch
            memory.mode = packet.mode
            memory.spacing = packet.spacing
            memory.since = reading.cycle
            memory.stage = Stage.WAITING
            memory.aligned = 0
        if packet.arm_count == 0 or round_of(packet.epoch) != round_of(memory.epoch):
            continue
        if packet.correction > memory.correction or memory.arm_count == 0:
            memory.arm_count = packet.arm_count
            memory.correction = packet.correction
            for arm in range(packet.arm_count):
                memory.arms[arm].task = packet.arms[arm].task
                memory.arms[arm].weight = packet.arms[arm].weight
                memory.arms[arm].leave = packet.arms[arm].leave


@compiled
def goes_with(memory, packet):
    """Tell whether a neighbour's ways end where one's own do; they all do where nobody follows the first master."""
    if memory.term == 0:
        return True
    return packet.term == memory.term and packet.leader == memory.leader and packet.office == memory.office


@compiled
def find_way(reading, memory, table, chart):
    """Find the shortest way to the master: D_i = min over neighbours of measured range + D_j (ST-34).

    Worked out anew in every cycle from neighbours that do not themselves go through this robot; the last parent's word
    counts while it is fresh. Ways have at most as many hops as there are robots, so a group that has lost the master
    finds out within so many cycles.
    """
    if table.variant == BUZZ:
        find_way_buzz(reading, memory)
        return
    best = -1
    gradient = math.inf
    parent_heard = False
    for k in range(reading.packet_count):
        packet = reading.packets[k]
        if packet.sender == memory.parent:
            parent_heard = True
        if packet.linked == 1 and packet.parent != reading.identity and packet.hops + 1 < chart.robots:
            if goes_with(memory, packet) and packet.range + packet.gradient < gradient:
                gradient = packet.range + packet.gradient
                best = k
    fresh = memory.linked == 1 and reading.cycle - memory.parent_heard <= table.fresh_cycles
    if fresh and not parent_heard and (best < 0 or memory.gradient <= gradient):
        return
    if best < 0:
        memory.linked = 0
        memory.parent = 0
        return
    memory.linked = 1
    memory.gradient = gradient
    memory.hops = reading.packets[best].hops + 1
    memory.parent = reading.packets[best].sender
    memory.parent_heard = reading.cycle
    memory.linked_at = reading.cycle


@compiled
def find_way_buzz(reading, memory):
    """As in the authors' files: the gradient only falls, but for a reset now and then; nobody notices a loss."""
    if reading.cycle % BUZZ_RESET == 0:
        memory.gradient = math.inf
    for k in range(reading.packet_count):
        packet = reading.packets[k]
        if packet.linked == 1 and packet.range + packet.gradient < memory.gradient:
            memory.gradient = packet.range + packet.gradient
            memory.hops = packet.hops + 1
            memory.parent = packet.sender
            memory.linked = 1
            memory.linked_at = reading.cycle
    if memory.linked == 1:
        memory.parent_heard = reading.cycle


@compiled
def stay_master(memory, cycle):
    """Be where all ways end."""
    memory.linked = 1
    memory.gradient = 0.0
    memory.hops = 0
    memory.parent = 0
    memory.linked_at = cycle


@compiled
def count_behind(reading, memory):
    """Sum up who goes to the master through this robot: how many, in which arms, and the longest gradient."""
    memory.counted = 1
    memory.farthest = memory.gradient
    for arm in range(memory.arm_count):
        memory.arms[arm].count = 1 if memory.arm == arm + 1 else 0
    for k in range(reading.packet_count):
        packet = reading.packets[k]
        if packet.parent == reading.identity and goes_with(memory, packet):
            memory.counted += packet.counted
            memory.farthest = max(memory.farthest, packet.farthest)
            if round_of(packet.epoch) == round_of(memory.epoch):
                for arm in range(min(memory.arm_count, packet.arm_count)):
                    memory.arms[arm].count += packet.arms[arm].count


@compiled
def hear_reached(reading, memory, table):
    """Pass on the word that an arm's tip is at its task, whosever arm it is.

    The way from the tip to the master may lead through robots of other arms. The tip starts the word with a number of
    hops to live; each robot says one less than the most it has heard. So it dies within as many cycles when the tip has
    left. Only robots of the arm itself heed it.
    """
    for arm in range(memory.arm_count):
        most = memory.arms[arm].reached
        for k in range(reading.packet_count):
            packet = reading.packets[k]
            if arm < packet.arm_count and round_of(packet.epoch) == round_of(memory.epoch):
                most = max(most, packet.arms[arm].reached)
        memory.arms[arm].reached = max(0, most - 1)
    if memory.arm > 0 and reading.beacon == memory.arms[memory.arm - 1].task and memory.linked == 1:
        memory.arms[memory.arm - 1].reached = table.reached_hops

"""Cross links between arms that grow and wither like a slime mould's tubes (ST-74).

The tips of all arms are sources and sinks. Each robot knows its way to every tip and hands on, along that gradient, how
many tips send through it: the flux counters. A tube is a row of robots from one arm's tip towards the next arm's. Its
robots keep its conductance, dC/dt = Q^m / (1 + Q^m) - C in units of ``tube_time``: one that has joined both arms
carries their traffic, which is shorter so than through the master, and stays; one that leads nowhere withers, and its
robots try the arm's other side.
"""

from formicarium.compiled import compiled
from formicarium.systems.coverage.arms import chance
from formicarium.systems.coverage.branches import enter, neighbour_of
from formicarium.systems.coverage.listening import round_of

TUBE_BYTES = 11  # for each arm: a way of eight; whether it is known, whose it is, and what flows, of one
LEAST_HOPE, HOPE = 0.3, 0.4  # a new tube's conductance is the first and up to the second more


@compiled
def find_tips(reading, memory, table, chart):
    """Find the ways to all tips, min over neighbours of measured range + theirs, and count who sends through here.

    As the way to the master is found: not through robots that go through this one, and what was found holds for some
    cycles without news.
    """
    formation = chart.formation
    longest = chart.robots * 2.0 * memory.spacing
    is_tip = memory.arm > 0 and memory.branch == 0 and memory.place == formation.branch_robots
    for k in range(memory.arm_count):
        own = memory.arms[k]
        if is_tip and memory.arm == k + 1:
            own.open = 1
            own.way = 0.0
            own.next = 0
            own.told = reading.cycle
        else:
            find_tip(reading, memory, k, longest)
            if own.open == 1 and reading.cycle - own.told > table.fresh_cycles:
                own.open = 0
                own.next = 0
        own.load = 1 if is_tip and memory.arm != k + 1 else 0
        for n in range(reading.packet_count):
            packet = reading.packets[n]
            if k < packet.arm_count and packet.arms[k].open == 1 and packet.arms[k].next == reading.identity:
                own.load += packet.arms[k].load
        own.load = min(own.load, memory.arm_count)


@compiled
def find_tip(reading, memory, k, longest):
    """Find the way to the tip of arm k + 1, none longer than ``longest`` (m)."""
    best = -1
    way = longest
    kept = -1
    for n in range(reading.packet_count):
        packet = reading.packets[n]
        if k >= packet.arm_count or packet.arms[k].open == 0 or packet.arms[k].next == reading.identity:
            continue
        if round_of(packet.epoch) != round_of(memory.epoch):
            continue
        if packet.sender == memory.arms[k].next:
            kept = n
        if packet.range + packet.arms[k].way < way:
            way = packet.range + packet.arms[k].way
            best = n
    own = memory.arms[k]
    if best < 0 or (own.open == 1 and kept < 0 and own.way <= way):
        return
    own.open = 1
    own.way = way
    own.next = reading.packets[best].sender
    own.told = reading.cycle


@compiled
def flux_of(arms, count):
    """Return Q, how much traffic goes through a robot: the tips that send through it, to each tip."""
    flux = 0.0
    for k in range(count):
        if arms[k].open == 1:
            flux += arms[k].load
    return flux


@compiled
def flow(reading, memory, formation):
    """Let the conductance of a robot's tube follow its flux; when it has withered, try the other side."""
    if memory.branch == 0:
        memory.conductance = 0.0
        return
    if memory.conductance == 0.0:
        memory.conductance = LEAST_HOPE + HOPE * chance(memory)
    power = flux_of(memory.arms, memory.arm_count) ** formation.flux_power
    memory.conductance += (power / (1.0 + power) - memory.conductance) / formation.tube_cycles
    if memory.conductance < formation.thinnest:
        enter(memory, 3 - memory.branch, reading.cycle)
        memory.conductance = 0.0
        memory.withered += 1


@compiled
def say_flow(memory, command):
    """Add to the message the ways to the tips and what flows along them."""
    for k in range(memory.arm_count):
        said = command.message.arms[k]
        said.open = memory.arms[k].open
        said.way = memory.arms[k].way
        said.next = memory.arms[k].next
        said.load = memory.arms[k].load


@compiled
def is_far_end(packet, memory, formation):
    """Tell whether a speaker is where one's tube leads: of the next arm's stem, or of a tube that comes from there."""
    if memory.branch == 0 or packet.arm != neighbour_of(memory, memory.arm, memory.branch) or packet.place == 0:
        return False
    if packet.branch == 0:
        return packet.place <= formation.branch_robots
    return neighbour_of(memory, packet.arm, packet.branch) == memory.arm


@compiled
def thinnest_tube(reading, memory, formation, root):
    """Return the child that a robot to spare goes over to: a tube in which nothing flows yet; 0 if both are joined.

    One that has been begun goes before one that has not; of two alike chance decides.
    """
    best = 0
    most = -1.0
    for child in range(1, 3):
        begun = 0.0
        joined = False
        for k in range(reading.packet_count):
            packet = reading.packets[k]
            if packet.arm == memory.arm and packet.branch == child and packet.reference == root:
                begun = 1.0
                joined = joined or flux_of(packet.arms, packet.arm_count) > 0.0
        if not joined:
            score = begun + 0.5 * chance(memory)
            if score > most:
                most = score
                best = child
    return best

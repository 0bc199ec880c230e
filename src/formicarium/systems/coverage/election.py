"""Who follows a master that has fallen silent: the lowest number alive, found by flooding (ST-48).

Every robot passes on the newest word of the master, the time on the master's clock when it said it. A robot without a
newer word for so long gives the master up and stands for the part itself; whoever else has given up takes the word of a
lower number instead of its own. All ways then end at the one who stands, so it counts who stands behind it; with more
than half of the swarm it takes the part. A smaller group first goes to where the master was, to meet the others, and
only takes the part when nobody was met for long.
"""

import math

from formicarium.compiled import compiled
from formicarium.systems.coverage.forces import clear, wish
from formicarium.systems.coverage.listening import PHASES, round_of
from formicarium.systems.coverage.memory import Mode, Stage

STANDING = 2  # cycles for each robot of the swarm for which one stands at least: a flood and a count, twice
NEAR_HOME = 1.0  # m, of where the master was: near enough to meet everybody


@compiled
def is_root(memory, identity):
    """Tell whether all ways end here: at the master, and at who stands for its part."""
    return memory.master == 1 or (memory.term > 0 and memory.leader == identity)


@compiled
def hear_leader(reading, memory, table, chart):
    """Take over the newest word of the master, or of who stands for its part; give up who is silent for too long."""
    for k in range(reading.packet_count):
        packet = reading.packets[k]
        if packet.term == 0:
            continue
        memory.credited |= packet.credited
        same = packet.term == memory.term and packet.leader == memory.leader and packet.office == memory.office
        if same and packet.beat > memory.beat:
            heed(memory, packet, reading.cycle)
        elif not same and comes_before(memory, packet):
            memory.term = packet.term
            memory.leader = packet.leader
            memory.office = packet.office
            memory.master = 0
            lose_way(memory)
            heed(memory, packet, reading.cycle)
    if is_root(memory, reading.identity):
        memory.beat = reading.cycle
        memory.beat_heard = reading.cycle
        if memory.office == 0:
            stand(memory, table, chart, reading.cycle)
    elif reading.cycle - memory.beat_heard > table.silence_cycles:
        give_up(memory, reading.identity, reading.cycle)


@compiled
def heed(memory, packet, cycle):
    """Note a newer word of the one that is followed, and of a master where it is."""
    memory.beat = packet.beat
    memory.beat_heard = cycle
    if packet.office == 1:
        memory.home_ahead = packet.home_ahead
        memory.home_aside = packet.home_aside


@compiled
def comes_before(memory, packet):
    """Tell whether to follow the one that a packet speaks of instead.

    The newest master goes before all, a master before who stands for the part, and of two alike the lower number. What
    was said by one before it was given up is no news.
    """
    if packet.leader == 0 or (packet.leader == memory.given_up and packet.beat <= memory.given_up_beat):
        return False
    if packet.term != memory.term:
        return packet.term > memory.term and (packet.office == 1 or memory.office == 0)
    if packet.office != memory.office:
        return packet.office == 1
    return memory.leader == 0 or packet.leader < memory.leader


@compiled
def lose_way(memory):
    """Forget the way to a master that is followed no more."""
    memory.linked = 0
    memory.parent = 0
    memory.gradient = math.inf
    memory.hops = 0


@compiled
def give_up(memory, identity, cycle):
    """Follow nobody any more; who knows where it is in the map stands for the master's part itself."""
    memory.given_up = memory.leader
    memory.given_up_beat = memory.beat
    memory.office = 0
    memory.leader = identity if memory.placed == 1 else 0
    memory.beat_heard = cycle
    memory.standing = cycle
    lose_way(memory)


@compiled
def stand(memory, table, chart, cycle):
    """Take the master's part with more than half of the swarm behind oneself, or when nobody was met for long."""
    stood = cycle - memory.standing
    many = 2 * min(memory.counted, memory.before) > chart.robots
    memory.before = memory.counted
    if (many and stood >= STANDING * chart.robots) or stood >= table.patience_cycles:
        take_office(memory, table, chart, cycle)


@compiled
def take_office(memory, table, chart, cycle):
    """Become the master: gather the swarm here, and then see what is left to do."""
    memory.term += 1
    memory.office = 1
    memory.master = 1
    memory.owing = 1
    memory.epoch = PHASES * (round_of(memory.epoch) + 1)
    memory.mode = Mode.GATHER
    memory.spacing = table.gather_spacing
    memory.since = cycle
    memory.arm = 0
    memory.anchor = 0
    memory.aligned = 0
    memory.reference = 0
    memory.crew = chart.robots - memory.term + 1
    memory.census = cycle
    memory.most = 0


@compiled
def rally(reading, memory, command, table, footbot):
    """Without a master go to where it last was, where all will meet."""
    memory.stage = Stage.LOST
    memory.aligned = 0
    clear(command)
    ahead = memory.home_ahead - memory.way_ahead
    aside = memory.home_aside - memory.way_aside
    if memory.placed == 1 and ahead * ahead + aside * aside > NEAR_HOME * NEAR_HOME:
        wish(command, math.atan2(aside, ahead) - memory.facing, footbot.speed)

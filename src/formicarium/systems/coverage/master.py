"""The master: calls out the phases of each slot, knows tasks in the frame in which it started, corrects the arms."""

import math

from formicarium.angles import wrapped
from formicarium.compiled import compiled
from formicarium.systems.coverage.forces import clear, wish
from formicarium.systems.coverage.listening import forget_arms
from formicarium.systems.coverage.memory import Mode, Planning, Stage

QUOTA = 1  # place of "quota" among the choices
SPARE = 10  # cycles of work more than a task wants, by word alone, before the master takes it for done
ENDLESS = 0  # place of "erupt" among the programmes: the one without further phases


@compiled
def call_out(memory, mode, spacing, cycle):
    """Begin a phase; the word of it spreads by itself."""
    memory.epoch += 1
    memory.mode = mode
    memory.spacing = spacing
    memory.since = cycle


@compiled
def begin_slot(memory, table, cycle):
    """Begin a slot, or begin it again, from where the swarm is: it flocks, and the arms so far are forgotten."""
    forget_arms(memory)
    memory.agreed = 0
    memory.held = 0
    for k in range(len(memory.tally)):
        memory.tally[k] = 0
        memory.word[k] = 0
    call_out(memory, Mode.FLOCK, table.spacing, cycle)


@compiled
def lead(reading, memory, command, table, chart, footbot):
    """Do the master's part in the present phase, and go on to the next when its time has come."""
    cycle = reading.cycle
    clear(command)
    slot = memory.slots[memory.slot]
    memory.home_ahead = memory.way_ahead
    memory.home_aside = memory.way_aside
    take_census(memory, table, chart, cycle)
    if memory.counted == memory.crew:
        memory.all_heard = cycle
    if memory.epoch == 0:
        flocks = chart.programme != ENDLESS and slot.travel == 1
        call_out(memory, Mode.FLOCK if flocks else Mode.ERUPT, table.spacing, cycle)
    elif memory.mode == Mode.FLOCK:
        if travel(reading, memory, command, table, chart, slot, footbot):
            call_out(memory, Mode.ERUPT, table.spacing, cycle)
    elif memory.mode == Mode.ERUPT:
        note_work(memory, table, chart, slot, cycle)
        if chart.programme != ENDLESS and (is_out(memory, chart) or cycle - memory.since > chart.erupt_cycles):
            call_out(memory, Mode.HOLD, table.spacing, cycle)
    elif memory.mode == Mode.HOLD:
        note_work(memory, table, chart, slot, cycle)
        if all_reached(memory):
            memory.held += 1
        enough = is_credited(memory, slot) if chart.replans > 0 else memory.held >= slot.hold_cycles
        if enough or cycle - memory.since > slot.hold_limit:
            call_out(memory, Mode.GATHER, table.gather_spacing, cycle)
    elif memory.mode == Mode.GATHER:
        if memory.planning == Planning.ANSWERED:
            begin_plan(memory, table, cycle)
        elif is_compact(memory, table) or cycle - memory.since > chart.gather_cycles:
            go_on(memory, table, chart, slot, cycle)
    memory.stage = Stage.FLOCKING if memory.mode == Mode.FLOCK else Stage.WAITING
    if memory.mode == Mode.ERUPT or memory.mode == Mode.HOLD:
        point_out(memory, slot)
        if table.arm_choice == QUOTA and not all_reached(memory):
            correct_arms(memory, table, chart, slot, cycle)


@compiled
def go_on(memory, table, chart, slot, cycle):
    """Go on from the end of a slot: once more, to the next one, to a new plan of what is left, or to the end.

    A master that has followed another does not know how far that one was: it plans anew, or goes through the plan from
    its beginning and leaves out slots that are done.
    """
    left = memory.owing == 1 or not is_credited(memory, slot) or memory.slot + 1 == memory.slot_count
    if left and memory.plans < chart.replans and count_left(memory, chart) > 0:
        memory.planning = Planning.ASKED
        return
    again = chart.replans == 0 and memory.held < slot.hold_cycles and memory.tries + 1 < chart.attempts
    if memory.owing == 1:
        memory.owing = 0
        memory.slot = -1
    elif again:
        memory.tries += 1
        begin_slot(memory, table, cycle)
        return
    memory.tries = 0
    memory.slot += 1
    while memory.term > 1 and memory.slot < memory.slot_count and is_credited(memory, memory.slots[memory.slot]):
        memory.slot += 1
    if memory.slot < memory.slot_count:
        begin_slot(memory, table, cycle)
    else:
        memory.slot = memory.slot_count - 1
        memory.done = 1


@compiled
def begin_plan(memory, table, cycle):
    """Begin the first slot of a new plan."""
    memory.planning = Planning.NONE
    memory.owing = 0
    memory.tries = 0
    memory.slot = 0
    begin_slot(memory, table, cycle)


@compiled
def note_work(memory, table, chart, slot, cycle):
    """Count the cycles of work on each task that word has come of, and take tasks for done that have had enough.

    Word that lives for n more cycles was new n cycles less than its whole life ago, so ``cycle + n`` grows by one with
    each cycle of work, however long the way.
    """
    if chart.task_count == 0:
        return
    for k in range(memory.arm_count):
        if memory.arms[k].reached == 0:
            continue
        word = cycle + memory.arms[k].reached
        place = slot.task[k] - 1
        newer = word - memory.word[k]
        if newer > 0:
            memory.worked[place] += min(newer, table.fresh_cycles) if memory.word[k] > 0 else 1
            memory.word[k] = word
        if memory.worked[place] >= chart.tasks[place].cycles + SPARE:
            memory.credited |= 1 << place


@compiled
def is_credited(memory, slot):
    """Tell whether all tasks of a slot are done, as far as word has come."""
    for k in range(slot.task_count):
        if memory.credited & (1 << (slot.task[k] - 1)) == 0:
            return False
    return True


@compiled
def is_out(memory, chart):
    """Tell whether every arm is at its task, or where new plans are made, has done it."""
    for k in range(memory.arm_count):
        done = chart.replans > 0 and memory.credited & (1 << (memory.arms[k].task - 1)) != 0
        if memory.arms[k].reached == 0 and not done:
            return False
    return memory.arm_count > 0


@compiled
def count_left(memory, chart):
    """Return how many tasks of the map are not done, as far as word has come."""
    count = 0
    for place in range(chart.task_count):
        count += 1 if memory.credited & (1 << place) == 0 else 0
    return count


@compiled
def take_census(memory, table, chart, cycle):
    """Reckon with as many robots as have been counted of late; who comes back is one of them again.

    Counted in two cycles running: who changes its way to the master may be counted twice in one.
    """
    counted = min(memory.counted, memory.before, chart.robots)
    memory.before = memory.counted
    if memory.crew == 0:
        memory.crew = chart.robots
        memory.census = cycle
    memory.most = max(memory.most, counted)
    if table.census_cycles == 0:
        return
    memory.crew = max(memory.crew, counted)
    if cycle - memory.census >= table.census_cycles:
        memory.crew = memory.most
        memory.most = 0
        memory.census = cycle


@compiled
def point_out(memory, slot):
    """Work out where the tasks are by one's own odometry."""
    if memory.arm_count == 0:
        memory.correction += 1
    memory.arm_count = slot.task_count
    for k in range(slot.task_count):
        ahead = slot.task_ahead[k] - memory.way_ahead
        aside = slot.task_aside[k] - memory.way_aside
        memory.arms[k].task = slot.task[k]
        memory.arms[k].known = 1
        memory.arms[k].direction = wrapped(math.atan2(aside, ahead) - memory.facing)
        if memory.correction == 1:
            memory.arms[k].weight = slot.wanted[k]


@compiled
def travel(reading, memory, command, table, chart, slot, footbot):
    """Go to the point of deployment and wait for stragglers on the way; tell whether it is reached with everybody."""
    ahead = slot.point_ahead - memory.way_ahead
    aside = slot.point_aside - memory.way_aside
    together = memory.farthest <= table.compact_range and reading.cycle - memory.all_heard <= table.keep_cycles
    if ahead * ahead + aside * aside <= table.arrival_range * table.arrival_range:
        return is_compact(memory, table) or reading.cycle - memory.since > chart.erupt_cycles
    if together:
        wish(command, wrapped(math.atan2(aside, ahead) - memory.facing), table.leader_share * footbot.speed)
    return False


@compiled
def is_compact(memory, table):
    """Tell whether everybody reports a short way."""
    return memory.counted == memory.crew and memory.farthest <= table.compact_range


@compiled
def all_reached(memory):
    """Tell whether there is fresh word from every task."""
    for k in range(memory.arm_count):
        if memory.arms[k].reached == 0:
            return False
    return memory.arm_count > 0


@compiled
def quota(memory, slot, k):
    """Return how many backbone robots arm k should have: shares of the weights, the rest to the first arms."""
    total = 0.0
    for arm in range(slot.task_count):
        total += slot.wanted[arm]
    crew = memory.crew - 1
    given = 0
    for arm in range(slot.task_count):
        given += int(crew * slot.wanted[arm] / total)
    own = int(crew * slot.wanted[k] / total)
    return own + 1 if k < crew - given else own


@compiled
def note_tally(memory):
    """Note for how many cycles running everybody was counted, arm by arm the same.

    Who changes its way to the master is counted twice or not at all meanwhile, and such errors may make up for each
    other in the sum.
    """
    total = 0
    same = True
    for k in range(memory.arm_count):
        total += memory.arms[k].count
        same = same and memory.arms[k].count == memory.tally[k]
        memory.tally[k] = memory.arms[k].count
    memory.agreed = memory.agreed + 1 if same and total == memory.crew - 1 else 0


@compiled
def correct_arms(memory, table, chart, slot, cycle):
    """Ask some robots of arms that are too strong to draw again among those that are too weak.

    Only when everybody is counted and has an arm, and not later than ``correction_limit`` into the eruption.
    """
    note_tally(memory)
    if cycle - memory.since > chart.correction_limit or cycle - memory.corrected < table.correction_cycles:
        return
    if memory.agreed < table.agreed_cycles:
        return
    wrong = False
    for k in range(memory.arm_count):
        wrong = wrong or memory.arms[k].count != quota(memory, slot, k)
    if not wrong:
        return
    memory.corrected = cycle
    memory.correction += 1
    for k in range(memory.arm_count):
        arm = memory.arms[k]
        surplus = arm.count - quota(memory, slot, k)
        arm.weight = max(0.0, -1.0 * surplus)
        arm.leave = max(0.0, surplus / max(1.0, 1.0 * arm.count))

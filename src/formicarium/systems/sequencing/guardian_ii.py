"""The guardian of Mark II: starts its branch at once, elects a leader with the others, directs runners step by step.

It has two flags that do not depend on each other (TS-111): ``established``, IN, a branch has reached it; and
``ring.out``, OUT, its own branch has reached the next guardian. It is no tail any more when its first link has taken
over, whether a branch has reached it by then or not.
"""

from formicarium.compiled import compiled
from formicarium.control.moves import stop
from formicarium.robots.records import Colour
from formicarium.systems.sequencing.election import begin_election, hear_election
from formicarium.systems.sequencing.guardian import act_as_tail, note_inhibition, right_hand
from formicarium.systems.sequencing.member import begin_message, send, send_invitation
from formicarium.systems.sequencing.memory import Role, State, enter
from formicarium.systems.sequencing.messages import from_runner
from formicarium.systems.sequencing.perception import locate_lights
from formicarium.systems.sequencing.ring import condition, hear_report, hear_step, is_word_of


@compiled
def become_guardian_ii(memory, identity, cycle):
    """Take up the guard of the task just done and act as the tail of a branch of one's own (TS-110)."""
    memory.role = Role.GUARDIAN
    memory.tail = 1
    memory.branch = identity
    memory.in_chain = 0
    memory.established = 0
    memory.link_number = 0
    memory.chosen = 0
    memory.count = 0
    memory.notifying = 0
    memory.ring.source = identity
    enter(memory, State.OPEN, cycle)


@compiled
def hear_reports(reading, memory, table):
    """Take in the verdicts that runners nearby report, and note whose inhibition to repeat."""
    for n in range(reading.packet_count):
        message = memory.heard[n]
        near = reading.packets[n].distance < table.notification_gate
        if near and message.report == 1 and from_runner(message):
            before = memory.ring.upi * 2 + memory.ring.solved
            hear_report(memory.ring, message.direction == 1, message.number, reading.identity)
            if memory.ring.upi * 2 + memory.ring.solved != before:
                memory.notified_by = message.identity
        note_inhibition(reading, memory, n, table)


@compiled
def hear_arrival_ii(reading, memory):
    """Note that the tail of a branch has reached this guardian; the first one counts (TS-87, TS-111)."""
    for n in range(reading.packet_count):
        message = memory.heard[n]
        arrival = message.tail == 1 and message.request == 1 and message.guardian == 0
        if arrival and message.identity == reading.identity and message.branch != reading.identity:
            memory.established = 1


@compiled
def hear_loop(reading, memory, table):
    """Listen to the first link of the own branch: is the branch established, and what comes round the loop?"""
    ring = memory.ring
    for n in range(reading.packet_count):
        message = memory.heard[n]
        if memory.tail == 1 or message.link_number == 0 or message.established == 0:
            continue
        if not is_word_of(message, memory.chosen):
            continue
        ring.out = 1
        if ring.election == 1:
            hear_election(ring, message, reading.identity, table.tasks)
        elif ring.label > 0:
            hear_step(ring, message)
    if ring.out == 1 and memory.established == 1 and ring.election == 0 and ring.label == 0:
        begin_election(ring, reading.identity)
    memory.condition = condition(ring, table.tasks)


@compiled
def speak(reading, memory, command, table):
    """Advertise the task and say one's words to the loop; repeat an inhibition in every other cycle (TS-134)."""
    begin_message(memory, reading.identity)
    message = memory.message
    message.guardian = 1
    message.tail = memory.tail
    message.in_chain = memory.in_chain
    message.established = memory.established
    message.count = memory.condition
    message.colour = memory.colour
    message.election = memory.ring.election
    message.number = memory.ring.number
    message.report = memory.ring.solved
    message.source = memory.ring.source
    if memory.tail == 1 and memory.state == State.OFFER:
        message.request = 1
        message.identity = memory.chosen
    elif reading.cycle <= memory.echo_until and reading.cycle % 2 == 0:
        message.inhibit = 1
        message.identity = memory.echoed
    if memory.tail == 1 and memory.state == State.OPEN:
        send_invitation(memory, command, right_hand(memory), table)
    else:
        send(memory, command, table)


@compiled
def guard_ii(reading, memory, command, table):
    """Live one cycle as a guardian."""
    command.colour = Colour.CYAN
    stop(command)
    locate_lights(reading, memory.target, memory.colour)
    hear_reports(reading, memory, table)
    hear_arrival_ii(reading, memory)
    if memory.tail == 1:
        act_as_tail(reading, memory, table)
    hear_loop(reading, memory, table)
    speak(reading, memory, command, table)

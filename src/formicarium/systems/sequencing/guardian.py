"""The guardian of a task (sections 6 and 6.1; Figs S4, S5): directs runners, learns its condition, starts a branch."""

import math

from formicarium.angles import wrapped
from formicarium.compiled import compiled
from formicarium.control.moves import stop
from formicarium.control.odometry import bearing_to
from formicarium.robots.records import Colour
from formicarium.systems.sequencing.member import (
    begin_message,
    hear_requests,
    relieved,
    send,
    send_invitation,
)
from formicarium.systems.sequencing.memory import Role, State, enter
from formicarium.systems.sequencing.messages import is_notification
from formicarium.systems.sequencing.perception import locate_lights


@compiled
def become_guardian(memory, cycle, success, claim):
    """Take up the guard of the task just done as number ``claim``, with the first (CND, CONF) (TS-53, TS-54)."""
    memory.role = Role.GUARDIAN
    memory.confident = 1 if success else 0
    memory.condition = claim - 1 if success else claim
    memory.in_chain = 0
    memory.established = 0
    memory.link_number = 0
    memory.chosen = 0
    memory.count = 0
    memory.notifying = 0
    first = success and claim == 1
    memory.tail = 1 if first else 0
    memory.branch = 1 if first else 0
    enter(memory, State.OPEN if first else State.STAY, cycle)


@compiled
def update_condition(memory, success, count, table):
    """Learn from a runner's notification (TS-57 to TS-61). A confident guardian ignores it."""
    if memory.confident == 1:
        return
    if success:
        memory.confident = 1
        memory.condition = count - 1
        return
    wanted = count + 1
    memory.condition = max(memory.condition, wanted) if table.cnd_monotone else wanted
    if memory.condition >= table.tasks:
        memory.condition = 1
        memory.restarts += 1


@compiled
def qualifies(count, condition, confident):
    """Tell whether a runner that has done ``count`` tasks is to do the guarded one (TS-55)."""
    return count == condition if confident == 1 else condition <= count


@compiled
def note_inhibition(reading, memory, n, table):
    """Note the inhibition in the n-th packet, if there is one, to repeat it (TS-64)."""
    message = memory.heard[n]
    if message.inhibit == 1 and message.guardian == 0 and reading.packets[n].distance < table.inhibition_distance:
        if reading.cycle > memory.echo_until or message.identity == memory.echoed:
            memory.echoed = message.identity
            memory.echo_until = reading.cycle + table.inhibition_echo


@compiled
def hear_runners(reading, memory, table):
    """Take in notifications of runners nearby and note whose inhibition to repeat."""
    for n in range(reading.packet_count):
        message = memory.heard[n]
        near = reading.packets[n].distance < table.notification_gate
        if near and is_notification(message):
            before = memory.condition * 2 + memory.confident
            update_condition(memory, message.direction == 1, message.count, table)
            if memory.condition * 2 + memory.confident != before:
                memory.notified_by = message.identity
        note_inhibition(reading, memory, n, table)


@compiled
def hear_arrival(reading, memory, table):
    """Join the chain when a tail that has reached this guardian hands over to it (TS-87)."""
    for n in range(reading.packet_count):
        message = memory.heard[n]
        arrival = message.tail == 1 and message.request == 1 and message.guardian == 0
        if not arrival or message.identity != reading.identity or memory.in_chain == 1 or memory.tail == 1:
            continue
        memory.in_chain = 1
        memory.established = 1
        memory.branch = message.branch + 1
        if memory.branch < table.tasks:
            memory.tail = 1
            enter(memory, State.OPEN, reading.cycle)
        return


@compiled
def right_hand(memory):
    """Return the direction to the right of the guardian with the task at its back (rad, robot frame)."""
    return wrapped(bearing_to(memory.target) + 0.5 * math.pi)


@compiled
def act_as_tail(reading, memory, table):
    """Recruit the first member of the own branch; give up the tail when it has taken over."""
    memory.sector = right_hand(memory)
    if relieved(reading, memory, table):
        memory.tail = 0
        memory.in_chain = 1
        enter(memory, State.STAY, reading.cycle)
    elif memory.state == State.OPEN:
        hear_requests(reading, memory, table)
    elif reading.cycle - memory.since > table.offer_patience:
        enter(memory, State.OPEN, reading.cycle)


@compiled
def speak(reading, memory, command, table):
    """Advertise the task (G_ADV), repeat an inhibition, and as tail invite or answer."""
    begin_message(memory, reading.identity)
    message = memory.message
    message.guardian = 1
    message.tail = memory.tail
    message.branch = memory.branch
    message.in_chain = memory.in_chain
    message.established = memory.established
    message.confident = memory.confident
    message.count = memory.condition
    message.colour = memory.colour
    if memory.tail == 1 and memory.state == State.OFFER:
        message.request = 1
        message.identity = memory.chosen
    elif reading.cycle <= memory.echo_until:
        message.inhibit = 1
        message.identity = memory.echoed
    if memory.tail == 1 and memory.state == State.OPEN:
        send_invitation(memory, command, right_hand(memory), table)
    else:
        send(memory, command, table)


@compiled
def guard(reading, memory, command, table):
    """Live one cycle as a guardian."""
    command.colour = Colour.CYAN
    stop(command)
    locate_lights(reading, memory.target, memory.colour)
    hear_runners(reading, memory, table)
    hear_arrival(reading, memory, table)
    if memory.tail == 1:
        act_as_tail(reading, memory, table)
    speak(reading, memory, command, table)

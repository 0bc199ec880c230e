"""A runner's visit to a booth: in, the infrared exchange, out again, and what it learns (TS-25 to TS-30, TS-45)."""

import math

from formicarium.compiled import compiled
from formicarium.control.moves import drive, steer, stop
from formicarium.control.odometry import bearing_to, distance_to
from formicarium.robots.infrared import CLAIM, FAILURE, HEARD_HIGH, HIGH_HALF, LOW_HALF, NOTED, SUCCESS
from formicarium.robots.records import SILENCE, Colour
from formicarium.systems.sequencing.following import presses_member
from formicarium.systems.sequencing.guardian import become_guardian
from formicarium.systems.sequencing.guardian_ii import become_guardian_ii
from formicarium.systems.sequencing.memory import State, enter
from formicarium.systems.sequencing.perception import locate_lights, nearest_blob

UNSEEN_STEPS = 0.25  # share of its steps that a robot has come forward whose booth stays dark [choice]
INSIDE = 0.085  # m, nearer than this to where the lights were, the robot is in the bay


@compiled
def begin_visit(memory, colour, candidate, cycle):
    """Set out for the booth of a colour, to guard its task afterwards or not."""
    memory.colour = colour
    memory.candidate = candidate
    memory.retries = 0
    memory.exchange = SILENCE
    memory.target.known = 0
    memory.target.seen = cycle
    memory.watched = 0
    enter(memory, State.APPROACH, cycle)


@compiled
def unattended(memory, colour, cycle, table):
    """Tell whether no guardian of the colour has been heard for a while (TS-92)."""
    return cycle - memory.adverts[colour].heard > table.unattended_after


@compiled
def is_attended(reading, memory, table):
    """Tell whether the task approached or just done has a guardian: one is heard, or its light is in view."""
    seen = nearest_blob(reading, Colour.CYAN, 0.0, math.pi, table.attended_within) >= 0
    return seen or not unattended(memory, memory.colour, reading.cycle, table)


@compiled
def next_byte(memory, identity):
    """Return the byte that answers the last one heard from the booth."""
    if memory.exchange == SILENCE:
        return HIGH_HALF | identity >> 4
    if memory.exchange == HEARD_HIGH:
        return LOW_HALF | identity & 0x0F
    return CLAIM | (memory.count + 1)


@compiled
def approach(reading, memory, command, table, epuck):
    """Steer at the booth's lights and into the bay; give up when they stay dark or it takes too long."""
    cycle = reading.cycle
    command.infrared = next_byte(memory, reading.identity)
    lit = locate_lights(reading, memory.target, memory.colour)
    if reading.infrared != SILENCE:
        memory.exchange = reading.infrared
        enter(memory, State.EXCHANGE, cycle)
        return
    distance = distance_to(memory.target)
    inside = memory.target.known == 1 and distance < INSIDE
    dark = cycle - memory.target.seen
    if memory.candidate == 1 and lit and not inside and is_attended(reading, memory, table):
        enter(memory, State.WALK, cycle)  # somebody was faster (U28)
        return
    if inside and dark > table.settle_time:
        enter(memory, State.EXCHANGE, cycle)  # the lights went out because this robot is in; no answer yet
        return
    if (not inside and dark > table.lights_lost_after) or cycle - memory.since > table.approach_patience:
        memory.abstain_until = cycle + table.refuse_time
        if memory.target.known == 1 and distance < table.straight_within:
            turn_round(memory, cycle)  # half way in already
        else:
            enter(memory, State.FOLLOW, cycle)
        return
    pressing = distance > table.straight_within and presses_member(reading, table.member_clearance)
    if memory.target.known == 0 or pressing:
        stop(command)
    elif distance < table.straight_within:
        drive(command, table.approach_speed, 0.0, epuck.wheel_distance)
    else:
        bearing = bearing_to(memory.target)
        steer(command, bearing, table.approach_speed, table.steering_gain, table.turn_rate, epuck.wheel_distance)


@compiled
def turn_round(memory, cycle):
    """Begin to turn by half a circle."""
    memory.turn_left = math.pi
    enter(memory, State.TURN_ROUND, cycle)


@compiled
def take_verdict(memory, cycle, success, table):
    """Learn from the verdict (TS-104): what to report, and how many tasks are done now."""
    memory.verdict = 1 if success else 0
    memory.verdict_heard = cycle
    memory.last_success = memory.colour if success else 0
    memory.reported = memory.count + 1 if success else memory.count
    if memory.candidate == 0:
        memory.count = (memory.count + 1) % table.tasks if success else 0
        memory.notifying = 1


@compiled
def take_note(memory, cycle, byte, table):
    """Learn what a booth of delayed feedback has to say (TS-104, U55): to count on, or the verdict on a sequence.

    The verdict is reported to the guardian of the last task, with the M4PI of the permutation that was tried. A
    failure before the last task says that the coordinator's record is another one: nothing to report.
    """
    memory.verdict = 1 if byte == SUCCESS else 0
    memory.verdict_heard = cycle
    memory.last_success = memory.colour if byte != FAILURE else 0
    if memory.candidate == 1:
        memory.verdict = 0  # its own first task is no part of a sequence
    elif byte == NOTED:
        memory.count += 1
    else:
        memory.notifying = 1 if memory.count + 1 == table.tasks else 0
        memory.reported = memory.step
        memory.count = 0


@compiled
def is_done(memory):
    """Tell whether the booth has said that the task is done."""
    return memory.exchange == SUCCESS or memory.exchange == FAILURE or memory.exchange == NOTED


@compiled
def exchange(reading, memory, command, table):
    """Wait in the bay for the verdict, answering the booth's bytes."""
    cycle = reading.cycle
    if reading.infrared != SILENCE:
        memory.exchange = reading.infrared
    command.infrared = next_byte(memory, reading.identity)
    if is_done(memory):
        if table.mark == 2:
            take_note(memory, cycle, memory.exchange, table)
        else:
            take_verdict(memory, cycle, memory.exchange == SUCCESS, table)
        turn_round(memory, cycle)
    elif cycle - memory.since > table.exchange_patience:
        memory.exchange = SILENCE
        turn_round(memory, cycle)


@compiled
def turning_round(reading, memory, command, table, epuck):
    """Turn on the spot, then leave: as future guardian, as visitor, or to try again."""
    memory.turn_left -= memory.odometer.turn
    if memory.turn_left > 0.0:
        drive(command, 0.0, table.turn_rate, epuck.wheel_distance)
        return
    memory.target.known = 0  # until the lights come on behind the robot
    guards = memory.candidate == 1 and is_done(memory)
    enter(memory, State.STAND_OFF if guards else State.LEAVE, reading.cycle)


@compiled
def drive_out(reading, memory, command, table, epuck):
    """Drive straight on, away from the booth; return how far the robot is from the middle of the bay (m).

    The booth's lights tell. When they go dark on the way, somebody else has gone in: then the place where they were
    last seen counts, carried along by the wheel steps. As long as they have not come on, the robot is most likely
    blocked inside and its wheels slip: its steps count for little.
    """
    drive(command, table.approach_speed, 0.0, epuck.wheel_distance)
    locate_lights(reading, memory.target, memory.colour)
    if memory.target.known == 0:
        return UNSEEN_STEPS * memory.travelled
    return distance_to(memory.target) - table.lights_depth


@compiled
def leave(reading, memory, command, table, epuck):
    """Drive out of the bay, then go on as a runner, or try again (U26, U30)."""
    cycle = reading.cycle
    out = drive_out(reading, memory, command, table, epuck)
    if out < table.leave_distance and cycle - memory.since <= table.exit_patience:
        return
    memory.inhibiting_until = cycle + table.inhibition_memory
    if memory.exchange != SILENCE:
        enter(memory, State.FOLLOW, cycle)
        memory.chain_seen = cycle
    elif memory.retries < table.retries:
        memory.retries += 1
        enter(memory, State.PAUSE, cycle)
    else:
        enter(memory, State.WALK, cycle)


@compiled
def stand_off(reading, memory, command, table, epuck):
    """Drive straight out to the guardian's place (TS-45, U27)."""
    cycle = reading.cycle
    if is_attended(reading, memory, table):
        memory.count = memory.reported % table.tasks if memory.verdict == 1 else 0
        memory.candidate = 0  # somebody guards it already (U29)
        enter(memory, State.LEAVE, cycle)
        return
    out = drive_out(reading, memory, command, table, epuck)
    if out >= table.exit_distance or cycle - memory.since > table.exit_patience:
        if table.mark == 2:
            become_guardian_ii(memory, reading.identity, cycle)
        else:
            become_guardian(memory, cycle, memory.verdict == 1, memory.count + 1)


@compiled
def pause(reading, memory, command, table, epuck):
    """Stand outside for a while, then turn round and enter again (TS-25, U30)."""
    stop(command)
    if reading.cycle - memory.since < table.retry_pause:
        return
    memory.turn_left -= memory.odometer.turn
    if memory.turn_left <= -math.pi:
        retries = memory.retries
        begin_visit(memory, memory.colour, memory.candidate, reading.cycle)
        memory.retries = retries
    else:
        drive(command, 0.0, table.turn_rate, epuck.wheel_distance)

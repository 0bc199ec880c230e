"""The runner (section 9): walks, follows the chain, does tasks as guardians direct, joins the chain, makes room."""

import math

from formicarium.angles import wrapped
from formicarium.compiled import compiled
from formicarium.control.moves import drive, steer, stop
from formicarium.control.odometry import distance_to
from formicarium.robots.records import Colour
from formicarium.streams import advanced, uniform
from formicarium.systems.sequencing.booth_visit import (
    approach,
    begin_visit,
    exchange,
    leave,
    pause,
    stand_off,
    turning_round,
    unattended,
)
from formicarium.systems.sequencing.following import follow_chain, presses_member, reference_point
from formicarium.systems.sequencing.guardian import qualifies
from formicarium.systems.sequencing.member import begin_message, send
from formicarium.systems.sequencing.memory import Role, State, enter
from formicarium.systems.sequencing.perception import guarded_colour, nearest_blob
from formicarium.systems.sequencing.steps import keep_step
from formicarium.systems.sequencing.tail import become_tail


@compiled
def draw(memory):
    """Return the next number in [0, 1) of the robot's own stream."""
    memory.draws = advanced(memory.draws)
    return uniform(memory.draws)


@compiled
def begin_turn(memory, table, cycle):
    """Choose by how much to turn, left or right (U2)."""
    turn = table.walk_turn_least + (table.walk_turn_most - table.walk_turn_least) * draw(memory)
    memory.turn_left = turn if draw(memory) < 0.5 else -turn
    enter(memory, State.TURN, cycle)


@compiled
def obstructed(reading, threshold):
    """Tell whether something is in the way: ahead, or on one side of the front half.

    Something on both sides is a passage, such as a booth's bay, which is left where the front is free.
    """
    ahead = max(reading.proximity[0], reading.proximity[7])
    right = max(reading.proximity[1], reading.proximity[2])
    left = max(reading.proximity[5], reading.proximity[6])
    return ahead > threshold or max(left, right) > threshold >= min(left, right)


@compiled
def walk(reading, memory, command, table, epuck):
    """Random walk: straight on until something is in the way, or by chance (U2)."""
    in_the_way = obstructed(reading, table.obstacle_value) or presses_member(reading, table.member_clearance)
    if in_the_way or draw(memory) < table.walk_turn_probability:
        begin_turn(memory, table, reading.cycle)
    else:
        drive(command, table.walk_speed, 0.0, epuck.wheel_distance)


@compiled
def turn(reading, memory, command, table, epuck):
    """Turn on the spot, then walk."""
    before = memory.turn_left
    memory.turn_left -= memory.odometer.turn
    if before * memory.turn_left <= 0.0:
        enter(memory, State.WALK, reading.cycle)
    else:
        rate = table.turn_rate if memory.turn_left > 0.0 else -table.turn_rate
        drive(command, 0.0, rate, epuck.wheel_distance)


@compiled
def follow(reading, memory, command, table, epuck):
    """Move along the chain, chain on the left; when it is lost go on for a while, then walk (U34)."""
    members, x, y = reference_point(reading, memory, table)
    cycle = reading.cycle
    if members == 0:
        if cycle - memory.chain_seen > table.lost_after:
            enter(memory, State.WALK, cycle)
        drive(command, table.follow_speed, 0.0, epuck.wheel_distance)
        return
    memory.chain_seen = cycle
    beside_guardian = nearest_blob(reading, Colour.CYAN, 0.0, math.pi, table.guardian_vicinity) >= 0
    follow_chain(reading, memory, command, x, y, beside_guardian, table, epuck.wheel_distance)


@compiled
def meets_chain(reading, memory, table):
    """Tell whether a chain is in view."""
    members, _, _ = reference_point(reading, memory, table)
    return members > 0


@compiled
def meets_unattended_task(reading, memory, table):
    """Tell whether a booth has been in view for a while whose guardian is neither heard nor seen; begins the visit."""
    cycle = reading.cycle
    if nearest_blob(reading, Colour.CYAN, 0.0, math.pi, table.attended_within) >= 0:
        memory.watched = 0
        return False
    for n in range(reading.blob_count):
        colour = reading.blobs[n].colour
        if Colour.OFF < colour < Colour.CYAN and unattended(memory, colour, cycle, table):
            if memory.watched != colour:
                memory.watched = colour
                memory.watched_since = cycle
            if cycle - memory.watched_since >= table.unattended_watch:
                begin_visit(memory, colour, 1, cycle)
                return True
            return False
    memory.watched = 0
    return False


@compiled
def is_directed_to_task(reading, memory, table):
    """Tell whether a guardian nearby directs this runner to its task and the booth is in view; begins the visit.

    A robot does not repeat the task it has just done with success: its guardian has not been told yet.
    """
    cycle = reading.cycle
    if memory.notifying == 1:
        return False
    for n in range(reading.blob_count):
        blob = reading.blobs[n]
        if blob.distance > table.decide_distance:
            return False
        if blob.colour != Colour.CYAN:
            continue
        colour = guarded_colour(memory, blob.bearing, cycle, table)
        if colour == 0 or colour == memory.last_success:
            continue
        advert = memory.adverts[colour]
        if table.mark == 2 and not keep_step(memory, advert, cycle, table):
            continue
        if not qualifies(memory.count, advert.count, 1 if table.mark == 2 else advert.confident):
            continue
        if nearest_blob(reading, colour, 0.0, math.pi, 1.0) >= 0:
            begin_visit(memory, colour, 0, cycle)
            return True
    return False


@compiled
def goes_round_guardian(reading, inviter):
    """Tell whether a guardian's light is nearer than the inviting one: the branch would be led past the guardian."""
    for n in range(inviter):  # nearest first
        if reading.blobs[n].colour == Colour.CYAN:
            return True
    return False


@compiled
def is_invited(reading, memory, table):
    """Tell whether a tail invites this runner: T_DIR heard from a tail's light within reach."""
    cycle = reading.cycle
    if cycle < memory.refuse_until or memory.notifying == 1:
        return False
    for n in range(reading.packet_count):
        message = memory.heard[n]
        if message.tail == 0 or message.direction == 0:
            continue
        colour = Colour.CYAN if message.guardian == 1 else Colour.MAGENTA
        bearing = reading.packets[n].bearing
        inviter = nearest_blob(reading, colour, bearing, table.advert_gate, table.join_distance)
        if inviter >= 0 and not (table.mark == 2 and goes_round_guardian(reading, inviter)):
            memory.invited_by = message.branch
            return True
    return False


@compiled
def join(reading, memory, command, table):
    """Stand still and ask; become the tail when chosen, else leave (T_REQ, T_RES, T_ACK).

    A request names no tail. In Mark II a tail of another branch, far off, may answer it: that does not count.
    """
    stop(command)
    cycle = reading.cycle
    for n in range(reading.packet_count):
        message = memory.heard[n]
        answered = message.tail == 1 and message.request == 1 and message.identity == reading.identity
        if answered and (table.mark == 1 or message.branch == memory.invited_by):
            become_tail(reading, memory, table, n)
            return
    if cycle - memory.since > table.request_patience:
        memory.refuse_until = cycle + table.refuse_time
        memory.chain_seen = cycle
        enter(memory, State.FOLLOW, cycle)


@compiled
def may_visit(memory, cycle, table):
    """Tell whether nobody else nearby has set out for a task, and the last attempt is long enough ago."""
    return cycle >= memory.abstain_until and cycle - memory.inhibition_heard > table.inhibition_echo


@compiled
def nearest_task(reading):
    """Return the index of the nearest booth or guardian in view, -1 if there is none.

    The radio's range alone is too vague to tell who is near.
    """
    for n in range(reading.blob_count):  # nearest first
        if Colour.OFF < reading.blobs[n].colour <= Colour.CYAN:
            return n
    return -1


@compiled
def respond_to_inhibition(reading, memory, command, table, task):
    """Keep clear of the task, or with a certain probability turn away from it and leave (TS-105, TS-106).

    ``task`` is the index of the nearest booth or guardian in view.
    """
    cycle = reading.cycle
    stop(command)
    if draw(memory) < table.inhibition_leave:
        memory.wander_until = cycle + table.refuse_time
        memory.turn_left = wrapped(reading.blobs[task].bearing + math.pi)
        enter(memory, State.TURN, cycle)
    else:
        enter(memory, State.INHIBITED, cycle)


@compiled
def stands_before_task(reading, guardian):
    """Tell whether a booth's light is nearer than the guardian: the robot is between the two."""
    for n in range(guardian):  # nearest first
        if Colour.OFF < reading.blobs[n].colour < Colour.CYAN:
            return True
    return False


@compiled
def keep_clear(reading, memory, command, table, epuck):
    """Clear the way in front of the task, then stand until no inhibition has been heard for a while.

    Who is between booth and guardian goes on round the guardian; who is near on another side backs off from it.
    """
    cycle = reading.cycle
    if cycle - memory.inhibition_heard > table.inhibition_memory:
        memory.chain_seen = cycle
        enter(memory, State.FOLLOW, cycle)
        return
    guardian = nearest_blob(reading, Colour.CYAN, 0.0, math.pi, table.inhibition_clearance)
    if guardian < 0:
        stop(command)
    elif stands_before_task(reading, guardian):
        follow(reading, memory, command, table, epuck)
    else:
        away = wrapped(reading.blobs[guardian].bearing + math.pi)
        speed = 0.0 if presses_member(reading, table.member_clearance) else table.follow_speed
        steer(command, away, speed, table.steering_gain, table.turn_rate, epuck.wheel_distance)


@compiled
def roam(reading, memory, command, table, epuck):
    """Walk or follow, unless there is something better to do."""
    cycle = reading.cycle
    wandering = cycle < memory.wander_until
    if may_visit(memory, cycle, table) and (
        meets_unattended_task(reading, memory, table) or is_directed_to_task(reading, memory, table)
    ):
        return
    if is_invited(reading, memory, table):
        enter(memory, State.JOIN, cycle)
        return
    busy = wandering or memory.notifying == 1 or cycle < memory.inhibiting_until
    task = nearest_task(reading)
    if memory.inhibition_ahead == cycle and not busy and task >= 0:
        respond_to_inhibition(reading, memory, command, table, task)
        return
    if memory.state != State.FOLLOW and not wandering and meets_chain(reading, memory, table):
        enter(memory, State.FOLLOW, cycle)
    if memory.state == State.WALK:
        walk(reading, memory, command, table, epuck)
    elif memory.state == State.TURN:
        turn(reading, memory, command, table, epuck)
    elif memory.state == State.FOLLOW:
        follow(reading, memory, command, table, epuck)


@compiled
def yields(reading, memory, table):
    """Tell whether an approaching robot gives way to another that has set out for the task.

    The guardian repeats the inhibition of whoever came first; without one the larger identity goes first. Who is
    in the mouth already goes on.
    """
    near = memory.target.known == 1 and distance_to(memory.target) < table.straight_within
    if near or memory.inhibition_heard != reading.cycle:
        return False
    return memory.echo_heard == reading.cycle or memory.inhibitor > reading.identity


@compiled
def finish_notification(reading, memory, table):
    """End a notification when the guardian's own advertisement shows that it arrived, or after a long time (U54)."""
    if memory.notifying == 0:
        return
    cycle = reading.cycle
    since = cycle - memory.verdict_heard
    advert = memory.adverts[memory.colour]
    fresh = cycle - advert.heard <= 1
    if table.mark == 2:
        arrived = advert.solved == 1 or advert.number != memory.reported
    else:
        arrived = advert.confident == 1 or (memory.verdict == 0 and advert.count > memory.reported)
    if (fresh and arrived and since >= table.notify_least) or since > table.notify_patience:
        memory.notifying = 0


@compiled
def speak(reading, memory, command, table):
    """Say what there is to say: a request, a notification, an inhibition. Runners are silent otherwise (TS-41)."""
    asks = memory.state == State.JOIN
    visiting = State.APPROACH <= memory.state <= State.STAND_OFF
    inhibits = visiting or reading.cycle < memory.inhibiting_until
    notifies = memory.notifying == 1 and memory.state != State.EXCHANGE
    if not (asks or inhibits or notifies):
        return
    begin_message(memory, reading.identity)
    memory.message.request = 1 if asks else 0
    memory.message.inhibit = 1 if inhibits else 0
    if notifies:
        memory.message.direction = memory.verdict
        if table.mark == 2:
            memory.message.report = 1
            memory.message.number = memory.reported
        else:
            memory.message.count = memory.reported
    send(memory, command, table)


@compiled
def run(reading, memory, command, table, epuck):
    """Live one cycle as a runner."""
    command.colour = Colour.OFF
    finish_notification(reading, memory, table)
    state = memory.state
    if state <= State.FOLLOW:
        roam(reading, memory, command, table, epuck)
    elif state == State.APPROACH:
        if yields(reading, memory, table):
            enter(memory, State.INHIBITED, reading.cycle)
        else:
            approach(reading, memory, command, table, epuck)
    elif state == State.EXCHANGE:
        exchange(reading, memory, command, table)
    elif state == State.TURN_ROUND:
        turning_round(reading, memory, command, table, epuck)
    elif state == State.LEAVE:
        leave(reading, memory, command, table, epuck)
    elif state == State.STAND_OFF:
        stand_off(reading, memory, command, table, epuck)
    elif state == State.PAUSE:
        pause(reading, memory, command, table, epuck)
    elif state == State.JOIN:
        join(reading, memory, command, table)
    elif state == State.INHIBITED:
        keep_clear(reading, memory, command, table, epuck)
    if memory.role == Role.RUNNER:
        speak(reading, memory, command, table)

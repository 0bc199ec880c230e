"""What is measured in a sequencing trial: events as they happen, one outcome row at the end (TS-136 to TS-138)."""

from typing import Any

import numpy as np

from formicarium.compiled import compiled
from formicarium.devices.booth import BAY_END, BAY_HALF_WIDTH, HALF
from formicarium.observers.referee import executed, locate
from formicarium.robots.infrared import NOTED, SUCCESS
from formicarium.systems.sequencing.log import EventKind
from formicarium.systems.sequencing.memory import Role
from formicarium.systems.sequencing.ring_measures import (
    founded,
    note_loop,
    note_mixed,
    note_ring,
    ring_cause,
    ring_outcome,
)
from formicarium.trial.events import write_event

DISPLACED = 0.06  # m, a chain member pushed this far from where it settled is logged once


@compiled
def note(state):
    """Write down what has happened in this cycle. Nothing here is seen by a robot."""
    clock = state.clock[0]
    first_event = clock.event_count
    note_tasks(state)
    note_robots(state)
    if state.behaviour[0].mark == 2:
        note_loop(state)
    note_progress(state, first_event)
    if state.chain[0].sequences >= state.swarm[0].sequences:
        clock.finished = 1
    elif idle_too_long(state):
        end_as_hopeless(state, 0)
    elif stalled_too_long(state):
        end_as_hopeless(state, 1)


@compiled
def note_progress(state, first_event):
    """Remember when the chain was complete, its search went on or a sequence was done, whatever came last."""
    clock = state.clock[0]
    for number in range(first_event, clock.event_count):
        kind = state.events[number].kind
        found = kind == EventKind.STEP or kind == EventKind.SOLVED
        if found or kind == EventKind.CHAIN or kind == EventKind.SEQUENCE:
            state.chain[0].progress = clock.cycle


@compiled
def idle_too_long(state):
    """Tell whether nobody has been a runner for ``idle_limit``.

    Chain members never become runners again, so nobody will do a task any more.
    """
    limit = state.swarm[0].idle_limit
    if limit == 0.0:
        return False
    chain = state.chain[0]
    chain.idle += 1
    for i in range(len(state.robots)):
        if state.robots[i].alive == 1 and state.memories[i].role == Role.RUNNER:
            chain.idle = 0
            return False
    return chain.idle * state.world.settings[0].cycle_time >= limit


@compiled
def stalled_too_long(state):
    """Tell whether a complete chain has made no progress for ``stall_limit``.

    A guess, unlike idleness, so it has to be checked. An unfinished chain may be finished at any time.
    """
    limit = state.swarm[0].stall_limit
    chain = state.chain[0]
    cycles = state.clock[0].cycle - chain.progress
    return limit > 0.0 and chain.complete > 0 and cycles * state.world.settings[0].cycle_time >= limit


@compiled
def end_as_hopeless(state, reason):
    """End a trial before its cap, to which it counts as run (TS-145)."""
    clock = state.clock[0]
    write_event(clock, state.events, EventKind.HOPELESS, 0, 0, reason, 0)
    clock.finished = 1


@compiled
def note_tasks(state):
    """Log visits and executions; let the referee judge by physical presence and count sequences."""
    clock = state.clock[0]
    chain = state.chain[0]
    cycle = clock.cycle
    task_cycles = int(state.booth_table[0].task_time / state.world.settings[0].cycle_time + 0.5)
    for i in range(len(state.robots)):
        locate(state.referee[i], state.world.bodies[i], state.booths, HALF, BAY_HALF_WIDTH, BAY_END, cycle)
    for b in range(len(state.booths)):
        booth = state.booths[b]
        visiting = booth.occupied == 1
        if visiting != (chain.visits[b] > 0):
            who = state.robots[booth.visitor].identity if visiting else 0
            write_event(clock, state.events, EventKind.VISIT, who, booth.colour, 1 if visiting else 0, 0)
            if visiting and booth.mute == 1:
                write_event(clock, state.events, EventKind.NO_ANSWER, who, booth.colour, 0, 0)
            chain.visits[b] = cycle + 1 if visiting else 0
        if visiting and booth.verdict != 0 and booth.judged == cycle:
            note_execution(state, b, task_cycles)


@compiled
def note_execution(state, b, task_cycles):
    """Log one execution and compare the booth's verdict with what the referee saw."""
    clock = state.clock[0]
    chain = state.chain[0]
    booth = state.booths[b]
    i = booth.visitor
    who = state.robots[i].identity
    record = state.referee[i]
    success = booth.verdict == SUCCESS
    verdict = 1 if success else 2 if booth.verdict == NOTED else 0
    write_event(clock, state.events, EventKind.EXECUTED, who, booth.colour, verdict, booth.claim)
    coordinator = state.coordinator[0]
    if coordinator.faults > chain.faults:
        chain.faults = coordinator.faults
        write_event(clock, state.events, EventKind.PROTOCOL_FAULT, who, booth.colour, booth.claim, 0)
    present = record.booth == b and clock.cycle - record.since >= task_cycles
    complete = present and executed(record, booth.colour, coordinator.order, coordinator.tasks)
    claimed = success and booth.claim == coordinator.tasks
    if coordinator.delayed == 1:
        complete = complete and claimed  # in the right order by chance, across two sequences: nobody is told
        note_mixed(state, i, booth.colour, booth.claim)
    if not present or complete != claimed:
        write_event(clock, state.events, EventKind.DISAGREEMENT, who, booth.colour, 0, 0)
    own_first = state.memories[i].candidate == 1  # a future guardian's own execution never counts (TS-137)
    if complete and not own_first:
        chain.sequences += 1
        write_event(clock, state.events, EventKind.SEQUENCE, who, 0, chain.sequences, 0)


@compiled
def note_robots(state):
    """Log changes of role, guardians' learning, branches, displacements and deaths."""
    clock = state.clock[0]
    for i in range(len(state.robots)):
        robot = state.robots[i]
        memory = state.memories[i]
        member = state.members[i]
        who = robot.identity
        subject = memory.colour if memory.role == Role.GUARDIAN else memory.branch
        if robot.alive == 0 and member.dead == 0:
            member.dead = 1
            write_event(clock, state.events, EventKind.DIED, who, subject, memory.role, 0)
        if memory.role != member.role:
            write_event(clock, state.events, EventKind.ROLE, who, subject, memory.role, member.role)
            member.settled = 0
        if memory.role == Role.GUARDIAN and state.behaviour[0].mark == 2:
            note_ring(state, i)
        elif memory.role == Role.GUARDIAN:
            note_guardian(state, i)
        if memory.role == Role.GUARDIAN or (memory.role == Role.LINK and memory.established == 1):
            note_place(state, i, subject)
        if state.swarm[0].log_states == 1 and memory.state != member.state:
            write_event(clock, state.events, EventKind.STATE, who, 0, memory.state, member.state)
        if state.swarm[0].log_messages == 1:
            note_messages(state, i)
        member.role = memory.role
        member.state = memory.state
        member.established = memory.established
        member.condition = memory.condition
        member.confident = memory.confident


@compiled
def note_guardian(state, i):
    """Log what a guardian has learnt, from whom, and the branch that has reached it."""
    clock = state.clock[0]
    memory = state.memories[i]
    member = state.members[i]
    who = state.robots[i].identity
    new = member.role != Role.GUARDIAN
    if new or memory.condition != member.condition or memory.confident != member.confident:
        write_event(clock, state.events, EventKind.CONDITION, who, memory.colour, memory.condition, memory.confident)
        if not new and not founded(state, memory.notified_by, memory.colour):
            write_event(clock, state.events, EventKind.UNFOUNDED, who, memory.colour, memory.notified_by, 0)
    if memory.established == 1 and member.established == 0:
        links = 0
        members = 0
        for j in range(len(state.memories)):
            other = state.memories[j]
            if other.role != Role.RUNNER:
                members += 1
            if other.role == Role.LINK or other.role == Role.TAIL:
                links += 1 if other.branch == memory.branch - 1 else 0
        write_event(clock, state.events, EventKind.BRANCH, who, memory.branch - 1, links, 0)
        if memory.branch == state.behaviour[0].tasks:
            write_event(clock, state.events, EventKind.CHAIN, who, 0, members, 0)
            state.chain[0].complete = clock.cycle
            state.chain[0].members_complete = members


@compiled
def note_place(state, i, subject):
    """Remember where a guardian or an established link stands; log it once when it is pushed away."""
    member = state.members[i]
    body = state.world.bodies[i]
    if member.settled == 0:
        member.settled = 1
        member.x = body.x
        member.y = body.y
    elif member.settled == 1:
        dx = body.x - member.x
        dy = body.y - member.y
        if dx * dx + dy * dy > DISPLACED * DISPLACED:
            member.settled = 2
            who = state.robots[i].identity
            role = state.memories[i].role
            write_event(state.clock[0], state.events, EventKind.DISPLACED, who, subject, role, 0)


@compiled
def note_messages(state, i):
    """Log the bytes a robot sends, once for each different content, with the emitters that carry it."""
    command = state.commands[i]
    done = 0
    for k in range(len(command.enabled)):
        if command.enabled[k] == 0 or done >> k & 1:
            continue
        content = packed(command.payload[k])
        mask = 0
        for other in range(k, len(command.enabled)):
            if command.enabled[other] == 1 and packed(command.payload[other]) == content:
                mask |= 1 << other
        done |= mask
        write_event(state.clock[0], state.events, EventKind.MESSAGE, state.robots[i].identity, content, mask, 0)


@compiled
def packed(payload):
    """Return four bytes as one number, DATA[0] highest."""
    return int(payload[0]) << 24 | int(payload[1]) << 16 | int(payload[2]) << 8 | int(payload[3])


def outcome(state: Any, events: np.ndarray) -> dict[str, int | float | str | None]:
    """Return the row of a finished trial: what was reached when, by how many, and if it failed, why.

    Times are in seconds, None if not reached. A trial that was ended as hopeless counts as run to its cap
    (``duration_s``), and ``hopeless_s`` tells when it was ended.
    """
    cycle_time = float(state.world.settings[0].cycle_time)
    chain = state.chain[0]

    def time_of(kind: EventKind, value: int | None = None) -> float | None:
        chosen = events[(events["kind"] == kind) & (True if value is None else events["value"] == value)]
        return round(float(chosen["cycle"][0] + 1) * cycle_time, 6) if len(chosen) else None

    def number_of(kind: EventKind, **fields: int) -> int:
        chosen = events["kind"] == kind
        for name, value in fields.items():
            chosen = chosen & (events[name] == value)
        return int(chosen.sum())

    roles = state.memories.role[state.robots.alive == 1]  # a dead member is none
    goal = int(state.swarm[0].sequences)
    success = bool(chain.sequences >= goal)
    hopeless = time_of(EventKind.HOPELESS)
    row: dict[str, int | float | str | None] = {
        "success": int(success),
        "sequences": int(chain.sequences),
        "time_chain_s": time_of(EventKind.CHAIN),
        "time_1_s": time_of(EventKind.SEQUENCE, 1),
        "time_5_s": time_of(EventKind.SEQUENCE, 5),
        "time_10_s": time_of(EventKind.SEQUENCE, 10),
        "duration_s": round(float(state.clock[0].last_cycle if hopeless else state.clock[0].cycle) * cycle_time, 6),
        "hopeless_s": hopeless,
        "members_at_completion": int(chain.members_complete) if chain.complete else None,
        "members": int((roles != Role.RUNNER).sum()),
        "guardians": int((roles == Role.GUARDIAN).sum()),
        "links": int((roles == Role.LINK).sum()),
        "tails": int((roles == Role.TAIL).sum()),
        "branches": number_of(EventKind.BRANCH),
        "executions": number_of(EventKind.EXECUTED),
        "failures": number_of(EventKind.EXECUTED, value=0),
        "displaced": number_of(EventKind.DISPLACED),
        "died": number_of(EventKind.DIED),
        "no_answers": number_of(EventKind.NO_ANSWER),
        "protocol_faults": number_of(EventKind.PROTOCOL_FAULT),
        "disagreements": number_of(EventKind.DISAGREEMENT),
        "unfounded": number_of(EventKind.UNFOUNDED),
        "packets_heard": int(state.robots.packets_heard.sum()),
        "blobs_dropped": int(state.robots.blobs_dropped.sum()),
    }
    tasks = int(state.behaviour[0].tasks)
    if state.behaviour[0].mark == 2:
        row |= ring_outcome(state, events)
    row["cause"] = None if success else cause(row, events, len(state.robots), tasks, cycle_time)
    return row


GROWING = 120.0  # s since a robot last took a role: the chain was still growing when time was up
STALLED = 600.0  # s without a new sequence at the end of a trial count as a standstill


def cause(row: dict[str, Any], events: np.ndarray, robots: int, tasks: int, cycle_time: float) -> str:
    """Name why a trial failed, from its event log: the first of these that applies."""
    free = robots - row["members"] - row["died"]
    died = events[events["kind"] == EventKind.DIED]
    if row["guardians"] < tasks and (died["value"] == Role.GUARDIAN).any():
        return "a guardian died"
    if row["guardians"] < tasks:
        return "a task found no guardian"
    if row["guardians"] > tasks:
        return "two guardians for one task"
    if row["time_chain_s"] is None:
        if free <= 0:
            return "all robots in an unfinished chain"
        changes = events[events["kind"] == EventKind.ROLE]
        if len(changes) and row["duration_s"] - float(changes["cycle"][-1]) * cycle_time < GROWING:
            return "chain still growing at the end"
        return ring_cause(row, tasks) or f"branch {row['branches'] + 1} missed its guardian"
    if free <= 0:
        return "all robots in the finished chain"
    named = ring_cause(row, tasks)
    if named:
        return named
    progress = events[np.isin(events["kind"], (EventKind.SEQUENCE, EventKind.STEP, EventKind.SOLVED))]
    last = float(progress["cycle"][-1]) * cycle_time if len(progress) else row["time_chain_s"]
    if row["duration_s"] - last < STALLED:
        return "too slow"
    moved = events[events["kind"] == EventKind.DISPLACED]
    if (moved["value"] == Role.GUARDIAN).any():
        return "guardian displaced"
    if len(moved):
        return "link displaced"
    return "runners stuck"

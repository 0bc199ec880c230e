"""What is measured of the closed loop of Mark II: election, labels, steps, mixed sequences, crossings."""

from typing import Any

import numpy as np

from formicarium.compiled import compiled
from formicarium.systems.sequencing.log import EventKind
from formicarium.systems.sequencing.memory import Role
from formicarium.systems.sequencing.permutations import permutations, place_of
from formicarium.systems.sequencing.ring import STEPS
from formicarium.trial.events import write_event

LOOK = 10  # cycles between two looks at who is inside the loop: 0.12 m at the most


@compiled
def founded(state, identity, colour):
    """Tell whether the robot of that identity did that task last."""
    for j in range(len(state.robots)):
        if state.robots[j].identity == identity:
            return state.referee[j].last == colour
    return False


@compiled
def note_ring(state, i):
    """Log what a guardian says in the election and the search, and the branch that has reached it."""
    clock = state.clock[0]
    memory = state.memories[i]
    ring = memory.ring
    member = state.members[i]
    who = state.robots[i].identity
    colour = memory.colour
    if member.role != Role.GUARDIAN or memory.condition != member.condition:
        write_event(clock, state.events, EventKind.CONDITION, who, colour, memory.condition, ring.label > 0)
    if ring.election == 1 and member.election == 0:
        write_event(clock, state.events, EventKind.ELECTION, who, colour, 0, 0)
    if ring.label != member.label:
        write_event(clock, state.events, EventKind.LABEL, who, colour, ring.label, 0)
    if ring.upi != member.upi:
        write_event(clock, state.events, EventKind.STEP, who, colour, ring.upi, 0)
    if ring.solved != member.solved:
        write_event(clock, state.events, EventKind.SOLVED, who, colour, ring.upi, 0)
    news = ring.upi != member.upi or ring.solved != member.solved
    if news and ring.source == who and not founded(state, memory.notified_by, colour):
        write_event(clock, state.events, EventKind.UNFOUNDED, who, colour, memory.notified_by, 0)
    if memory.established == 1 and member.established == 0:
        note_branch(state, who)
    member.election = ring.election
    member.label = ring.label
    member.upi = ring.upi
    member.solved = ring.solved


@compiled
def note_branch(state, reached):
    """Log the branch whose tail has asked the guardian ``reached`` to take over: where it starts, its links."""
    memories = state.memories
    origin = 0
    for j in range(len(memories)):
        if (memories[j].role == Role.TAIL or memories[j].role == Role.LINK) and memories[j].asked == reached:
            origin = memories[j].branch
    colour = 0
    links = 0
    for j in range(len(memories)):
        if memories[j].role == Role.GUARDIAN and state.robots[j].identity == origin:
            colour = memories[j].colour
        elif (memories[j].role == Role.TAIL or memories[j].role == Role.LINK) and memories[j].branch == origin:
            links += 1
    write_event(state.clock[0], state.events, EventKind.BRANCH, reached, colour, links, 0)


@compiled
def note_mixed(state, i, colour, claim):
    """Log an execution that belongs to another permutation than the first of the robot's sequence (TS-128)."""
    for j in range(len(state.memories)):
        memory = state.memories[j]
        if memory.role != Role.GUARDIAN or memory.colour != colour or state.robots[j].alive == 0:
            continue
        upi = memory.ring.upi - (memory.ring.upi - state.memories[i].step) % STEPS
        member = state.members[i]
        if claim == 1:
            member.begun = upi
        elif upi != member.begun:
            who = state.robots[i].identity
            write_event(state.clock[0], state.events, EventKind.MIXED, who, colour, upi, member.begun)


@compiled
def note_loop(state):
    """Log when the loop is closed, every guardian being IN and OUT, and from then on who crosses it."""
    chain = state.chain[0]
    clock = state.clock[0]
    if chain.complete > 0:
        if clock.cycle % LOOK == 0:
            note_crossings(state)
        return
    closed = 0
    members = 0
    for memory in state.memories:
        if memory.role == Role.GUARDIAN and memory.established == 1 and memory.ring.out == 1:
            closed += 1
        if memory.role != Role.RUNNER:
            members += 1
    if closed < state.behaviour[0].tasks:
        return
    chain.complete = clock.cycle
    chain.members_complete = members
    write_event(clock, state.events, EventKind.CHAIN, 0, 0, members, 0)
    for i in range(len(state.memories)):
        state.members[i].next = -1
        for j in range(len(state.robots)):
            if state.memories[i].role != Role.RUNNER and state.robots[j].identity == state.memories[i].chosen:
                state.members[i].next = j


@compiled
def is_inside(state, x, y):
    """Tell whether a point is inside the loop: a ray to the right crosses an odd number of its edges."""
    bodies = state.world.bodies
    inside = False
    for i in range(len(bodies)):
        if state.members[i].next < 0:
            continue
        one = bodies[i]
        other = bodies[state.members[i].next]
        if (one.y > y) != (other.y > y):
            if one.x + (y - one.y) / (other.y - one.y) * (other.x - one.x) > x:
                inside = not inside
    return inside


@compiled
def note_crossings(state):
    """Log every runner that is on another side of the loop than at the last look."""
    for i in range(len(state.memories)):
        if state.memories[i].role != Role.RUNNER:
            continue
        body = state.world.bodies[i]
        side = 2 if is_inside(state, body.x, body.y) else 1
        if state.members[i].side == 3 - side:
            who = state.robots[i].identity
            write_event(state.clock[0], state.events, EventKind.CROSSING, who, 0, side - 1, 0)
        state.members[i].side = side


def correct_upi(labels: dict[int, int], order: list[int]) -> int | None:
    """Return the UPI of the correct order, given the label of every task colour; None if one has no label."""
    tasks = len(order)
    for upi in range(permutations(tasks)):
        if all(place_of(labels.get(colour, 0), upi, tasks) == k for k, colour in enumerate(order)):
            return upi
    return None


def ring_outcome(state: Any, events: np.ndarray) -> dict[str, int | float | str | None]:
    """Return what the row of a Mark II trial has besides the others."""
    tasks = int(state.behaviour[0].tasks)
    cycle_time = float(state.world.settings[0].cycle_time)

    def of(kind: EventKind) -> np.ndarray:
        return events[events["kind"] == kind]

    def time_of(chosen: np.ndarray, n: int = 0) -> float | None:
        return round(float(chosen["cycle"][n] + 1) * cycle_time, 6) if len(chosen) > n else None

    labels = {int(event["subject"]): int(event["value"]) for event in of(EventKind.LABEL)}
    order = [int(colour) for colour in state.coordinator[0].order[:tasks]]
    solved, sequences, executed = of(EventKind.SOLVED), of(EventKind.SEQUENCE), of(EventKind.EXECUTED)
    first = sequences["cycle"][0] if len(sequences) else np.iinfo(np.int64).max
    failed = executed[(executed["value"] == 0) & (executed["detail"] == tasks) & (executed["cycle"] < first)]
    guardians = state.memories.ring.upi[(state.memories.role == Role.GUARDIAN) & (state.robots.alive == 1)]
    runners = (state.memories.role == Role.RUNNER) & (state.robots.alive == 1)
    return {
        "time_elected_s": time_of(of(EventKind.LABEL), tasks - 1),
        "time_solved_s": time_of(solved),
        "steps": int(guardians.max(initial=0)),
        "steps_behind": int(guardians.max(initial=0) - guardians.min(initial=10**6)) if len(guardians) else 0,
        "upi_found": int(solved["value"][0]) % permutations(tasks) if len(solved) else None,
        "upi_correct": correct_upi(labels, order),
        "failed_sequences": len(failed),
        "mixed": len(of(EventKind.MIXED)),
        "crossings": len(of(EventKind.CROSSING)),
        "runners": int(runners.sum()),
        "runners_inside": int((state.members.side[runners] == 2).sum()),
        "branch_links": " ".join(str(int(links)) for links in of(EventKind.BRANCH)["value"]),
    }


def ring_cause(row: dict[str, Any], tasks: int) -> str | None:
    """Name why a trial of Mark II failed, as far as the loop is the reason; None if it is not, or in Mark I."""
    if "upi_correct" not in row:
        return None
    if row["time_chain_s"] is None:
        missing = tasks - row["branches"]
        if missing == 0:
            return "the loop did not close"
        return (
            "a branch lost its tail"
            if row["tails"] < missing
            else f"{missing} of {tasks} branches missed their guardian"
        )
    if row["time_elected_s"] is None:
        return "no election"
    if row["time_solved_s"] is not None and row["upi_found"] != row["upi_correct"]:
        return "a wrong order taken for right"
    if row["steps_behind"] > 0:
        return "news did not get round the loop"
    if row["runners_inside"] == row["runners"]:
        return "all free robots inside the loop"
    return None

"""What is measured in a coverage trial: events as they happen, and from what the observers keep one outcome row."""

import math
from enum import IntEnum
from typing import Any

import numpy as np

from formicarium.compiled import compiled
from formicarium.observers.graphs import GRAPHS, Graph, count_cut_robots, find_links, see_connection
from formicarium.observers.prominences import TARGETS, see_axis
from formicarium.observers.spectrum import lambda_2
from formicarium.robots.footbot import ARMS
from formicarium.systems.coverage.credit import give_credit, mission_columns
from formicarium.systems.coverage.listening import round_of
from formicarium.systems.coverage.memory import Mode, Planning, Stage
from formicarium.trial.events import write_event

LONG_ARM = 20.0  # m, of the claim on the density of long arms (ST-66)
MIDDAY = 600.0  # s, at which lengths are noted too (ST-62)


class EventKind(IntEnum):
    """What the log tells; ``robot`` is the identity of the robot concerned."""

    PHASE = 0  # a robot has heard of a phase; subject: Mode; value: epoch
    ARM = 1  # a robot has drawn an arm; subject: arm; value: arm before
    ROLE = 2  # value: new Role; detail: old one
    PARTED = 3  # subject: Graph; value: robots that do not reach the master; detail: components
    JOINED = 4  # subject: Graph; value: cycles for which it was parted
    TARGET = 5  # an arm has been beyond a target for a second; subject: arm; value: target, mm; detail: first cycle
    COVERED = 6  # a connected robot is at a task; subject: arm
    UNCOVERED = 7  # subject: arm; value: cycles for which it was covered
    DIED = 8
    DONE = 9  # the master's programme is over
    WORKED = 10  # a task of a mission has been worked on for as long as it takes; subject: task; value: cycles
    FOLLOWED = 11  # a robot has taken the master's part; value: how many have had it, with this one
    PLANNED = 12  # the master has a new plan of what is left; subject: its slots; value: how many new ones so far
    AIMED = 13  # an arm of a slot that was not planned before the trial; subject: arm; value: task; detail: round


class Role(IntEnum):
    """What a robot is, as frames and timelines show it."""

    MASTER = 0
    WAITING = 1
    FLOCKING = 2
    SPIRALLING = 3
    ARM = 4
    HOLDING = 5
    LOST = 6
    GATHERING = 7
    DEAD = 8


SEEN = np.dtype([("role", "i8"), ("epoch", "i8"), ("arm", "i8")], align=True)
SURVEY = np.dtype(
    [
        ("master", "i8"),  # its body; of several the newest, and of those the one of the lowest number
        ("term", "i8"),  # newest master that is known of
        ("plans", "i8"),  # new ones of this master's
        ("planned", "i8"),  # new ones of all masters
        ("aimed", "i8"),  # round of the last slot whose tasks were told
        ("asked", "i8"),  # 1 while a master waits for a new plan
        ("structure_every", "i8"),  # cycles
        ("spectrum_every", "i8"),
        ("looks", "i8"),  # at the structure of the whole range graph
        ("firm", "i8"),  # of those, with no robot whose loss would part it
        ("cut_robots", "i8"),  # sum over looks of robots whose loss would
        ("long_looks", "i8"),  # the same three, with an arm of more than LONG_ARM
        ("long_firm", "i8"),
        ("long_cut_robots", "i8"),
        ("spectra", "i8"),
        ("lambda_sum", "f8"),
        ("least_lambda", "f8"),
        ("last_lambda", "f8"),
        ("midday_front", "f8"),  # m, of the longest arm
        ("bytes_most", "i8"),
        ("bytes_sum", "i8"),
        ("messages", "i8"),
        ("fastest", "f8"),  # m2/s2, square of the greatest speed of any body
    ],
    align=True,
)


@compiled
def role_of(robot, memory):
    """Return a robot's Role."""
    if robot.alive == 0:
        return Role.DEAD
    if memory.master == 1:
        return Role.MASTER
    stage = memory.stage
    if stage == Stage.FLOCKING:
        return Role.FLOCKING
    if stage == Stage.SPIRALLING:
        return Role.SPIRALLING
    if stage == Stage.ALIGNED or stage == Stage.BLIND:
        return Role.ARM
    if stage == Stage.LOST:
        return Role.LOST
    if stage == Stage.HOLDING:
        return Role.HOLDING
    if stage == Stage.GATHERING:
        return Role.GATHERING
    return Role.WAITING


@compiled
def note(state):
    """Write down what has happened in this cycle. Nothing here is seen by a robot."""
    clock = state.clock[0]
    survey = state.survey[0]
    note_master(state)
    note_robots(state)
    find_links(state)
    for graph in range(GRAPHS):
        note_connection(state, graph)
    for k in range(len(state.axes)):
        target = see_axis(state.axes[k], state, survey.master)
        if target >= 0:
            axis = state.axes[k]
            length = int(1000.0 * axis.target[target] + 0.5)
            write_event(clock, state.events, EventKind.TARGET, 0, k + 1, length, axis.first[target])
        note_task(state, k)
        if give_credit(state, k):
            write_event(clock, state.events, EventKind.WORKED, 0, k + 1, state.tasks[k].needed, 0)
    note_structure(state)
    if state.memories[survey.master].done == 1 and clock.finished == 0:
        clock.finished = 1
        write_event(clock, state.events, EventKind.DONE, state.robots[survey.master].identity, 0, 0, 0)


@compiled
def note_master(state):
    """See who leads now, if that is another than before, and whether somebody waits for a new plan."""
    clock = state.clock[0]
    survey = state.survey[0]
    survey.asked = 0
    for place in range(len(state.robots)):
        i = state.world.lists[place].order
        memory = state.memories[i]
        if state.robots[i].alive == 0 or memory.master == 0:
            continue
        if memory.planning == Planning.ASKED:
            survey.asked = 1
        if leads_rather(state, i, survey.master):
            survey.master = i
            survey.plans = 0
    memory = state.memories[survey.master]
    if memory.term > max(1, survey.term):
        survey.term = memory.term
        write_event(clock, state.events, EventKind.FOLLOWED, state.robots[survey.master].identity, 0, memory.term, 0)
    if memory.plans > survey.plans:
        survey.plans = memory.plans
        survey.planned += 1
        who = state.robots[survey.master].identity
        write_event(clock, state.events, EventKind.PLANNED, who, memory.slot_count, survey.planned, 0)
    if (survey.planned > 0 or survey.term > 1) and memory.arm_count > 0 and round_of(memory.epoch) > survey.aimed:
        survey.aimed = round_of(memory.epoch)
        for k in range(memory.arm_count):
            who = state.robots[survey.master].identity
            write_event(clock, state.events, EventKind.AIMED, who, k + 1, memory.arms[k].task, survey.aimed)


@compiled
def leads_rather(state, i, master):
    """Tell whether body ``i``, a living master, is to be looked at instead of ``master``."""
    if state.robots[master].alive == 0 or state.memories[master].master == 0:
        return True
    if state.memories[i].term != state.memories[master].term:
        return state.memories[i].term > state.memories[master].term
    return state.robots[i].identity < state.robots[master].identity


@compiled
def note_robots(state):
    """Log what robots have newly become, heard or chosen, and measure what they say and how fast they move."""
    clock = state.clock[0]
    survey = state.survey[0]
    for i in range(len(state.robots)):
        robot = state.robots[i]
        memory = state.memories[i]
        seen = state.seen[i]
        if robot.alive == 0 and robot.dies_at == clock.cycle:
            write_event(clock, state.events, EventKind.DIED, robot.identity, 0, 0, 0)
        if memory.epoch != seen.epoch and robot.alive == 1:
            seen.epoch = memory.epoch
            write_event(clock, state.events, EventKind.PHASE, robot.identity, memory.mode, memory.epoch, 0)
        if memory.arm != seen.arm:
            write_event(clock, state.events, EventKind.ARM, robot.identity, memory.arm, seen.arm, 0)
            seen.arm = memory.arm
        role = role_of(robot, memory)
        if role != seen.role:
            write_event(clock, state.events, EventKind.ROLE, robot.identity, 0, role, seen.role)
            seen.role = role
        if state.commands[i].enabled[0] == 1:
            size = state.commands[i].message.bytes
            survey.bytes_most = max(survey.bytes_most, size)
            survey.bytes_sum += size
            survey.messages += 1
        body = state.world.bodies[i]
        survey.fastest = max(survey.fastest, body.speed_x * body.speed_x + body.speed_y * body.speed_y)


@compiled
def note_connection(state, graph):
    """Look at one graph and log when it parts and when it is whole again."""
    clock = state.clock[0]
    connection = state.connections[graph]
    began = connection.lost_since
    if graph == Graph.HEARD and clock.cycle < 2:
        return  # nobody can have answered yet
    if see_connection(state, graph, state.survey[0].master):
        if connection.lost_since >= 0:
            away = connection.living - connection.reached
            write_event(clock, state.events, EventKind.PARTED, 0, graph, away, connection.components)
        else:
            write_event(clock, state.events, EventKind.JOINED, 0, graph, clock.cycle - began, 0)


@compiled
def note_task(state, k):
    """Note whether a robot in sight of the master's component is at a task (ST-70)."""
    clock = state.clock[0]
    beacon = state.beacons[k]
    task = state.tasks[k]
    reach = state.footbot[0].beacon_range
    covered = 0
    for i in range(len(state.robots)):
        if state.places[i].reached[Graph.SIGHT] == 1 and state.robots[i].alive == 1:
            dx = state.world.bodies[i].x - beacon.x
            dy = state.world.bodies[i].y - beacon.y
            if dx * dx + dy * dy <= reach * reach:
                covered = 1
    task.cycles += covered
    if covered == 1 and task.covered == 0:
        if task.first == 0:
            task.first = clock.cycle
        task.since = clock.cycle
        write_event(clock, state.events, EventKind.COVERED, 0, k + 1, 0, 0)
    elif covered == 0 and task.covered == 1:
        write_event(clock, state.events, EventKind.UNCOVERED, 0, k + 1, clock.cycle - task.since, 0)
    task.covered = covered


@compiled
def note_structure(state):
    """Now and then: who would part the swarm by its loss, and lambda_2."""
    cycle = state.clock[0].cycle
    survey = state.survey[0]
    if cycle == int(MIDDAY / state.world.settings[0].cycle_time + 0.5) - 1:
        for k in range(len(state.axes)):
            survey.midday_front = max(survey.midday_front, state.axes[k].front)
    if cycle % survey.structure_every == 0 and state.connections[0].reached == state.connections[0].living:
        neighbours, counts = state.world.neighbours, state.world.neighbour_count
        cut = count_cut_robots(neighbours, counts, state.links, state.places, Graph.RANGE, survey.master)
        survey.looks += 1
        survey.cut_robots += cut
        survey.firm += 1 if cut == 0 else 0
        for k in range(len(state.axes)):
            if state.axes[k].front > LONG_ARM:
                survey.long_looks += 1
                survey.long_cut_robots += cut
                survey.long_firm += 1 if cut == 0 else 0
                break
    if cycle % survey.spectrum_every == 0:
        value = lambda_2(state, state.laplacian, state.rows)
        survey.spectra += 1
        survey.lambda_sum += value
        survey.least_lambda = min(survey.least_lambda, value)
        survey.last_lambda = value


def seconds(cycle: int, cycle_time: float) -> float | None:
    """Return the time at which a cycle has passed, None for none."""
    return round((int(cycle) + 1) * cycle_time, 6) if cycle >= 0 else None


def outcome(state: Any, events: np.ndarray) -> dict[str, int | float | str | None]:
    """Return the row of a finished trial; lengths in metres, times in seconds from its start.

    Columns that end in a graph's name are of that graph; those that end in _1, _2, ... of that arm.
    """
    cycle_time = float(state.world.settings[0].cycle_time)
    cycles = max(1, int(state.clock[0].cycle))
    survey = state.survey[0]
    chart = state.charts[survey.master]
    last_slot = chart.slots[int(chart.slot_count) - 1]
    row: dict[str, int | float | str | None] = {"duration_s": round(cycles * cycle_time, 6)}
    for graph in Graph:
        c = state.connections[graph]
        name = graph.name.lower()
        row[f"lost_share_{name}"] = int(c.lost_cycles) / cycles
        row[f"losses_{name}"] = int(c.losses)
        row[f"first_loss_{name}_s"] = seconds(c.first_loss, cycle_time)
        row[f"longest_loss_{name}_s"] = round(int(c.longest_loss) * cycle_time, 6)
        row[f"unreached_{name}"] = int(c.living - c.reached)
    row |= arms_of(state, cycle_time)
    looks, long_looks = max(1, int(survey.looks)), max(1, int(survey.long_looks))
    row |= {
        "length_600_m": float(survey.midday_front),
        "firm_share": int(survey.firm) / looks,
        "cut_robots_mean": int(survey.cut_robots) / looks,
        "long_arm_looks": int(survey.long_looks),
        "long_arm_firm_share": int(survey.long_firm) / long_looks if survey.long_looks else None,
        "long_arm_cut_robots": int(survey.long_cut_robots) / long_looks if survey.long_looks else None,
        "lambda_2_least": float(survey.least_lambda) if survey.spectra else None,
        "lambda_2_mean": float(survey.lambda_sum) / max(1, int(survey.spectra)),
        "lambda_2_last": float(survey.last_lambda),
        "bytes_most": int(survey.bytes_most),
        "bytes_mean": int(survey.bytes_sum) / max(1, int(survey.messages)),
        "flips_per_robot_minute": 60.0 * float(state.memories.flips.sum()) / (len(state.robots) * cycles * cycle_time),
        "fastest_m_s": math.sqrt(float(survey.fastest)),
        "died": int((events["kind"] == EventKind.DIED).sum()),
        "done": int(state.clock[0].finished),
        "held_s": round(int(state.memories[survey.master].held) * cycle_time, 6),
        "held": int(state.memories[survey.master].held >= max(1, last_slot.hold_cycles)),
    }
    for mode, name in ((Mode.ERUPT, "erupt"), (Mode.HOLD, "hold"), (Mode.GATHER, "gather")):
        calls = events[(events["kind"] == EventKind.PHASE) & (events["subject"] == mode)]
        row[f"{name}_called_s"] = seconds(calls["cycle"].min(), cycle_time) if len(calls) else None
        row[f"{name}_spread_s"] = float(np.ptp(calls["cycle"])) * cycle_time if len(calls) else None
    if state.tasks[0].needed > 0:
        row |= mission_columns(state, calls_of(events))
    return row


def calls_of(events: np.ndarray) -> list[tuple[int, int]]:
    """Return (cycle, Mode) of each phase from when its caller, the first to hear of it, has called it out."""
    heard = events[events["kind"] == EventKind.PHASE]
    _, firsts = np.unique(heard["value"], return_index=True)  # events are in the order of cycles
    return sorted((int(heard["cycle"][k]), int(heard["subject"][k])) for k in firsts)


def arms_of(state: Any, cycle_time: float) -> dict[str, int | float | str | None]:
    """Return the columns on arms: over all of them, and of each."""
    axes, tasks = np.asarray(state.axes), np.asarray(state.tasks)
    longest = int(axes["longest"].argmax())
    row: dict[str, int | float | str | None] = {
        "length_m": float(axes["longest"].max()),
        "length_at_s": seconds(axes["longest_at"][longest], cycle_time),
        "length_any_m": float(axes["longest_detached"].max()),
        "length_end_m": float(axes["front"].max()),
        "density_m": per_metre(axes["longest_members"][longest], axes["longest"][longest]),
        "density_end_m": per_metre(axes["members"].sum(), axes["front"].sum()),
        "tasks_covered": int((tasks["cycles"] > 0).sum()),
        "tasks_covered_end": int(tasks["covered"].sum()),
    }
    for k in range(TARGETS):
        name = ("2r2", "3r2", "5r2", "10r2", "15r2", "task")[k]
        firsts = axes["first"][:, k]
        row[f"arms_{name}"] = int((firsts >= 0).sum())
        row[f"latency_{name}_s"] = seconds(firsts[firsts >= 0].min(), cycle_time) if (firsts >= 0).any() else None
    for k in range(ARMS):
        axis = axes[k] if k < len(axes) else None
        row[f"length_{k + 1}_m"] = None if axis is None else float(axis["longest"])
        row[f"latency_task_{k + 1}_s"] = None if axis is None else seconds(axis["first"][TARGETS - 1], cycle_time)
    return row


def per_metre(count: int, length: float) -> float | None:
    """Return robots per metre."""
    return float(count) / float(length) if length > 0.0 else None

"""What is measured in a partitioning trial: events as they happen, and from them one outcome row (TP-72, TP-84)."""

from enum import IntEnum
from typing import Any

import numpy as np

from formicarium.compiled import compiled
from formicarium.devices.depot import Place
from formicarium.observers.objects import PHANTOM, see_arrival, see_departure
from formicarium.systems.partitioning.memory import Area, Deed, Estimate, Label, State
from formicarium.trial.events import write_event


class EventKind(IntEnum):
    """What the log tells; ``robot`` is the identity of the robot concerned. Times are in cycles."""

    BEGAN = 0  # decided at the start, in the nest area; subject: Label
    HARVESTED = 1  # subject: Label chosen; value: time measured; detail: Estimate it renewed
    STORED = 2  # the same
    DROPPED = 3  # subject: pair; value: cycles since the robot began to wait, 0 if it did not
    PICKED = 4  # the same
    GAVE_UP = 5  # subject: lights of its colour in view (0); value: cycles waited; detail: draws made
    VISIT = 6  # a robot has left a cache booth; subject: Place; value: pair; detail: cycles inside
    PHANTOM = 7  # the cache has an object that nobody dropped; subject: Place; value: pair
    LOST = 8  # the cache has given away an object that nobody took; subject: Place; value: pair
    UNFOUNDED = 9  # a robot believes in a hand-over that the cache knows nothing of; subject: Deed
    ESCAPED = 10  # a robot was stuck and backed off; value: how often so far
    DIED = 11
    PROBABILITY = 12  # on request, with each decision; value: P_p in millionths; detail: Deed that led to it
    ROLE = 13  # value: new Role; detail: old one
    ESTIMATES = 14  # on request, with each decision; subject: of harvesting, value: of storing, detail: of the whole
    PASSED_ON = 15  # dropped between two caches; subject: Label chosen; value: time measured; detail: Estimate
    TAKEN_ON = 16  # picked up between two caches by a robot with a tree of tasks; the same


class Role(IntEnum):
    """What a robot is at, as frames and timelines show it."""

    HARVEST = 0  # at the source
    CACHE = 1  # on its way to the cache, waiting there, or in it
    CORRIDOR = 2
    STORE = 3  # at the nest


# What the observers know of each robot since the last cycle.
SEEN = np.dtype([("role", "i8"), ("escapes", "i8")], align=True)


@compiled
def role_of(state):
    """Return the role that a State belongs to."""
    if state == State.GO_SOURCE or state == State.ENTER_SOURCE:
        return Role.HARVEST
    if state == State.GO_NEST or state == State.ENTER_NEST:
        return Role.STORE
    if state == State.CORRIDOR_TO_NEST or state == State.CORRIDOR_TO_SOURCE:
        return Role.CORRIDOR
    return Role.CACHE


@compiled
def note(state):
    """Write down what has happened in this cycle. Nothing here is seen by a robot."""
    note_visits(state)
    for i in range(len(state.robots)):
        note_robot(state, i)


@compiled
def note_visits(state):
    """Watch the cache's booths for visits, phantom objects and lost ones."""
    clock = state.clock[0]
    for b in range(len(state.depots)):
        depot = state.depots[b]
        visit = state.visits[b]
        if depot.pair < 0 or depot.occupied == visit.occupied:
            continue
        if depot.occupied == 1:
            see_arrival(visit, depot, state.memories[depot.visitor].loaded, clock.cycle)
            continue
        who = state.robots[visit.visitor].identity
        finding = see_departure(visit, depot.place == Place.CACHE_PICK, state.memories[visit.visitor].loaded)
        spent = clock.cycle - visit.began
        write_event(clock, state.events, EventKind.VISIT, who, depot.place, depot.pair, spent)
        if finding != 0:
            kind = EventKind.PHANTOM if finding == PHANTOM else EventKind.LOST
            write_event(clock, state.events, kind, who, depot.place, depot.pair, 0)


@compiled
def note_robot(state, i):
    """Log the deed of this cycle, back-offs, death and, at the start, the first decision."""
    clock = state.clock[0]
    memory = state.memories[i]
    robot = state.robots[i]
    who = robot.identity
    events = state.events
    cycle_time = state.chart[0].cycle_time
    if robot.alive == 0:
        if robot.dies_at == clock.cycle:
            write_event(clock, events, EventKind.DIED, who, 0, 0, 0)
        return
    seen = state.seen[i]
    role = role_of(memory.state)
    if role != seen.role:
        write_event(clock, events, EventKind.ROLE, who, 0, role, seen.role)
        seen.role = role
    if memory.escapes > seen.escapes:
        seen.escapes = memory.escapes
        write_event(clock, events, EventKind.ESCAPED, who, 0, memory.escapes, 0)
    if memory.deed == Deed.NONE:
        return
    if memory.deed == Deed.BEGAN:
        write_event(clock, events, EventKind.BEGAN, who, memory.label, 0, 0)
    elif memory.deed == Deed.HARVESTED or memory.deed == Deed.STORED:
        kind = EventKind.HARVESTED if memory.deed == Deed.HARVESTED else EventKind.STORED
        measured = int(memory.measured / cycle_time + 0.5)
        write_event(clock, events, kind, who, memory.label, measured, memory.updated)
    elif memory.deed == Deed.GAVE_UP:
        waited = int(memory.measured / cycle_time + 0.5)
        write_event(clock, events, EventKind.GAVE_UP, who, 0, waited, memory.draws_made)
    else:
        note_hand_over(state, i)
    if state.swarm[0].log_decisions == 1:
        millionths = int(1e6 * memory.probability + 0.5)
        write_event(clock, events, EventKind.PROBABILITY, who, memory.updated, millionths, memory.deed)
        harvest, store = int(memory.harvest / cycle_time + 0.5), int(memory.store / cycle_time + 0.5)
        whole = int(memory.whole / cycle_time + 0.5)
        write_event(clock, events, EventKind.ESTIMATES, who, harvest, store, whole)


@compiled
def note_hand_over(state, i):
    """Log that a robot believes to have dropped or picked up, and whether the cache agrees."""
    memory = state.memories[i]
    dropped = memory.deed == Deed.DROPPED
    wanted = Place.CACHE_DROP if dropped else Place.CACHE_PICK
    pair = -1
    for b in range(len(state.depots)):
        depot = state.depots[b]
        if depot.place == wanted and depot.occupied == 1 and depot.visitor == i and depot.noticed == 1:
            pair = depot.pair
    who = state.robots[i].identity
    clock = state.clock[0]
    waited = clock.cycle - memory.wait_began if memory.wait_began >= 0 else 0
    if memory.set_out == Area.MIDDLE and memory.timer == clock.cycle:
        measured = int(memory.measured / state.chart[0].cycle_time + 0.5)
        decided = EventKind.PASSED_ON if dropped else EventKind.TAKEN_ON
        write_event(clock, state.events, decided, who, memory.label, measured, memory.updated)
    if pair < 0:
        write_event(clock, state.events, EventKind.UNFOUNDED, who, memory.deed, 0, 0)
    kind = EventKind.DROPPED if dropped else EventKind.PICKED
    write_event(clock, state.events, kind, who, pair, waited, 0)


HOUR = 3600.0  # s, window of Fig. 10


def of_two_caches(events: np.ndarray, pairs: int, stored: int) -> dict[str, float]:
    """Return for each of two caches how often it is chosen beside it, and objects given out for every one stored.

    Beside the first cache robots decide after a harvest and, in the middle, without an object; beside the second after
    a store and, in the middle, with one.
    """
    kinds, row = events["kind"], {}
    beside = {"first": (EventKind.HARVESTED, EventKind.PASSED_ON), "second": (EventKind.STORED, EventKind.TAKEN_ON)}
    for name, deciding in beside.items():
        decided = events[np.isin(kinds, deciding)]["subject"]
        row[f"chosen_{name}"] = int((decided == Label.CACHE).sum()) / max(1, len(decided))
    picked = events[kinds == EventKind.PICKED]["subject"]
    row["over_first"] = int(((picked >= 0) & (picked < pairs)).sum()) / stored
    row["over_second"] = int((picked >= pairs).sum()) / stored
    return row


def outcome(state: Any, events: np.ndarray) -> dict[str, int | float | str | None]:
    """Return the row of a finished trial; times in seconds.

    Actions are decisions carried to their end (TP-84): the cache was used (stamped at the drop or pick-up), given up
    (stamped then), or the corridor was chosen (stamped at the choice). Lists are numbers with blanks between.
    """
    cycle_time = float(state.world.settings[0].cycle_time)
    duration = float(state.clock[0].cycle) * cycle_time
    count = len(state.robots)
    kinds = events["kind"]

    def number_of(kind: EventKind) -> int:
        return int((kinds == kind).sum())

    stored = number_of(EventKind.STORED)
    used = events[np.isin(kinds, (EventKind.DROPPED, EventKind.PICKED))]
    gave_up = events[kinds == EventKind.GAVE_UP]
    deciding = (EventKind.HARVESTED, EventKind.STORED, EventKind.BEGAN, EventKind.PASSED_ON, EventKind.TAKEN_ON)
    decided = events[np.isin(kinds, deciding)]
    corridor = decided[decided["subject"] == Label.CORRIDOR]
    actions = max(1, len(used) + len(gave_up) + len(corridor))
    row: dict[str, int | float | str | None] = {
        "objects_per_robot": stored / count,
        "stored": stored,
        "harvested": number_of(EventKind.HARVESTED),
        "decisions": len(decided),
        "share_used": len(used) / actions,
        "share_gave_up": len(gave_up) / actions,
        "share_corridor": len(corridor) / actions,
        "actions": len(used) + len(gave_up) + len(corridor),
    }
    for name, found in (("used", used), ("gave_up", gave_up), ("corridor", corridor)):
        windows = np.floor(found["cycle"] * cycle_time / HOUR).astype(int)
        row[f"{name}_by_hour"] = " ".join(map(str, np.bincount(windows, minlength=int(-(-duration // HOUR)))))
    row |= measured_times(events, cycle_time)
    if state.chart[0].subtasks == 3:
        row |= of_two_caches(events, len(state.pairs) // 2, max(1, stored))
        passed = events[(kinds == EventKind.PASSED_ON) & (events["detail"] == Estimate.MIDDLE)]["value"] * cycle_time
        row |= {"middle_measured": len(passed), "middle_mean_s": float(passed.mean()) if len(passed) else None}
    waits = np.concatenate([used["value"][used["value"] > 0], gave_up["value"]]) * cycle_time
    row |= {
        "waits": len(waits),
        "wait_mean_s": float(waits.mean()) if len(waits) else None,
        "wait_most_s": float(waits.max()) if len(waits) else None,
        "draws": int(gave_up["detail"].sum()),
        "phantoms": number_of(EventKind.PHANTOM),
        "lost": number_of(EventKind.LOST),
        "unfounded": number_of(EventKind.UNFOUNDED),
        "escapes": number_of(EventKind.ESCAPED),
        "least_share": least_share(events, state, count),
        "died": number_of(EventKind.DIED),
        "duration_s": round(duration, 6),
    }
    row["consistent"] = int(row["phantoms"] == 0 and row["lost"] == 0 and row["unfounded"] == 0)
    row["cause"] = cause(row)
    return row


def measured_times(events: np.ndarray, cycle_time: float) -> dict[str, int | float | None]:
    """Return how often each of the three times was measured, and its mean, spread and quartiles (Fig. 9)."""
    closing = events[np.isin(events["kind"], (EventKind.HARVESTED, EventKind.STORED))]
    row: dict[str, int | float | None] = {}
    for estimate, name in ((Estimate.WHOLE, "whole"), (Estimate.HARVEST, "harvest"), (Estimate.STORE, "store")):
        times = closing["value"][closing["detail"] == estimate] * cycle_time
        row[f"{name}_measured"] = len(times)
        row[f"{name}_mean_s"] = float(times.mean()) if len(times) else None
        row[f"{name}_sd_s"] = float(times.std(ddof=1)) if len(times) > 1 else None
        for share in (5, 25, 50, 75, 95):
            row[f"{name}_p{share}_s"] = float(np.percentile(times, share)) if len(times) else None
    return row


def least_share(events: np.ndarray, state: Any, count: int) -> float | None:
    """Return what the least busy robot has harvested, passed on and stored, as a share of the median (trap T27)."""
    closing = events[np.isin(events["kind"], (EventKind.HARVESTED, EventKind.STORED, EventKind.PASSED_ON))]
    numbers = [int((closing["robot"] == identity).sum()) for identity in state.robots.identity]
    median = float(np.median(numbers))
    return min(numbers) / median if median > 0 else None


def cause(row: dict[str, Any]) -> str | None:
    """Name what makes a run one that the paper leaves out (TP-46), None if nothing does."""
    if row["phantoms"] and row["lost"]:
        return "phantom and lost objects"
    if row["phantoms"]:
        return "phantom object"
    if row["lost"]:
        return "lost object"
    return "belief without the cache" if row["unfounded"] else None

"""The sequencing experiments as systems that can be run: Mark I3, I4, II3 and II4."""

import csv
from collections.abc import Callable
from importlib import resources
from typing import Any

import numpy as np

from formicarium.systems.registry import System, Targets
from formicarium.systems.sequencing.arena import make_arena
from formicarium.systems.sequencing.loop import apart, run
from formicarium.systems.sequencing.measures import EventKind, outcome
from formicarium.systems.sequencing.memory import Role
from formicarium.systems.sequencing.onboard import ONBOARD
from formicarium.systems.sequencing.parameters import (
    SequencingParameters,
    mark_i3_parameters,
    mark_i4_parameters,
    mark_ii3_parameters,
    mark_ii4_parameters,
)
from formicarium.systems.sequencing.setup import SequencingState, begin
from formicarium.systems.sequencing.watching import inspect, intervene, roll, shoot, tell
from formicarium.trial.record import Frames, Polygon, Scene, Span, Timeline, Trial
from formicarium.trial.simulate import Album, simulate
from formicarium.trial.watching import Watching

ROLES = ("runner", "guardian", "link", "tail", "dead")  # as frames number them
FRAME_ROLE = {Role.RUNNER: 0, Role.GUARDIAN: 1, Role.LINK: 2, Role.TAIL: 3}
DEAD = 4
TASKS = ("", "red", "green", "blue", "orange")


def frame_roles(state: SequencingState) -> np.ndarray:
    """Return every robot's role as frames number them."""
    roles = np.array([FRAME_ROLE[Role(int(role))] for role in state.memories.role])
    return np.where(state.robots.alive == 1, roles, DEAD)


def scene_of(parameters: SequencingParameters, state: SequencingState) -> Scene:
    """Return what stands still: the walls and the booths in their colours."""
    arena = make_arena(parameters.arena, parameters.booth.friction)
    polygons = [Polygon(arena.corners, "wall")]
    for k, booth in enumerate(state.booths):
        own = arena.segments[arena.segments.group == k + 1]
        polygons.append(Polygon(np.stack([own.ax, own.ay], axis=1), TASKS[int(booth.colour)]))
    epuck = parameters.epuck
    ranges = (("camera", epuck.camera_range), ("radio", epuck.radio_range))
    return Scene(tuple(polygons), epuck.radius, ROLES, parameters.physics.cycle_time, ranges)


def outcome_row(parameters: SequencingParameters, state: SequencingState, events: np.ndarray) -> dict[str, Any]:
    """Return the row of a finished trial."""
    row: dict[str, Any] = {"robots": parameters.swarm.robots, "side_m": parameters.arena.side}
    row |= {"order": "".join(TASKS[int(c)][0].upper() for c in state.coordinator[0].order[: parameters.arena.tasks])}
    return row | outcome(state, events)


def run_trial(
    parameters: SequencingParameters,
    seed: int,
    *,
    frames_every: float | None = None,
    watch: Callable[[float, float], None] | None = None,
) -> Trial:
    """Run one trial.

    Args:
        parameters: all its numbers.
        seed: decides everything that is random.
        frames_every: seconds between two frames, None for no frames.
        watch: called now and then with (seconds simulated, seconds at most).
    """
    state = begin(parameters, seed)
    every = 1 if frames_every is None else max(1, round(frames_every / parameters.physics.cycle_time))
    album = Album(state, frame_roles, lambda state: state.memories["count"])
    take = None if frames_every is None else lambda state: album.take(state, state.booths.occupied == 0)
    events = simulate(run, state, apart=apart(state), every=every, take=take, watch=watch)
    taken: Frames | None = album.frames() if frames_every is not None else None
    return Trial(outcome_row(parameters, state, events), events, taken, scene_of(parameters, state))


def timeline(trial: Trial) -> Timeline:
    """Return who was what when, chain events and failures as marks, and the times of correct sequences."""
    events, cycle_time = trial.events, trial.scene.cycle_time
    end = float(trial.outcome["duration_s"] or 0.0)
    changes = events[np.isin(events["kind"], (EventKind.ROLE, EventKind.DIED))]
    identities = sorted({int(robot) for robot in trial.events["robot"]} - {0})
    if trial.frames is not None:
        identities = sorted(int(robot) for robot in trial.frames.identity)
    spans = []
    for lane, identity in enumerate(identities):
        role, start = 0, 0.0
        for event in changes[changes["robot"] == identity]:
            time = float(event["cycle"] + 1) * cycle_time
            spans.append(Span(lane, start, time, role))
            start = time
            role = DEAD if event["kind"] == EventKind.DIED else FRAME_ROLE[Role(int(event["value"]))]
        spans.append(Span(lane, start, end, role))
    marks = []
    for event in events:
        time = float(event["cycle"] + 1) * cycle_time
        if event["kind"] == EventKind.BRANCH:
            loop = "upi_correct" in trial.outcome  # Mark II names a branch by the guardian that it starts from
            marks.append((time, f"branch from {TASKS[event['subject']]}" if loop else f"branch {event['subject']}"))
        elif event["kind"] == EventKind.CHAIN:
            marks.append((time, "chain complete"))
        elif event["kind"] == EventKind.ELECTION:
            marks.append((time, "election"))
        elif event["kind"] == EventKind.LABEL:
            marks.append((time, "labels"))
        elif event["kind"] == EventKind.STEP:
            marks.append((time, "steps"))
        elif event["kind"] == EventKind.SOLVED:
            marks.append((time, "solved"))
    counts = (events[events["kind"] == EventKind.SEQUENCE]["cycle"] + 1) * cycle_time
    lanes = tuple(str(identity) for identity in identities)
    return Timeline(lanes, tuple(spans), tuple(marks), tuple(float(t) for t in counts), end)


def published_run_times() -> dict[str, tuple[float, ...]]:
    """Return Table S3: times of the ten robot runs, infinity where the time cap came first."""
    text = resources.files("formicarium.systems.sequencing.published").joinpath("table_s3.csv").read_text()
    rows = list(csv.DictReader(line for line in text.splitlines() if not line.startswith("#")))
    names = {"time_chain_s": "chain_s", "time_1_s": "seq1_s", "time_5_s": "seq5_s", "time_10_s": "seq10_s"}
    return {ours: tuple(float(row[theirs] or "inf") for row in rows) for ours, theirs in names.items()}


COLUMNS = {"time_1_s": "1 sequence", "time_5_s": "5 sequences", "time_10_s": "10 sequences"}


def system(name: str, summary: str, configure: Callable[..., SequencingParameters], targets: Targets) -> System:
    """Return a variant as a system: all four differ by their parameters alone."""
    return System(
        name=name,
        summary=summary,
        parameters=SequencingParameters,
        configure=configure,
        run=run_trial,
        kinds=tuple(kind.name.lower() for kind in EventKind),
        targets=targets,
        timeline=timeline,
        begin=begin,
        advance=run,
        roles=frame_roles,
        onboard=ONBOARD,
        watching=Watching(scene_of, shoot, roll, inspect, tell, intervene, outcome_row),
    )


NO_PUBLISHED_RUNS = Targets(columns=COLUMNS, published={}, published_label="", published_cap=0.0)

MARK_I3 = system(
    "mark-i3",
    "TS-Swarm Mark I3: a chain of e-pucks finds out in which order three tasks must be done",
    mark_i3_parameters,
    Targets(
        columns=COLUMNS,
        published=published_run_times(),
        published_label="10 runs of 20 e-pucks, setting 0 (Garattoni & Birattari 2018, Table S3)",
        published_cap=2400.0,
    ),
)
MARK_I4 = system(
    "mark-i4",
    "TS-Swarm Mark I4: the same with four tasks",
    mark_i4_parameters,
    NO_PUBLISHED_RUNS,
)
MARK_II3 = system(
    "mark-ii3",
    "TS-Swarm Mark II3: only a whole sequence gets a verdict; a closed chain elects a leader and searches all orders",
    mark_ii3_parameters,
    NO_PUBLISHED_RUNS,
)
MARK_II4 = system(
    "mark-ii4",
    "TS-Swarm Mark II4: the same with four tasks",
    mark_ii4_parameters,
    NO_PUBLISHED_RUNS,
)

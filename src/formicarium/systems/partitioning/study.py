"""The partitioning experiment as a system that can be run."""

from collections.abc import Callable
from typing import Any

import numpy as np

from formicarium.physics.floor import corners
from formicarium.systems.partitioning.arena import make_arena
from formicarium.systems.partitioning.loop import run
from formicarium.systems.partitioning.measures import EventKind, outcome, role_of
from formicarium.systems.partitioning.onboard import ONBOARD
from formicarium.systems.partitioning.parameters import PartitioningParameters, partitioning_parameters
from formicarium.systems.partitioning.setup import PartitioningState, begin
from formicarium.systems.partitioning.watching import DEAD, holds, inspect, intervene, roll, shoot, shown, tell
from formicarium.systems.registry import System, Targets
from formicarium.trial.record import FLOOR, OBJECT, Frames, Polygon, Scene, Span, Timeline, Trial
from formicarium.trial.simulate import Album, simulate
from formicarium.trial.watching import Watching

ROLES = ("harvest", "cache", "corridor", "store", "dead")  # as frames number them
HALF_OBJECT = 0.016  # m, as it is drawn in the cache
SQUARE = np.array([(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)])
SHOWN = ("green", "blue", "blue", "green")  # what the booths of each Place show when there is something to do


def frame_roles(state: PartitioningState) -> np.ndarray:
    """Return every robot's role as frames number them."""
    roles = np.array([role_of(int(number)) for number in state.memories.state])
    return np.where(state.robots.alive == 1, roles, DEAD)


def lit(state: PartitioningState) -> np.ndarray:
    """Return what the booths show and where the cache holds an object, as a frame has it."""
    booths = [shown(colour) for colour in state.lights.colour]
    return np.array([*booths, *(holds(state, k) for k in range(len(state.pairs)))])


def scene_of(parameters: PartitioningParameters, state: PartitioningState) -> Scene:
    """Return what stands still: floor, walls, block, the cache's column, the booths, places of objects in the cache."""
    arena = make_arena(parameters.arena)
    polygons = [Polygon(arena.corners, "wall")]
    polygons += [Polygon(corners(patch), f"{FLOOR}{patch.shade:.2f}") for patch in arena.floor]
    polygons += [Polygon(points, "wall") for points in arena.solids]
    for k, place in enumerate(arena.places):
        own = arena.segments[arena.segments.group == k + 1]
        polygons.append(Polygon(np.stack([own.ax, own.ay], axis=1), SHOWN[place]))
    for k in range(len(state.pairs)):
        sides = np.array([booth[:2] for booth, pair in zip(arena.booths, arena.pairs) if pair == k])
        polygons.append(Polygon(sides.mean(axis=0) + HALF_OBJECT * SQUARE, OBJECT))
    ranges = (("camera", parameters.sight.range),)
    return Scene(tuple(polygons), parameters.epuck.radius, ROLES, parameters.swarm.cycle_time, ranges, OBJECT)


def outcome_row(parameters: PartitioningParameters, state: PartitioningState, events: np.ndarray) -> dict[str, Any]:
    """Return the row of a finished trial."""
    row: dict[str, Any] = {
        "robots": parameters.swarm.robots,
        "method": parameters.strategy.method,
        "interfacing_time_s": parameters.cache.interfacing_time,
    }
    return row | outcome(state, events)


def run_trial(
    parameters: PartitioningParameters,
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
    every = 1 if frames_every is None else max(1, round(frames_every / parameters.swarm.cycle_time))
    album = Album(state, frame_roles, lambda state: state.memories.loaded)
    take = None if frames_every is None else lambda state: album.take(state, lit(state))
    events = simulate(run, state, every=every, take=take, watch=watch)
    frames: Frames | None = album.frames() if frames_every is not None else None
    return Trial(outcome_row(parameters, state, events), events, frames, scene_of(parameters, state))


def timeline(trial: Trial) -> Timeline:
    """Return who was where when, inconsistencies as marks, and the times of stored objects."""
    events, cycle_time = trial.events, trial.scene.cycle_time
    end = float(trial.outcome["duration_s"] or 0.0)
    changes = events[np.isin(events["kind"], (EventKind.ROLE, EventKind.DIED))]
    identities = sorted({int(robot) for robot in events["robot"]} - {0})
    spans = []
    for lane, identity in enumerate(identities):
        role, start = 0, 0.0
        for event in changes[changes["robot"] == identity]:
            time = float(event["cycle"] + 1) * cycle_time
            spans.append(Span(lane, start, time, role))
            start = time
            role = DEAD if event["kind"] == EventKind.DIED else int(event["value"])
        spans.append(Span(lane, start, end, role))
    words = {EventKind.PHANTOM: "phantom object", EventKind.LOST: "lost object", EventKind.GAVE_UP: "gave up"}
    marks = []
    for event in events[np.isin(events["kind"], list(words))]:
        marks.append((float(event["cycle"] + 1) * cycle_time, words[EventKind(int(event["kind"]))]))
    counts = (events[events["kind"] == EventKind.STORED]["cycle"] + 1) * cycle_time
    lanes = tuple(str(identity) for identity in identities)
    return Timeline(lanes, tuple(spans), tuple(marks), tuple(float(t) for t in counts), end)


PARTITIONING = System(
    name="partitioning",
    summary="Task partitioning: foraging e-pucks decide whether to hand objects over at a cache (Pini et al. 2011)",
    parameters=PartitioningParameters,
    configure=partitioning_parameters,
    run=run_trial,
    kinds=tuple(kind.name.lower() for kind in EventKind),
    targets=Targets(columns={}, published={}, published_label="", published_cap=60000.0),
    timeline=timeline,
    begin=begin,
    advance=run,
    roles=frame_roles,
    watching=Watching(scene_of, shoot, roll, inspect, tell, intervene, outcome_row),
    onboard=ONBOARD,
)

"""The coverage system as an experiment that can be run, swept and drawn."""

from collections.abc import Callable

import numpy as np

from formicarium.observers.graphs import Graph
from formicarium.systems.coverage.measures import EventKind, Role
from formicarium.systems.coverage.onboard import ONBOARD
from formicarium.systems.coverage.parameters import CoverageParameters, coverage_parameters
from formicarium.systems.coverage.replanning import advance
from formicarium.systems.coverage.setup import begin
from formicarium.systems.coverage.watching import (
    frame_roles,
    inspect,
    intervene,
    outcome_row,
    roll,
    scene_of,
    shoot,
    tell,
)
from formicarium.systems.registry import System, Targets
from formicarium.trial.film import frames_of, make_film
from formicarium.trial.record import Frames, Span, Timeline, Trial
from formicarium.trial.simulate import simulate
from formicarium.trial.watching import Watching


def run_trial(
    parameters: CoverageParameters,
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
    scene = scene_of(parameters, state)
    every = 1 if frames_every is None else max(1, round(frames_every / parameters.swarm.cycle_time))
    film = make_film(int(state.clock[0].last_cycle) // every + 2 if frames_every else 0, len(state.robots), scene)
    take = None if frames_every is None else lambda state: shoot(state, film)
    events = simulate(advance, state, every=every, take=take, watch=watch)
    frames: Frames | None = frames_of(film, np.asarray(state.robots.identity)) if frames_every is not None else None
    return Trial(outcome_row(parameters, state, events), events, frames, scene)


def timeline(trial: Trial) -> Timeline:
    """Return who was what when, phases and losses as marks, and the times at which targets were reached."""
    events, cycle_time = trial.events, trial.scene.cycle_time
    end = float(trial.outcome["duration_s"] or 0.0)
    changes = events[events["kind"] == EventKind.ROLE]
    identities = sorted({int(robot) for robot in changes["robot"]} - {0})
    spans = []
    for lane, identity in enumerate(identities):
        role, start = int(Role.WAITING), 0.0
        for event in changes[changes["robot"] == identity]:
            time = float(event["cycle"] + 1) * cycle_time
            if time > start:
                spans.append(Span(lane, start, time, role))
            start, role = time, int(event["value"])
        spans.append(Span(lane, start, end, role))
    marks = []
    epochs = set()
    for event in events:
        time = float(event["cycle"] + 1) * cycle_time
        if event["kind"] == EventKind.PHASE and int(event["value"]) not in epochs:
            epochs.add(int(event["value"]))
            marks.append((time, tell(event).rpartition(" ")[2]))
        elif event["kind"] == EventKind.PARTED and event["subject"] == Graph.RANGE:
            marks.append((time, "parted"))
    counts = (events[events["kind"] == EventKind.TARGET]["cycle"] + 1) * cycle_time
    lanes = tuple(str(identity) for identity in identities)
    return Timeline(lanes, tuple(spans), tuple(marks), tuple(float(t) for t in counts), end)


COVERAGE = System(
    name="coverage",
    summary="Coverage with connectivity: arms of robots erupt towards tasks and stay linked (Panerati et al. 2018)",
    parameters=CoverageParameters,
    configure=coverage_parameters,
    run=run_trial,
    kinds=tuple(kind.name.lower() for kind in EventKind),
    targets=Targets(
        columns={"latency_2r2_s": "2 √2 m", "latency_3r2_s": "3 √2 m", "latency_5r2_s": "5 √2 m"},
        published={},
        published_label="",
        published_cap=900.0,
    ),
    timeline=timeline,
    begin=begin,
    advance=advance,
    roles=frame_roles,
    watching=Watching(scene_of, shoot, roll, inspect, tell, intervene, outcome_row, blockable=False),
    onboard=ONBOARD,
)

"""Whole trials against what must hold in any (traps T4, T10, T11, T12, T15, T18, T21, T26)."""

import itertools

import numpy as np
import pytest

from formicarium.systems.partitioning.loop import run
from formicarium.systems.partitioning.measures import EventKind
from formicarium.systems.partitioning.memory import Estimate, Label
from formicarium.systems.partitioning.parameters import partitioning_parameters
from formicarium.systems.partitioning.setup import begin
from formicarium.systems.partitioning.study import run_trial

LENGTH = 6000.0  # s


@pytest.fixture(scope="module", params=["never", "always", "adaptive"])
def trial(request):
    parameters = partitioning_parameters(
        swarm={"time_cap": LENGTH}, strategy={"method": request.param}, cache={"interfacing_time": 25.0}
    )
    return request.param, parameters, run_trial(parameters, 110020)


def of(events, *kinds):
    return events[np.isin(events["kind"], kinds)]


def test_there_are_as_many_decisions_as_harvests_stores_and_robots_in_the_nest_area(trial):
    _, parameters, result = trial
    outcome = result.outcome
    assert outcome["decisions"] == outcome["harvested"] + outcome["stored"] + parameters.swarm.robots // 2


def test_no_object_is_stored_that_was_not_harvested(trial):
    _, parameters, result = trial
    outcome = result.outcome
    assert outcome["consistent"] == 1
    assert 0 <= outcome["harvested"] - outcome["stored"] <= parameters.swarm.robots + parameters.arena.cache_pairs


def test_every_time_is_that_between_the_events_it_is_the_time_between(trial):
    """T4: recomputed from the log, equal to the step; a crossing counts twice."""
    _, _, result = trial
    closing = of(result.events, EventKind.BEGAN, EventKind.HARVESTED, EventKind.STORED)
    checked = 0
    for robot in np.unique(closing["robot"]):
        own = closing[closing["robot"] == robot]
        for before, after in itertools.pairwise(own):
            if after["detail"] != Estimate.NONE:
                factor = 2 if after["detail"] == Estimate.WHOLE else 1
                assert after["value"] == factor * (after["cycle"] - before["cycle"])
                assert (before["subject"] == Label.CORRIDOR) == (factor == 2)
                checked += 1
    assert checked > 50


def test_the_references_do_what_they_are_called(trial):
    method, _, result = trial
    outcome = result.outcome
    shares = [outcome["share_used"], outcome["share_gave_up"], outcome["share_corridor"]]
    assert sum(shares) == pytest.approx(1.0)
    if method == "never":
        assert shares == [0.0, 0.0, 1.0]
    if method == "always":
        assert shares == [1.0, 0.0, 0.0]


def test_a_visit_to_the_cache_lasts_at_least_the_interfacing_time_on_either_side(trial):
    _, _, result = trial
    visits = of(result.events, EventKind.VISIT)
    for place in set(visits["subject"]):
        spent = visits[visits["subject"] == place]["detail"]
        assert np.median(spent) > 250 and (spent >= 250).mean() > 0.97


def test_with_the_clock_of_all_robots_added_up_nobody_is_idle(trial):
    """AC-4: throughput is robots by time, so every second is in some time."""
    method, _, result = trial
    outcome = result.outcome
    if method == "always":
        assert outcome["objects_per_robot"] * 2 == pytest.approx(LENGTH / outcome["store_mean_s"], rel=0.12)
    elif method == "never":
        assert outcome["objects_per_robot"] == pytest.approx(LENGTH / outcome["whole_mean_s"], rel=0.12)


def test_at_the_start_half_of_the_swarm_is_in_either_area_and_the_cache_is_empty():
    parameters = partitioning_parameters(robots=11)
    state = begin(parameters, 110021)
    assert (state.world.bodies.x < 0.8).sum() == 6 and (state.world.bodies.y > 1.45).all()
    assert (state.pairs.state == 0).all()


def test_first_estimates_are_independent_and_uniform():
    memories = [begin(partitioning_parameters(robots=30), seed).memories for seed in range(110030, 110060)]
    table = np.array([[getattr(m, name) for name in ("harvest", "store", "whole")] for m in memories])
    table = table.transpose(1, 0, 2).reshape(3, -1) / np.array([[1.0], [1.0], [2.0]])
    for values in table:
        places = np.sort((values - 50.0) / 50.0)
        assert np.abs(places - np.linspace(0, 1, len(places))).max() < 1.63 / np.sqrt(len(places))  # 1 % level
    assert np.abs(np.corrcoef(table) - np.eye(3)).max() < 0.1


def test_nobody_jumps_overlaps_or_passes_the_cache():
    """T12: every step of a crowd, looked at from outside."""
    state = begin(partitioning_parameters(robots=24, swarm={"time_cap": 400.0}), 110022)
    side = state.world.bodies.x > 0.8
    for _ in range(4000):
        before = state.world.bodies.copy()
        state.clock[0].event_count = 0
        run(state, 1)
        bodies = state.world.bodies
        moved = np.hypot(bodies.x - before.x, bodies.y - before.y)
        assert moved.max() < 0.0035 * 1.08
        gaps = np.hypot(*(np.subtract.outer(v, v) for v in (bodies.x, bodies.y))) + np.eye(24)
        assert gaps.min() > 0.07 - 0.0006
        now = bodies.x > 0.8
        assert (bodies.y[now != side] < 0.45).all()
        side = now
    assert side.sum() != 12

"""A trial is its parameters and its seed: nothing else, and nobody who looks, changes a byte of it."""

import numpy as np
import pytest

from contracts.states import differences
from formicarium.campaigns.errors import Futile
from formicarium.campaigns.workers import finished_runs
from formicarium.commands.work import configuration_of, function_of
from formicarium.trial.simulate import simulate

ROBOTS = 12  # enough to push, talk and take roles, few enough to be quick
LONGEST = 2400.0  # s, and most trials are not so long either


def small(system):
    parameters = system.configure(robots=ROBOTS)
    swarm = parameters.swarm.model_copy(update={"time_cap": min(parameters.swarm.time_cap, LONGEST)})
    return parameters.model_copy(update={"swarm": swarm})


def bytes_of(trial):
    return trial.events.tobytes(), dict(trial.outcome)


def test_the_same_seed_is_the_same_trial(system):
    first, second = (system.run(small(system), 5) for _ in range(2))
    assert bytes_of(first) == bytes_of(second)
    assert len(first.events) > ROBOTS / 2


def test_another_seed_is_another_trial(system):
    trials = [system.run(small(system), seed) for seed in (5, 6, 7)]
    assert len({trial.events.tobytes() for trial in trials}) == 3


def test_the_seed_decides_where_everybody_starts(system):
    starts = [system.begin(small(system), seed).world.bodies for seed in (5, 5, 6)]
    assert starts[0].tobytes() == starts[1].tobytes()
    assert not np.isin(starts[2].x, starts[0].x).any()


def test_a_watched_trial_is_the_unwatched_trial(system):
    told = []
    alone = system.run(small(system), 8)
    watched = system.run(small(system), 8, frames_every=0.7, watch=lambda *seconds: told.append(seconds))
    assert bytes_of(watched) == bytes_of(alone)
    assert alone.frames is None and len(watched.frames.cycle) > 100
    assert len(told) > 100 and told[-1][0] == pytest.approx(alone.outcome["duration_s"])


@pytest.mark.parametrize("look", [1, 37, 10_000])
def test_the_length_of_a_look_changes_nothing(system, look):
    logs, states = [], []
    for length in (100, look):
        state = system.begin(small(system), 9)
        state.clock[0].last_cycle = 4000
        logs.append(simulate(system.advance, state, look=length))
        states.append(state)
    assert logs[0].tobytes() == logs[1].tobytes()
    assert differences(states[0]._replace(events=states[1].events), states[1]) == []


@pytest.mark.parametrize("order", ["reversed", "shuffled"])
def test_where_robots_are_stored_does_not_matter(system, order):
    parameters = system.configure()
    count = len(system.begin(parameters, 4).robots)
    storage = np.arange(count)[::-1] if order == "reversed" else np.random.default_rng(1).permutation(count)
    plain, mixed = system.begin(parameters, 4), system.begin(parameters, 4, storage=storage)
    assert mixed.robots.key[storage].tolist() == plain.robots.key.tolist()
    logs = []
    for state in (plain, mixed):
        state.clock[0].last_cycle = 6000
        logs.append(simulate(system.advance, state))
    assert len(logs[0]) > count
    assert logs[1].tobytes() == logs[0].tobytes()
    for part in ("robots", "memories", "commands"):
        assert differences(getattr(plain, part), getattr(mixed, part)[storage]) == []
    assert differences(plain.world.bodies, mixed.world.bodies[storage]) == []


def everything(system, workers):
    """Return the rows and tables of a few runs, by seed."""
    parameters = small(system)
    function = function_of(system.name, parameters, {3: 50.0}, configuration_of(system, parameters).sources)
    try:
        runs = {run.seed: run for run in finished_runs(function, [1, 2, 3, 4], workers)}
    except Futile as reason:
        pytest.skip(str(reason))
    assert [runs[seed].failure for seed in (1, 2, 3, 4)] == [""] * 4
    return {seed: run.result for seed, run in runs.items()}, {run.worker for run in runs.values()}


@pytest.mark.long
def test_one_worker_and_two_give_the_same_bytes(system):
    (alone, one), (shared, two) = everything(system, 1), everything(system, 2)
    assert len(one) == 1 and len(two) == 2
    for seed, result in alone.items():
        assert shared[seed].row == result.row
        assert shared[seed].tables.keys() == result.tables.keys()
        assert all(shared[seed].tables[name].equals(table) for name, table in result.tables.items())

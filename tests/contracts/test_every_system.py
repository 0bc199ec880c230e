"""Every registered system keeps every contract that the package ships, and the contracts can fail."""

import itertools

import numpy as np
import pytest

from formicarium.campaigns.errors import Futile
from formicarium.campaigns.workers import finished_runs
from formicarium.commands.work import configuration_of, function_of
from formicarium.contracts import CONTRACTS
from formicarium.contracts.interpreted import compiled, interpreted, windows
from formicarium.contracts.repeatability import ROBOTS, small
from formicarium.contracts.states import copy_of, differences, distances, recorded, turned_world
from formicarium.contracts.turned_world import no_compass
from formicarium.systems.registry import resolve
from formicarium.views.live.session import Session


@pytest.mark.parametrize("contract", CONTRACTS, ids=lambda contract: contract.__name__)
def test_the_contract_is_kept(name, contract):
    contract(name)


def test_much_happens_in_a_trial(system):
    assert len(system.run(small(system), 5).events) > ROBOTS / 2


def test_much_is_said(system):
    """Where robots have a radio, the contract on packets is held against many."""
    if system.watching is None:
        pytest.skip(f"{system.name} is not watched")
    session = Session(system, system.configure(robots=ROBOTS), 8)
    if "packets" not in session.state.readings.dtype.names:
        assert session.packets().shape == (0, 2)
        return
    total = 0
    for _ in range(100):
        session.advance(20)
        total += len(session.packets())
    assert total > 500


def test_a_turn_of_the_robots_alone_is_noticed(name, system):
    """The comparison can fail: turn the robots but not their walls."""
    state = next(itertools.islice(recorded(name, 500), 3, 4))
    bodies = state.world.bodies.copy()
    here, there = copy_of(state), copy_of(state)
    there.world.bodies[:] = turned_world(state.world, 1.0, (0.0, 0.0)).bodies
    assert not np.array_equal(bodies.x, there.world.bodies.x)
    for world in (here, there):
        system.advance(world, 1)
    assert max(distances(here.readings, there.readings).values()) > 0.05


@pytest.mark.long
def test_a_thousand_turned_worlds(name):
    no_compass(name, 1000, 61)


def wanted(name):
    """Return the role numbers that living robots can have: all of the scene's but the last, the dead."""
    system = resolve(name)
    return set(range(len(system.run(system.configure(robots=1), 1).scene.roles) - 1))


@pytest.mark.long
def test_ten_windows_of_a_minute_with_every_role(name):
    starts = windows(name, 10, 600)
    roles = set(np.concatenate([resolve(name).roles(state) for state in starts]).tolist())
    assert roles >= wanted(name) and len(starts) == 10
    for start in starts:
        assert differences(interpreted(name, start, 600), compiled(name, start, 600)) == []


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

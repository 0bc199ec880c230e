"""A robot sees lights, not the cache; the cache sees robots, not loads (traps T1, T2, T3, T14, T31)."""

import numpy as np
import pytest

from formicarium.devices.depot import Place
from formicarium.physics.grid import find_neighbours
from formicarium.robots.records import Colour
from formicarium.systems.partitioning.loop import run
from formicarium.systems.partitioning.measures import EventKind
from formicarium.systems.partitioning.parameters import partitioning_parameters
from formicarium.systems.partitioning.setup import begin
from formicarium.systems.partitioning.study import run_trial


def logged(state, kind):
    return [e for e in state.events[: state.clock[0].event_count] if e.kind == kind]


def lone(seed=110025, **groups):
    """Return a trial of one robot, in the source area."""
    return begin(partitioning_parameters(robots=1, strategy={"method": "always"}, **groups), seed)


def put(state, i, x, y, heading):
    body = state.world.bodies[i]
    body.x, body.y, body.heading = x, y, heading
    find_neighbours(state.world)


def test_blind_robots_never_use_the_cache():
    sighted = partitioning_parameters(swarm={"time_cap": 2000.0})
    blind = partitioning_parameters(swarm={"time_cap": 2000.0}, sight={"range": 0.001})
    assert run_trial(sighted, 110023).outcome["share_used"] > 0
    outcome = run_trial(blind, 110023).outcome
    assert outcome["share_used"] == 0 and outcome["harvested"] == 0


def test_an_empty_robot_in_a_blue_booth_leaves_a_phantom_object_and_the_observer_says_so():
    state = lone()
    booth = int(np.flatnonzero(state.depots.place == Place.CACHE_DROP)[1])
    run(state, 5)
    assert state.memories[0].loaded == 0
    depot = state.depots[booth]
    put(state, 0, depot.x, depot.y, 0.0)
    for _ in range(40):
        run(state, 10)
        if logged(state, EventKind.PHANTOM):
            break
    assert len(logged(state, EventKind.PHANTOM)) == 1
    assert state.pairs[1].state == 2  # nothing is repaired
    assert state.lights[booth + 3].colour == Colour.GREEN


def test_a_loaded_robot_in_a_green_booth_loses_an_object():
    state = lone()
    run(state, 5)
    state.pairs[1].state = 2
    state.memories[0].loaded = 1
    state.memories[0].state = 7  # on its way to the nest, on the wrong side of things
    depot = state.depots[int(np.flatnonzero(state.depots.place == Place.CACHE_PICK)[1])]
    put(state, 0, depot.x, depot.y, np.pi)
    state.memories[0].compass = np.pi
    for _ in range(40):
        run(state, 10)
        if logged(state, EventKind.LOST):
            break
    assert len(logged(state, EventKind.LOST)) == 1 and state.pairs[1].state == 0


@pytest.mark.parametrize("x", [0.60, 0.50, 0.40])
def test_from_the_source_side_no_light_of_the_nest_side_is_seen(x):
    """T31: through a cache of three full pairs nobody sees its green side."""
    state = lone()
    state.pairs.state[:] = 2
    for y in np.arange(1.55, 2.05, 0.02):
        for heading in np.arange(-1.2, 1.3, 0.3):
            put(state, 0, x, y, heading)
            state.memories[0].leaving = 0
            run(state, 1)
            reading = state.readings[0]
            assert not reading.blob_count or x > 0.8
            state.pairs.state[:] = 2


def test_what_one_robot_has_in_mind_changes_nobody_elses_probability():
    """T2: for as long as they have not met."""
    plain, other = (begin(partitioning_parameters(robots=6), 110026) for _ in range(2))
    other.memories[0].whole = 5000.0
    for state in (plain, other):
        run(state, 2)
    assert (plain.memories.probability[1:] == other.memories.probability[1:]).all()
    assert (plain.memories.choices == other.memories.choices).all()


def test_the_interfacing_time_reaches_a_robot_through_its_times_only():
    """T3, T32: until the first visit to the cache ends, no memory can tell what it is."""
    states = [begin(partitioning_parameters(robots=6, cache={"interfacing_time": t}), 110027) for t in (0.0, 200.0)]
    for state in states:
        run(state, 60)
    for name in ("harvest", "store", "whole", "probability", "state"):
        assert (states[0].memories[name] == states[1].memories[name]).all()


def test_the_swarm_is_slowed_by_bodies_alone():
    """T13: a robot alone crosses faster than one of thirty, and nothing but bodies tells it of the others."""
    alone = run_trial(
        partitioning_parameters(robots=1, swarm={"time_cap": 3000.0}, strategy={"method": "never"}), 110028
    )
    crowd = run_trial(
        partitioning_parameters(robots=24, swarm={"time_cap": 3000.0}, strategy={"method": "never"}), 110028
    )
    assert 255 < alone.outcome["whole_mean_s"] < 320
    assert crowd.outcome["whole_mean_s"] > 1.2 * alone.outcome["whole_mean_s"]

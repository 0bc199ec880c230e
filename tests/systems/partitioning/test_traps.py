"""Ways in which the results could be faked (T17, T18, T27, T28, T30), each looked for from outside."""

import numpy as np
import pytest

from formicarium.contracts.states import copy_of, differences
from formicarium.devices.booth import BAY_END, BAY_HALF_WIDTH, HALF
from formicarium.devices.cache_pair import Pair
from formicarium.devices.depot import Place, serve_depots
from formicarium.robots.records import Colour
from formicarium.systems.partitioning.behaviour import decide
from formicarium.systems.partitioning.loop import run
from formicarium.systems.partitioning.measures import note
from formicarium.systems.partitioning.parameters import partitioning_parameters
from formicarium.systems.partitioning.setup import begin
from formicarium.systems.partitioning.study import run_trial
from formicarium.trial.wheeled import act, move, sense

STAY = 100  # cycles: an interfacing time of 10 s


def in_bay(depot, bodies):
    """Return how many robots have their centre in a booth's bay."""
    dx, dy = bodies.x - depot.x, bodies.y - depot.y
    depth, side = depot.cosine * dx + depot.sine * dy, -depot.sine * dx + depot.cosine * dy
    return int(((np.abs(side) < BAY_HALF_WIDTH) & (depth > -HALF) & (depth < BAY_END)).sum())


def test_a_pair_changes_when_its_robot_has_left_and_never_holds_two():
    """T17: a trace of every step; green appears only over an empty source side, and after the interfacing time."""
    parameters = partitioning_parameters(
        robots=12, strategy={"method": "always"}, cache={"interfacing_time": STAY / 10}
    )
    state = begin(parameters, 110081)
    depots = state.depots
    sides = {place: [b for b in range(len(depots)) if depots[b].place == place] for place in Place}
    begun, seen = {}, {Pair.FULL: 0, Pair.EMPTY: 0}
    before = state.pairs.state.copy()
    for cycle in range(9000):
        state.clock[0].event_count = 0
        run(state, 1)
        for k, pair in enumerate(state.pairs):
            drop, pick = sides[Place.CACHE_DROP][k], sides[Place.CACHE_PICK][k]
            assert in_bay(depots[drop], state.world.bodies) <= 1 and in_bay(depots[pick], state.world.bodies) <= 1
            green = state.lights[pick].colour == Colour.GREEN
            assert green == (pair.state == Pair.FULL and depots[pick].occupied == 0)
            if pair.state == before[k]:
                continue
            assert pair.state == (before[k] + 1) % 4  # one after the other, none left out
            if pair.state in (Pair.DROPPING, Pair.PICKING):
                begun[k] = cycle
            else:
                booth = drop if pair.state == Pair.FULL else pick
                assert depots[booth].occupied == 0 and in_bay(depots[booth], state.world.bodies) == 0
                assert cycle - begun[k] >= STAY
                seen[Pair(int(pair.state))] += 1
        before = state.pairs.state.copy()
    assert min(seen.values()) > 20


@pytest.mark.parametrize("method", ["never", "always", "adaptive"])
def test_the_loop_is_the_plain_sequence_of_its_phases(method):
    """T28: no time is skipped for robots in booths or in the corridor; every bit is that of the plain stepper."""
    state = begin(partitioning_parameters(strategy={"method": method}, cache={"interfacing_time": 50.0}), 110082)
    run(state, 2000)
    plain = copy_of(state)
    run(state, 700)
    clock = plain.clock[0]
    for _ in range(700):
        sense(plain)
        for i in range(len(plain.robots)):
            tables = (plain.behaviour[0], plain.strategy[0], plain.chart[0], plain.epuck[0])
            decide(plain.readings[i], plain.memories[i], plain.commands[i], *tables)
        act(plain)
        move(plain)
        bodies, cycle_time = plain.world.bodies, plain.world.settings[0].cycle_time
        parts = (plain.depots, plain.pairs, plain.lights, plain.grips)
        serve_depots(*parts, bodies, plain.interfacing, clock.cycle, cycle_time)
        note(plain)
        clock.cycle += 1
    assert differences(plain, state) == []


@pytest.mark.parametrize("robots", [10, 30])
def test_no_robot_stands_still_unnoticed(robots):
    """T27: with never, nobody does less than a fifth of the median; the jam counter is in the row."""
    swarm = {"time_cap": 8000.0}
    outcome = run_trial(
        partitioning_parameters(robots=robots, swarm=swarm, strategy={"method": "never"}), 110083
    ).outcome
    assert outcome["least_share"] >= 0.2
    assert 0 <= outcome["escapes"] < 40 * robots * 8000 / 3600


@pytest.mark.long
@pytest.mark.parametrize("robots", [4, 6, 8, 10, 14, 18, 22, 26, 30])
def test_no_robot_stands_still_in_a_whole_run_of_any_size(robots):
    """T27 at the paper's length."""
    for seed in (110084, 110085):
        outcome = run_trial(partitioning_parameters(robots=robots, strategy={"method": "never"}), seed).outcome
        assert outcome["least_share"] >= 0.2, (seed, outcome["least_share"])


ARENAS = {2: {"cache_pairs": 2}, 3: {}, 4: {"cache_pairs": 4, "cache_top": 0.10}}
LENGTH = 12000.0  # s


def time_per_object(pairs, method, interfacing_time):
    parameters = partitioning_parameters(
        arena=ARENAS[pairs],
        swarm={"time_cap": LENGTH},
        strategy={"method": method},
        cache={"interfacing_time": interfacing_time},
    )
    return LENGTH / run_trial(parameters, 110086).outcome["stored"]


@pytest.mark.long
def test_more_pairs_move_the_crossing_as_the_capacity_law_says():
    """T30, T18: in saturation an object takes (2 Pi + h) / c; the crossing with never moves with c."""
    crossings = []
    for pairs in (2, 3, 4):
        slope = (time_per_object(pairs, "always", 150.0) - time_per_object(pairs, "always", 75.0)) / 75.0
        assert slope == pytest.approx(2 / pairs, rel=0.15)
        never = time_per_object(pairs, "never", 0.0)
        times = np.array([0.0, 15.0, 30.0, 45.0, 60.0, 75.0])
        always = np.array([time_per_object(pairs, "always", time) for time in times])
        crossings.append(float(np.interp(never, always, times)))
        print(f"{pairs} pairs: crossing at {crossings[-1]:.0f} s, {slope:.2f} s more an object for each second")
    assert crossings[0] + 8 < crossings[1] < crossings[2] - 8

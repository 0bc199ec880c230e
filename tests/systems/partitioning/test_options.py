"""Options beyond the paper (TP-O3 to TP-O5): off they change nothing, on they do what they say."""

import numpy as np
import pytest

from formicarium.physics.grid import find_neighbours
from formicarium.physics.records import records
from formicarium.robots.forager import READING, VOICE
from formicarium.robots.simulated.speech import sense_speech
from formicarium.systems.partitioning.choices import choose, close_timer, note_stay
from formicarium.systems.partitioning.loop import run
from formicarium.systems.partitioning.memory import CHART, MEMORY, NEVER, Estimate, Label
from formicarium.systems.partitioning.parameters import partitioning_parameters
from formicarium.systems.partitioning.setup import begin
from formicarium.systems.partitioning.strategy import blended, explored, steepness_of
from formicarium.systems.partitioning.talk import listen, speak
from formicarium.trial.simulate import simulate

SHORT = {"time_cap": 1500.0}


def strategy(**fields):
    return partitioning_parameters(strategy=fields).strategy.record()[0]


def events_of(**groups):
    state = begin(partitioning_parameters(swarm=SHORT, **groups), 110091)
    return simulate(run, state)


def test_what_is_switched_off_has_no_say():
    """With weight, age and steepness at 0 the other numbers of the options change no bit."""
    plain = events_of()
    silent = {"social_range": 1.0, "social_period": 0.1, "social_age": 1.0, "steepness_time": 1.0}
    assert events_of(strategy=silent | {"exploration_share": 0.5}).tobytes() == plain.tobytes()
    for option in ({"social_weight": 0.5}, {"steepness_most": 10.0}, {"exploration_age": 100.0}):
        assert events_of(strategy=option).tobytes() != plain.tobytes()


def test_a_neighbours_time_counts_the_less_the_older_it_is():
    table = strategy(social_weight=0.5, social_age=600.0)
    assert blended(100.0, 300.0, 0.0, table) == pytest.approx(200.0)
    assert blended(100.0, 300.0, 600.0, table) == pytest.approx(150.0)
    assert 100.0 < blended(100.0, 300.0, 1e6, table) < 101.0
    assert blended(100.0, 300.0, 0.0, strategy()) == 100.0


def test_first_guesses_are_no_news_and_measurements_are():
    teller, hearer = records(MEMORY, 2)
    for memory in (teller, hearer):
        memory.harvest, memory.store, memory.whole = 60.0, 70.0, 150.0
        memory.measured_at[:] = NEVER
    teller.harvest, teller.whole = 160.0, 450.0
    teller.measured_at[Estimate.HARVEST] = 1000
    reading, chart, voices = records(READING, 1)[0], records(CHART, 1)[0], records(VOICE, 2)
    reading.identity, reading.cycle, chart.cycle_time = 3, 7000, 0.1
    table = strategy(social_weight=0.5, social_period=0.1)
    speak(reading, teller, voices[0], table, chart)
    assert voices[0].speaking == 1
    voices[1].heard[0], voices[1].heard_count = voices[0].said, 1
    listen(hearer, voices[1], table)
    assert (hearer.store, hearer.whole) == (70.0, 150.0)  # never measured, so not believed
    assert hearer.harvest == pytest.approx(60.0 + 0.25 * 100.0)  # 600 s old: half of half
    assert hearer.measured_at[Estimate.HARVEST] == NEVER  # hearsay is no measurement of one's own


def talking():
    return partitioning_parameters(
        robots=8, strategy={"social_weight": 0.5, "social_period": 0.1, "method": "always"}, swarm=SHORT
    )


def test_robots_hear_who_is_near_and_in_sight_and_not_through_the_cache():
    state = begin(talking(), 110092)
    places = [
        (0.30, 1.70),
        (0.45, 1.70),
        (0.60, 1.50),
        (1.00, 1.50),
        (1.30, 1.70),
        (0.30, 0.20),
        (0.25, 0.60),
        (1.3, 0.2),
    ]
    for body, (x, y) in zip(state.world.bodies, places, strict=True):
        body.x, body.y = x, y
    find_neighbours(state.world)
    identities = state.robots.identity
    for i in range(8):
        state.voices[i].speaking, state.voices[i].said.identity = 1, identities[i]
    heard = []
    for i in range(8):
        sense_speech(state.world, i, state.robots, state.voices, 0.5)
        words = [int(w.identity) for w in state.voices[i].heard[: state.voices[i].heard_count]]
        assert words == sorted(words)
        heard.append({int(np.flatnonzero(identities == who)[0]) for who in words})
    # 2 and 3 are 0.4 m apart, with the cache between them; the others are too far.
    assert heard == [{1, 2}, {0, 2}, {0, 1}, {4}, {3}, {6}, {5}, set()]


def test_where_talking_robots_are_stored_does_not_matter():
    storage = np.random.default_rng(1).permutation(8)
    logs = [simulate(run, begin(talking(), 110093, storage=order)) for order in (None, storage)]
    assert logs[0].tobytes() == logs[1].tobytes() and len(logs[0]) > 50


def test_the_steepness_falls_with_ones_own_stays_in_booths():
    table = strategy(steepness_most=10.0, steepness_time=50.0)
    assert steepness_of(table, -1.0) == 5.0  # nothing known yet: the paper's
    assert [steepness_of(table, stay) for stay in (0.0, 50.0, 200.0)] == pytest.approx([10.0, 5.0, 2.0])
    assert steepness_of(strategy(), 200.0) == 5.0


def test_stays_are_averaged_like_estimates():
    memory, reading, chart = records(MEMORY, 1)[0], records(READING, 1)[0], records(CHART, 1)[0]
    memory.stay, memory.since, chart.cycle_time = -1.0, 100, 0.1
    for cycle, expected in ((600, 50.0), (2100, 0.2 * 50.0 + 0.8 * 200.0)):
        reading.cycle = cycle
        note_stay(reading, memory, strategy(), chart)
        assert memory.stay == pytest.approx(expected)


def test_old_times_keep_the_choice_off_certainty():
    table = strategy(exploration_age=1000.0, exploration_share=0.2)
    assert explored(0.999, 999.0, 0.0, table) == 0.999
    assert explored(0.999, 1001.0, 0.0, table) == pytest.approx(0.8)
    assert explored(0.001, 0.0, 1001.0, table) == pytest.approx(0.2)
    assert explored(0.5, 5000.0, 5000.0, table) == 0.5
    assert explored(0.999, 1e9, 1e9, strategy()) == 0.999


def test_a_robot_that_always_takes_the_cache_tries_the_corridor_again():
    """TP-25: with t_NP far above t_1 + t_2 nobody would ever measure t_NP again."""
    counts = {}
    for age in (0.0, 1000.0):
        memory, reading, chart = records(MEMORY, 1)[0], records(READING, 1)[0], records(CHART, 1)[0]
        memory.harvest = memory.store = 60.0
        memory.whole, memory.timer, memory.loaded = 1000.0, NEVER, 0
        memory.measured_at[:] = NEVER
        memory.choices, chart.cycle_time = np.uint64(7), 0.1
        table, corridor = strategy(exploration_age=age), 0
        for trip in range(1, 400):
            reading.cycle = 600 * trip
            close_timer(reading, memory, table, chart, True)
            choose(reading, memory, table, chart)
            corridor += memory.label == Label.CORRIDOR
            memory.whole = 1000.0
        counts[age] = corridor
    # From 1,000 s after each measurement on, a fifth of the choices: about one in 16 + 5.
    assert counts[0.0] == 0 and 10 <= counts[1000.0] <= 120

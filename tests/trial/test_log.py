"""The event log: nothing is lost silently, and its order is nobody's place in memory."""

import numpy as np
import pytest

from formicarium.physics.records import records
from formicarium.systems.sequencing.loop import run
from formicarium.systems.sequencing.parameters import mark_i3_parameters
from formicarium.systems.sequencing.setup import begin
from formicarium.trial.events import write_event
from formicarium.trial.record import EVENT
from formicarium.trial.simulate import EventsLost, drain, simulate


def talkative(room):
    """Return a trial that logs every message, with room for so many events."""
    state = begin(mark_i3_parameters(swarm={"log_messages": True, "log_states": True, "time_cap": 200.0}), 5)
    return state._replace(events=records(EVENT, room))


def test_a_log_that_overflows_is_an_error_that_says_by_how_much():
    with pytest.raises(EventsLost, match=r"\d+ events did not fit into the log of 50"):
        simulate(run, talkative(50))


def test_the_room_that_a_trial_is_given_is_enough_for_a_look_of_a_hundred_cycles():
    state = begin(mark_i3_parameters(swarm={"log_messages": True, "log_states": True, "time_cap": 600.0}), 5)
    events = simulate(run, state, look=100)
    assert len(events) > 1000


def test_events_come_by_cycle_then_robot_then_kind():
    events = simulate(run, talkative(100_000))
    keys = np.array([events[name] for name in ("cycle", "robot", "kind")]).T
    assert len(events) > 100
    assert (np.lexsort(keys.T[::-1]) == np.arange(len(keys))).all()


def test_draining_empties_the_log_and_keeps_what_it_returned():
    state = talkative(10)
    for value in (3, 1, 2):
        write_event(state.clock[0], state.events, 0, 7, 0, value, 0)
    events = drain(state)
    assert events["value"].tolist() == [1, 2, 3]
    assert len(drain(state)) == 0
    write_event(state.clock[0], state.events, 0, 7, 0, 9, 0)
    assert events["value"].tolist() == [1, 2, 3]


def test_the_last_place_in_the_log_is_used_and_the_next_event_is_counted_as_lost():
    state = talkative(3)
    for value in range(5):
        write_event(state.clock[0], state.events, 0, 7, 0, value, 0)
    assert state.clock[0].events_lost == 2 and state.clock[0].event_count == 3
    with pytest.raises(EventsLost, match="2 events did not fit into the log of 3"):
        drain(state)


def test_a_trial_ends_at_its_last_cycle_and_not_before():
    state = begin(mark_i3_parameters(robots=3, swarm={"time_cap": 12.3}), 1)
    told = []
    simulate(run, state, look=50, watch=lambda now, end: told.append((now, end)))
    assert state.clock[0].cycle == 123
    assert np.array(told) == pytest.approx(np.array([(5.0, 12.3), (10.0, 12.3), (12.3, 12.3)]))

"""Robots can die (TS-149, U31): at the rate asked for, and what is left is a dark, silent, solid body."""

import math

import numpy as np
import pytest
from pydantic import ValidationError

from formicarium.robots.records import SILENCE, Colour
from formicarium.systems.sequencing.loop import run
from formicarium.systems.sequencing.measures import EventKind
from formicarium.systems.sequencing.parameters import mark_i3_parameters
from formicarium.systems.sequencing.setup import begin
from formicarium.trial.phases import move
from formicarium.trial.simulate import drain, simulate
from trial.test_setup import crew

RATE = 1.0 / 43_600.0  # of the paper's robot runs


def test_robots_die_at_the_rate_asked_for():
    lives = np.concatenate([crew(250, seed, rate=RATE).robots.dies_at for seed in range(20)]) * 0.1
    assert lives.mean() == pytest.approx(1.0 / RATE, rel=4 / math.sqrt(5000))
    assert np.mean(lives < 0.5 / RATE) == pytest.approx(1.0 - math.exp(-0.5), abs=0.03)
    assert (crew(20).robots.dies_at == -1).all()


def test_every_death_is_logged_once_when_it_happens():
    state = begin(mark_i3_parameters(swarm={"failure_rate": 1.0 / 300.0, "time_cap": 400.0}), 4)
    due = {int(robot.identity): int(robot.dies_at) for robot in state.robots if robot.dies_at < 4000}
    events = simulate(run, state)
    deaths = events[events["kind"] == EventKind.DIED]
    assert {int(event["robot"]): int(event["cycle"]) for event in deaths} == due
    assert len(deaths) == len(due) > 5
    assert (state.robots.alive == 0).sum() == len(due)


def test_robots_on_the_list_die_when_it_says_and_nobody_else():
    parameters = mark_i3_parameters(swarm={"deaths": [[2, 12.3], [20, 0.0]], "time_cap": 30.0})
    storage = np.random.default_rng(1).permutation(20)
    for state in (begin(parameters, 4), begin(parameters, 4, storage=storage)):
        events = simulate(run, state)
        deaths = events[events["kind"] == EventKind.DIED]
        named = {int(robot.key): int(robot.identity) for robot in state.robots}
        assert deaths["cycle"].tolist() == [0, 123]
        assert deaths["robot"].tolist() == [named[19], named[1]]
        assert (state.robots.alive == 0).sum() == 2


@pytest.mark.parametrize("wrong", [[0, 1.0], [21, 1.0], [1, -0.1]])
def test_a_list_of_deaths_that_cannot_be_is_refused(wrong):
    with pytest.raises(ValidationError, match="deaths"):
        mark_i3_parameters(swarm={"deaths": [wrong]})


def killed(cycle=300, seed=4):
    """Return a state some seconds after the death of robot 0, and where it was when it died."""
    state = begin(mark_i3_parameters(), seed)
    state.robots[0].dies_at = cycle
    run(state, cycle)
    assert state.robots[0].alive == 1
    run(state, 5)
    return state


def test_the_dead_are_silent_dark_and_still():
    state = killed()
    reading, memory = state.readings[0].tobytes(), state.memories[0].tobytes()
    steps = (state.robots[0].left_path, state.robots[0].right_path)
    run(state, 200)
    command = state.commands[0]
    assert (command.colour, command.infrared, command.left, command.right) == (Colour.OFF, SILENCE, 0.0, 0.0)
    assert not command.enabled.any() and state.robots[0].speaking == 0
    assert (state.world.bodies[0].forward, state.world.bodies[0].turning) == (0.0, 0.0)
    assert (state.robots[0].left_path, state.robots[0].right_path) == steps
    assert (state.readings[0].tobytes(), state.memories[0].tobytes()) == (reading, memory)


def test_the_dead_are_still_bodies():
    state = killed()
    bodies = state.world.bodies
    bodies.x, bodies.y = 5.0 + 0.5 * np.arange(len(bodies)), 0.0
    bodies.forward = bodies.turning = bodies.speed_x = bodies.speed_y = bodies.turn_rate = 0.0
    bodies[0].x, bodies[0].y, bodies[1].x, bodies[1].y, bodies[1].heading = 0.0, 0.0, -0.1, 0.0, 0.0
    bodies[1].forward = 0.1
    for _ in range(10):
        move(state)
    assert 0.01 < bodies[0].x < 0.06  # pushed, at about half the pusher's speed
    assert bodies[0].x - bodies[1].x == pytest.approx(0.07, abs=0.001)
    run(state, 1)  # and whoever stands before it feels it
    assert state.readings[1].proximity.max() > 0.8


def speaker():
    """Return a state in which a robot is lit and speaks through all its emitters, and its place in memory."""
    state = begin(mark_i3_parameters(), 4)
    for _ in range(600):
        run(state, 10)
        drain(state)
        loud = (state.commands.colour != Colour.OFF) & state.commands.enabled.all(axis=1)
        if loud.any():
            return state, int(np.argmax(loud))
    raise AssertionError("nobody ever spoke")


def test_a_robot_that_dies_falls_dark_and_silent_in_the_midst_of_its_word():
    state, i = speaker()
    assert state.robots[i].speaking == 1
    state.robots[i].dies_at = state.clock[0].cycle
    run(state, 1)
    assert state.robots[i].alive == 0 and state.robots[i].speaking == 0
    assert state.commands[i].colour == Colour.OFF and not state.commands[i].enabled.any()

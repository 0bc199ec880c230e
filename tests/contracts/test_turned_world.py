"""There is no compass in a robot: in a turned and shifted world it reads and commands the same."""

import itertools
import math

import numpy as np
import pytest

from contracts.states import copy_of, distances, recorded, turned, turned_world
from formicarium.systems.registry import resolve

EXACT = 1e-9


def worst(system, state, turn, shift):
    """Let one cycle pass here and in the turned world; return the greatest difference in each field."""
    here, there = copy_of(state), turned(state, turn, shift)
    for world in (here, there):
        system.advance(world, 1)
    return distances(here.readings, there.readings) | {
        f"command{path}": gap for path, gap in distances(here.commands, there.commands).items()
    }


def compare(name, count, every):
    system, draws = resolve(name), np.random.default_rng(2)
    for state in itertools.islice(recorded(name, every), 1, count + 1):
        turn, shift = draws.uniform(-math.pi, math.pi), tuple(draws.uniform(-3.0, 3.0, 2))
        gaps = worst(system, state, turn, shift)
        assert {path: gap for path, gap in gaps.items() if gap > EXACT} == {}, (state.clock[0].cycle, turn, shift)


def test_robots_read_and_command_the_same_in_a_turned_and_shifted_world(name):
    compare(name, 60, 173)


@pytest.mark.long
def test_a_thousand_times(name):
    compare(name, 1000, 61)


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

"""Roles are taken at run time: nobody is chosen beforehand (TS-4, T19)."""

import numpy as np
import pytest
from scipy.stats import chisquare

from formicarium.systems.sequencing.loop import run
from formicarium.systems.sequencing.memory import Role, State
from formicarium.systems.sequencing.parameters import mark_i3_parameters
from formicarium.systems.sequencing.setup import begin

ROBOTS = 20


def counts_by_place(seeds, cycles: int) -> np.ndarray:
    """Return how often the robot at each place of the memory had each role after so many cycles, (roles, N)."""
    counts = np.zeros((4, ROBOTS), int)
    for seed in seeds:
        state = begin(mark_i3_parameters(robots=ROBOTS), seed)
        run(state, cycles)
        counts[state.memories.role, np.arange(ROBOTS)] += 1
    return counts


def check_fair(counts: np.ndarray) -> None:
    members = counts[Role.TAIL] + counts[Role.LINK]
    for taken in (counts[Role.GUARDIAN], members):
        assert taken.sum() > 5 * ROBOTS
        assert chisquare(taken).pvalue > 0.001


def test_everybody_starts_as_a_runner_that_walks():
    """TS-44."""
    state = begin(mark_i3_parameters(), 1)
    assert (state.memories.role == Role.RUNNER).all() and (state.memories.state == State.WALK).all()
    assert (state.memories["count"] == 0).all()


def test_all_memories_begin_alike_but_for_the_random_stream():
    """TS-4: the same program, and no secret in anybody's memory."""
    memories = begin(mark_i3_parameters(), 1).memories
    for name in memories.dtype.names:
        if name == "draws":
            assert len(np.unique(memories.draws)) == len(memories)
        else:
            assert all(memory[name].tobytes() == memories[0][name].tobytes() for memory in memories), name


def test_roles_do_not_depend_on_the_place_in_memory():
    check_fair(counts_by_place(range(300, 350), 1200))


@pytest.mark.long
def test_roles_do_not_depend_on_the_place_in_memory_in_200_trials():
    check_fair(counts_by_place(range(1000, 1200), 2000))


def test_the_three_guardians_guard_three_tasks():
    """TS-46."""
    for seed in range(5):
        state = begin(mark_i3_parameters(), seed)
        run(state, 1500)
        colours = state.memories.colour[state.memories.role == Role.GUARDIAN]
        assert len(set(colours.tolist())) == len(colours)

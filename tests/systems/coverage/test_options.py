"""What missions switch on beyond the paper, each against the paper's way in the same place."""

import numpy as np
import pytest

from formicarium.systems.coverage.memory import Mode
from systems.coverage.swarm import advance, line, stay, swarm


@pytest.mark.parametrize(("rendezvous", "compact"), [("potential", False), ("flocking", True)])
def test_a_chain_becomes_compact_by_flocking_alone(rendezvous, compact):
    """By the potential nine robots in a row stay one: each is as far from its neighbours as it wants to be."""
    state = swarm(line(9, 1.5), setting=0, behaviour={"rendezvous": rendezvous})
    stay(state, 12)
    state.memories.epoch, state.memories.mode = 4, Mode.GATHER
    state.memories.spacing = state.behaviour[0].gather_spacing
    state.memories.since = state.clock[0].cycle
    state.memories[0].crew = 99  # it goes on
    advance(state, 900)
    assert (state.memories.gradient.max() <= state.behaviour[0].compact_range) == compact


@pytest.mark.parametrize(("sweep_cycles", "found"), [(0, False), (600, True)])
def test_a_task_beside_the_master_is_found_by_an_arm_that_sweeps(sweep_cycles, found):
    """One robot stands 2.4 m from the master and its task at 0.7 m; it draws in to 0.48 m."""
    state = swarm(
        line(2, 1.8), setting=2, tasks={"distance": 0.7, "stop": True}, behaviour={"sweep_cycles": sweep_cycles}
    )
    advance(state, 1500)
    assert (state.tasks[0].cycles > 100) == found


@pytest.mark.parametrize(("strays", "back"), [("close", False), ("return", True)])
def test_a_robot_among_those_of_another_arm_finds_back_to_the_master(strays, back):
    """Five robots away in arm 1, it has been sent to arm 2, of which it hears nobody."""
    state = swarm(line(6), setting=2, tasks={"count": 2, "distance": 12.0}, behaviour={"strays": strays})
    stay(state, 12)
    state.memories.arm[1:] = (1, 1, 1, 1, 2)
    identity = int(state.robots.identity[0])
    for _ in range(1500):
        advance(state, 1)
        if state.memories[5].reference == identity:
            break
    assert (state.memories[5].reference == identity) == back


def test_the_master_reckons_with_whom_it_counts_and_with_who_comes_back():
    state = swarm(line(5), setting=0, behaviour={"census_cycles": 50})
    assert stay(state, 60).memories[0].crew == 5
    state.robots.alive[4] = 0
    state.commands.enabled[4] = 0
    assert stay(state, 120).memories[0].crew == 4
    state.robots.alive[4] = 1
    assert stay(state, 20).memories[0].crew == 5
    never = stay(swarm(line(5), setting=0), 60)
    never.robots.alive[4] = 0
    assert stay(never, 200).memories[0].crew == 5
    assert np.isin(never.memories[0].counted, (4, 5))

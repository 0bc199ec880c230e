"""Words take time and way: four bytes, a limited rate, bodies that hide, one hop a cycle (T10).

The board alone (range, rate, occlusion, loss) is tested in tests/robots/test_radio.py, the four bytes in
test_messages.py. Here: the same in a running trial, worked out by other means, and the relay of EST.
"""

import math

import numpy as np
import pytest

from formicarium.physics.grid import find_neighbours
from formicarium.robots.records import Colour
from formicarium.systems.sequencing.loop import run
from formicarium.systems.sequencing.memory import State
from formicarium.systems.sequencing.parameters import BehaviourTable, mark_i3_parameters
from formicarium.systems.sequencing.setup import SequencingState, begin
from systems.stage import chain, guardian, put, wide_stage

SPACING = BehaviourTable().spacing
CERTAIN = {"radio_loss": 0.0}


# What is heard in a trial


def audible(bodies, commands, i: int, reach: float) -> list[bytes]:
    """Return what robot i could hear at best: of all in reach with no body on the line between the centres."""
    places = np.column_stack([bodies.x, bodies.y])
    words = []
    for j in range(len(places)):
        line = places[j] - places[i]
        away = math.hypot(*line)
        if j == i or away >= reach:
            continue
        others = np.delete(places, [i, j], axis=0) - places[i]
        along, aside = others @ line / away, np.abs(others @ [-line[1], line[0]]) / away
        if ((along > 0.0) & (along < away) & (aside < bodies[i].radius)).any():
            continue
        emitter = round(math.degrees(math.atan2(-line[1], -line[0]) - bodies[j].heading) / 30.0) % 12
        if commands[j].enabled[emitter] == 1:
            words.append(bytes(commands[j].payload[emitter]))
    return words


def test_in_a_trial_every_packet_is_what_somebody_in_line_of_sight_said_a_cycle_ago():
    """T10: as often as it was said at most, never more than the board's capacity, and that is sometimes too few."""
    state = begin(mark_i3_parameters(robots=40), 1)
    run(state, 3000)
    capacity, reach = int(state.epuck[0].radio_capacity), float(state.epuck[0].radio_range)
    heard = full = 0
    for _ in range(20):
        run(state, 20)
        state.clock[0].event_count = 0
        bodies, commands = state.world.bodies.copy(), state.commands.copy()
        run(state, 1)
        for i, reading in enumerate(state.readings):
            words = audible(bodies, commands, i, reach)
            packets = [bytes(packet.payload) for packet in reading.packets[: reading.packet_count]]
            assert len(packets) <= min(capacity, len(words))
            for word in packets:
                words.remove(word)  # fails if it was not said, or heard more often than said
            heard += len(packets)
            full += len(packets) == capacity and len(words) > 0
    assert heard > 300 and full > 0


# How EST travels


def reached(links: int, seed: int, backwards: bool, **epuck) -> SequencingState:
    """Return a straight branch in place, not established, whose reached guardian is about to say EST.

    Robot 0 is the origin, robots 1..links its links; ``backwards`` stores all of them in the opposite order.
    """
    state = wide_stage(links + 2, seed, epuck=CERTAIN | epuck)
    chain(state, links, SPACING)
    put(state, links + 1, (links + 1) * SPACING, 0.0, math.pi)
    guardian(state, links + 1, Colour.GREEN, False)
    memory = state.memories[links + 1]
    memory.in_chain, memory.established, memory.branch, memory.state = 1, 1, 2, State.STAY
    if backwards:
        for records in (state.world.bodies, state.robots, state.memories):
            records[:] = records[::-1].copy()
        find_neighbours(state.world)
    return state


def told(state, links: int, backwards: bool) -> list[int]:
    """Return after how many cycles link 1, link 2, ... knew that the branch is established."""
    known: dict[int, int] = {}
    while len(known) < links and state.clock[0].cycle < 500:
        run(state, 1)
        for k in range(1, links + 1):
            if state.memories[links + 1 - k if backwards else k].established == 1:
                known.setdefault(k, int(state.clock[0].cycle))
    return [known[k] for k in range(1, links + 1)]


@pytest.mark.parametrize("backwards", [False, True])
@pytest.mark.parametrize("seed", [1, 2])
def test_est_needs_a_cycle_for_every_hop_and_the_longer_for_the_longer_branch(seed, backwards):
    """T10, TS-70: in whatever order the robots are stored."""
    latencies = []
    for links in (1, 2, 4, 7):
        cycles = told(reached(links, seed, backwards), links, backwards)
        assert (np.diff(cycles) <= -1).all()  # each link before its predecessor
        assert cycles[-1] >= 2  # said in one cycle, heard in the next
        latencies.append(cycles[0])
    assert (np.diff(latencies) >= np.diff([1, 2, 4, 7])).all()


def test_a_lost_word_delays_the_relay():
    """T10: EST is repeated, so it arrives, but later."""
    certain = [told(reached(6, seed, False), 6, False)[0] for seed in range(8)]
    lossy = [told(reached(6, seed, False, radio_loss=0.6), 6, False)[0] for seed in range(8)]
    assert np.mean(lossy) > np.mean(certain) + 3.0


def test_est_goes_as_far_in_one_hop_as_nobody_stands_in_between():
    """T10: with the last link out of the line the one before it hears the guardian itself, as early as the last."""
    in_line, aside = reached(4, 1, False), reached(4, 1, False)
    put(aside, 4, 4 * SPACING, 0.1)
    *_, third, fourth = told(in_line, 4, False)
    assert third > fourth
    *_, third, fourth = told(aside, 4, False)
    assert third == fourth


def test_a_body_in_the_line_stops_the_relay():
    """T10: a robot that is switched off, between two links, is silence for all that are nearer to the origin."""
    state = reached(4, 1, False)
    dark = wide_stage(7, 1, epuck=CERTAIN)
    for records, others in ((dark.world.bodies, state.world.bodies), (dark.memories, state.memories)):
        records[:6] = others
    dark.robots[6].alive = 0
    put(dark, 6, 2.5 * SPACING, 0.0)
    run(dark, 60)
    assert dark.memories.established[1:5].tolist() == [0, 0, 1, 1]
    put(dark, 6, 2.5 * SPACING, 0.5)
    run(dark, 10)
    assert dark.memories.established[1:5].tolist() == [1, 1, 1, 1]

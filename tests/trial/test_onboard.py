"""Controllers in processes of their own: the same events byte for byte, and a trial that outlives any of them."""

import numpy as np
import pytest

from formicarium.contracts.interpreted import windows
from formicarium.contracts.states import copy_of
from formicarium.robots.records import SILENCE
from formicarium.systems.registry import resolve
from formicarium.trial.onboard import Controllers, described, layout_of
from formicarium.trial.simulate import drain
from trial.misdeeds import DEEDS, commands_of


def events_of(state, onboard, cycles, **options):
    with Controllers(onboard, state, patience=60.0, **options) as controllers:
        controllers.advance(cycles)
        return drain(state), controllers.lost


def expected(system, state, cycles):
    state = copy_of(state)
    system.advance(state, cycles)
    return drain(state), state


def test_a_layout_is_written_and_read_back_with_its_paddings():
    state = resolve("mark-i3").begin(resolve("mark-i3").configure(robots=2), 1)
    for part in (state.readings, state.memories, state.commands, state.behaviour):
        again = layout_of(described(np.asarray(part).dtype))
        assert again.itemsize == part.dtype.itemsize and again.names == part.dtype.names
        assert [again.fields[name][1] for name in again.names] == [
            part.dtype.fields[name][1] for name in part.dtype.names
        ]


def test_controllers_outside_give_the_same_state_and_events():
    system = resolve("mark-i3")
    state = system.begin(system.configure(robots=6), 3)
    system.advance(state, 1500)
    state.clock[0].event_count = 0
    (wanted, after), (events, lost) = expected(system, state, 60), events_of(state, system.onboard, 60)
    assert lost == [] and events.tobytes() == wanted.tobytes()
    assert state.memories.tobytes() == after.memories.tobytes() and state.commands.tobytes() == after.commands.tobytes()
    assert state.world.bodies.tobytes() == after.world.bodies.tobytes()


@pytest.mark.long
def test_twenty_processes_over_ten_windows_of_a_minute():
    system = resolve("mark-i3")
    starts, total = windows("mark-i3", 10, 600), 0
    roles = set(np.concatenate([system.roles(state) for state in starts]).tolist())
    assert roles >= {0, 1, 2, 3} and len(starts) == 10 and all(len(state.robots) == 20 for state in starts)
    for state in starts:
        wanted, _ = expected(system, state, 600)
        events, lost = events_of(state, system.onboard, 600)
        assert lost == [] and events.tobytes() == wanted.tobytes()
        total += len(events)
    assert total > 100


def test_a_controller_that_dies_hangs_or_babbles_is_named_and_the_trial_goes_on(capfd):
    system = resolve("mark-i3")
    state = system.begin(system.configure(robots=5), 3)
    identities = [int(robot) for robot in state.robots.identity]
    programs = dict(zip(identities, DEEDS.values()))

    with Controllers(system.onboard, state, patience=8.0, command=commands_of(programs)) as controllers:
        controllers.advance(12)
        lost = {loss.robot: loss for loss in controllers.lost}
    assert state.clock[0].cycle == 12 and set(lost) == set(programs)
    reasons = [lost[identity].reason for identity in identities[:4]]
    assert (
        "exit code 3" in reasons[0] and "not answered" in reasons[1] and "5 bytes" in reasons[2] and "nan" in reasons[3]
    )
    assert {loss.cycle for loss in lost.values()} == {4}
    told = capfd.readouterr().err
    assert all(f"controller of robot {identity} " in told for identity in programs)
    silent = [i for i in range(5) if int(state.robots.identity[i]) in programs]
    assert not state.commands.enabled[silent].any() and (state.commands.infrared[silent] == SILENCE).all()
    assert (state.commands.left[silent] == 0).all() and (state.robots.alive == 1).all()
    assert state.commands.left[4] != 0 or state.commands.right[4] != 0

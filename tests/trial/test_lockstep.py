"""Controllers of partitioning and coverage in processes of their own: the same state, and a trial that outlives any."""

import numpy as np
import pytest

from formicarium.commands.fields import with_values
from formicarium.commands.main import exit_code
from formicarium.contracts.interpreted import windows
from formicarium.contracts.states import copy_of, differences
from formicarium.robots.footbot import COMMAND, ENTRIES
from formicarium.systems.registry import resolve
from formicarium.trial.lockstep import Lockstep, check_lists, own
from formicarium.trial.simulate import drain
from trial.misdeeds import DEEDS, commands_of

# name -> robots, cycle at which the controllers take over, cycles
WINDOWS = {"partitioning": (4, 1200, 40), "coverage": (6, 250, 40), "mark-i3": (4, 1500, 20)}


def state_of(name, robots, cycle):
    system = resolve(name)
    state = system.begin(system.configure(robots=robots), 3)
    system.advance(state, cycle)
    state.clock[0].event_count = 0
    return system, state


def same(system, state, cycles):
    """Hold a window in processes against the loop; return how much happened in it."""
    wanted = copy_of(state)
    system.advance(wanted, cycles)
    with Lockstep(system.onboard, state, patience=60.0) as controllers:
        controllers.advance(cycles)
        assert controllers.lost == []
    events = drain(state)
    assert events.tobytes() == drain(wanted).tobytes() and differences(state, wanted) == []
    return len(events)


@pytest.mark.parametrize("name", WINDOWS)
def test_controllers_outside_give_the_same_state_and_events(name):
    robots, cycle, cycles = WINDOWS[name]
    system, state = state_of(name, robots, cycle)
    before = state.world.bodies.x.copy()
    same(system, state, cycles)
    assert (state.world.bodies.x != before).sum() >= robots // 2


@pytest.mark.long
@pytest.mark.parametrize("name", ["partitioning", "coverage"])
def test_ten_windows_of_a_minute(name):
    system = resolve(name)
    assert sum(same(system, state, 600) for state in windows(name, 10, 600)) > 100


def test_only_the_master_is_told_of_tasks():
    _, state = state_of("coverage", 5, 0)
    charts = [own(state.charts, i, 5) for i in range(5)]
    assert [bool(chart["slot_count"][0]) for chart in charts] == [bool(key == 0) for key in state.robots.key]
    assert all(len(chart) == 1 for chart in charts) and own(state.behaviour, 3, 5) is not None
    assert own(state.behaviour, 3, 5).tobytes() == np.asarray(state.behaviour).tobytes()
    with pytest.raises(ValueError, match="a table of 5 records for 4 robots: must be one for all, or one each"):
        own(state.charts, 3, 4)


@pytest.mark.parametrize("name", ["partitioning", "coverage"])
def test_a_controller_that_dies_hangs_or_babbles_is_named_and_the_trial_goes_on(name, capfd):
    system, state = state_of(name, 5, 0)
    last = int(np.flatnonzero(state.robots.key == 4)[0])
    programs = {int(state.robots.identity[i]): deed for i, deed in zip(sorted({*range(5)} - {last}), DEEDS.values())}
    with Lockstep(system.onboard, state, patience=8.0, command=commands_of(programs)) as controllers:
        controllers.advance(12)
        lost = {loss.robot: loss for loss in controllers.lost}
    assert state.clock[0].cycle == 12 and set(lost) == set(programs) and {loss.cycle for loss in lost.values()} == {4}
    told = capfd.readouterr().err
    assert all(f"controller of robot {identity} " in told for identity in programs)
    for identity, words in zip(programs, ("exit code 3", "not answered", "5 bytes", ("room", "wheel speeds nan"))):
        assert any(word in lost[identity].reason for word in ([words] if isinstance(words, str) else words))
    silent = [i for i in range(5) if i != last]
    assert not any(part.any() for part in (state.commands.left[silent], state.commands.right[silent]))
    assert (state.robots.alive == 1).all()
    if name == "coverage":
        assert not state.robots.speaking[silent].any() and state.robots.speaking[last] == 1


def test_a_message_that_compiled_code_would_read_beyond_is_garbage():
    command = np.zeros(1, COMMAND)
    command["message"]["entry_count"] = ENTRIES
    check_lists(command)
    command["message"]["entry_count"] = ENTRIES + 1
    with pytest.raises(ValueError, match=r"entry_count \[51\] where there is room for 50"):
        check_lists(command)
    command["message"]["entry_count"] = 1
    command["message"]["entries"]["receiver"][0, 0] = 256
    with pytest.raises(ValueError, match="a number that there is not"):
        check_lists(command)


def test_robots_that_talk_beside_their_readings_cannot_be_outside(capsys):
    system = resolve("partitioning")
    talking = with_values(system.configure(robots=2), {"strategy.social_weight": 0.5})
    with pytest.raises(ValueError, match=r"strategy\.social_weight: must be 0"):
        Lockstep(system.onboard, system.begin(talking, 1))
    assert exit_code(["onboard", "partitioning", "--robots", "2", "--set", "social_weight=0.5"]) == 2
    assert "strategy.social_weight: must be 0" in capsys.readouterr().err


def test_the_command_takes_any_system(capsys):
    assert exit_code(["onboard", "coverage", "--robots", "3", "--start", "20", "--cycles", "10"]) == 0
    assert "10 cycles" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("asked", "words"),
    [(["--cycles", "0"], "--cycles 0"), (["--start", "100000", "--set", "time_cap=2"], "--start 100000")],
)
def test_a_window_that_holds_nothing_is_refused(asked, words, capsys):
    assert exit_code(["onboard", "coverage", "--robots", "3", *asked]) == 2
    assert words in capsys.readouterr().err

"""T23 to T26: every trap is found in runs that fell into it."""

import numpy as np
import pytest

from formicarium.commands.published.checks import drawn
from formicarium.studies.traps import NOISES, Again, Stored, checks, members_of
from formicarium.systems.registry import resolve
from formicarium.systems.sequencing.log import EventKind
from formicarium.systems.sequencing.memory import Role
from formicarium.trial.record import EVENT
from studies.made_up import cell

PARAMETERS = resolve("mark-i3").configure().model_dump()


def logged(*events):
    found = np.zeros(len(events), EVENT)
    for event, (cycle, kind, robot, value) in zip(found, events):
        event["cycle"], event["kind"], event["robot"], event["value"] = cycle, kind, robot, value
    return found


def sequences_of(row, cycle_time=0.1):
    times = {1: row["time_1_s"], 5: row["time_5_s"], 10: row["time_10_s"]}
    done = [(round(time / cycle_time) - 1, EventKind.SEQUENCE, 1, count) for count, time in times.items() if time]
    return logged(*done, *((1, EventKind.ROLE, k, Role.LINK) for k in range(1, int(row["members"]) + 1)))


def stored(**changes):
    own = cell(0, 0, 28, members=18)
    row = own.runs[0]
    again = [Again(row, dict(row), sequences_of(row), 0.1)]
    noisier = [(row, row | {"time_10_s": 1.0})]
    usual = Stored("mark-i3", [own], [[run["seed"] for run in own.runs]], [PARAMETERS], 0, again, noisier)
    return usual._replace(**changes)


def results(found):
    return [check.passed for check in checks(found)]


def changed(**columns):
    """The base cell with its first run changed."""
    own = stored().cells[0]
    return [own._replace(runs=[own.runs[0] | columns, *own.runs[1:]])]


def test_a_sound_study_passes():
    assert results(stored()) == [True] * 7


def test_noise_off_is_found():
    assert len(NOISES) == 9
    quiet = PARAMETERS | {"epuck": PARAMETERS["epuck"] | {"camera_miss": 0.0}}
    assert results(stored(parameters=[quiet]))[0] is False
    own = stored().cells[0]
    tuned = PARAMETERS | {"behaviour": PARAMETERS["behaviour"] | {"spacing": 0.17}}  # another controller in one cell
    two = stored(cells=[own, own], seeds=stored().seeds * 2, parameters=[PARAMETERS, tuned])
    assert results(two)[0] is False
    row = own.runs[0]
    assert results(stored(noisier=[(row, row)]))[1] is False
    assert results(stored(noisier=[]))[1] is None


def test_other_seeds_missing_runs_and_stretched_caps_are_found():
    own = stored().cells[0]
    assert results(stored(seeds=[range(2, 32)]))[2] is False
    assert results(stored(seeds=[range(1, 41)]))[2] is None  # ten are still to come
    short = own._replace(runs=own.runs[:10])
    assert results(stored(cells=[short], seeds=[range(1, 11)]))[2] is None  # the paper has thirty
    assert results(stored(crashed=1))[2] is False
    assert results(stored(cells=[own._replace(cap=4800.0)]))[2] is False
    twice = own._replace(runs=[*own.runs[:-1], own.runs[0]])
    assert results(stored(cells=[twice]))[2] is False


def test_a_row_that_does_not_come_out_again_is_found():
    row = stored().cells[0].runs[0]
    other = Again(row, row | {"members": 17}, sequences_of(row), 0.1)
    late = Again(row, dict(row), sequences_of(row | {"time_10_s": 1500.0}), 0.1)
    assert results(stored(again=[other]))[3] is results(stored(again=[late]))[3] is False
    assert results(stored(again=[]))[3] is None


def test_early_ends_are_failures_at_the_cap():
    failed = {"hopeless_s": 900.0, "success": 0, "time_10_s": None, "duration_s": 2400.0}
    assert results(stored(cells=changed(**failed)))[4:6] == [True, None]
    assert results(stored(cells=changed(**failed), control=[{"success": 0}]))[5] is True
    assert results(stored(cells=changed(**failed), control=[{"success": 1}]))[5] is False
    for wrong in ({"success": 1}, {"time_10_s": 800.0}, {"duration_s": 900.0}):
        assert results(stored(cells=changed(**failed | wrong)))[4] is False


def test_members_are_counted_from_roles():
    assert results(stored(cells=changed(links=99)))[6] is False
    events = logged(
        (1, EventKind.ROLE, 1, Role.GUARDIAN),
        (2, EventKind.ROLE, 2, Role.TAIL),
        (3, EventKind.ROLE, 2, Role.LINK),
        (4, EventKind.ROLE, 3, Role.TAIL),
        (5, EventKind.DIED, 3, Role.TAIL),
        (6, EventKind.DIED, 4, Role.RUNNER),
    )
    assert members_of(events) == 2


def test_nothing_is_said_of_a_study_without_runs():
    empty = stored(cells=[cell(0, 0, 0, runs=0)])
    assert {check.finding for check in checks(empty)} == {"no runs yet"}


@pytest.mark.parametrize("seed", [0, 5])
def test_a_sample_is_drawn_by_the_seed_alone(seed):
    sample = [number for number in range(seed, seed + 2000) if drawn(number, 20)]
    assert 70 < len(sample) < 130
    assert all(drawn(number, 1) for number in range(10))

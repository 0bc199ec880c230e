"""The tuner finds a number that makes a difference, on its own seeds, and judges it on others."""

import pytest

from formicarium.commands.errors import UserError
from formicarium.commands.tuning import Search, outcomes, tuned
from formicarium.systems.registry import resolve

NAME = "random_walk:RANDOM_WALK"  # its tasks take booth.dwell_time and a random time


def search(tmp_path, **changes):
    usual = {"points": 4, "seeds": 3, "held_back": 12, "first_seed": 500, "workers": 1, "out": str(tmp_path / "out")}
    return Search(NAME, ("dwell_time=0:60",), "time_1_s", **(usual | changes))


def test_the_best_is_found_and_held_against_the_default_on_other_seeds(tmp_path, capsys):
    verdict = tuned(search(tmp_path))
    assert verdict.best["booth.dwell_time"] <= 8.0 == verdict.default["booth.dwell_time"]
    assert verdict.scores[0] <= verdict.scores[1]
    rounds = capsys.readouterr().out.splitlines()
    assert rounds[0] == "round 1: 4 points, 3 seeds from 500" and rounds[1] == "round 2: 2 points, 6 seeds from 500"
    assert rounds[-1].endswith("12 seeds from 512")  # none that the search can have seen
    assert tuned(search(tmp_path)) == verdict  # all of it is there already


def test_a_time_that_was_not_reached_counts_as_twice_the_length_of_its_run(tmp_path):
    rows = [{"seed": 1, "time_1_s": None, "duration_s": 600.0}, {"seed": 2, "time_1_s": 30.0, "duration_s": 600.0}]
    assert outcomes(search(tmp_path), resolve(NAME), rows) == [1200.0, 30.0]
    with pytest.raises(UserError, match="no number"):
        outcomes(search(tmp_path)._replace(target="cause"), resolve(NAME), [{"seed": 1, "cause": "too slow"}])


@pytest.mark.parametrize(
    ("over", "why"),
    [
        ("dwell_time=5", "NAME=LOW:HIGH"),
        ("dwell_time=9:3", "NAME=LOW:HIGH"),
        ("dwell_time=-3:3", "greater than or equal to 0"),
        ("dwell=0:3", "no parameter has that name"),
    ],
)
def test_a_range_that_makes_no_sense_is_refused(tmp_path, over, why):
    with pytest.raises(UserError, match=why):
        tuned(search(tmp_path)._replace(over=(over,)))

"""What the options bring, on made-up rows and logs whose answers are known."""

import numpy as np
import pytest

from formicarium.studies.foraging_options import (
    SWITCH,
    TIMES,
    cache_share,
    changed,
    figure_options,
    gains,
    reaction_time,
    section,
    spread,
    steeper_is_no_worse,
    table_of_changes,
    talking_is_quicker,
)
from formicarium.systems.partitioning.measures import EventKind
from formicarium.systems.partitioning.memory import Label
from formicarium.trial.record import EVENT


def log(turn, level=0.8, apart=0.1, before=0.1):
    """Return a log in which ten robots act every 100 s, and turn to the cache ``turn`` s after the change."""
    events = []
    for second in range(0, 60000, 100):
        share = level if second >= SWITCH + turn else before
        for robot in range(1, 11):
            used = robot <= round(10 * share)
            kind, subject = (EventKind.PICKED, 0) if used else (EventKind.STORED, Label.CORRIDOR)
            events.append((10 * second, kind, robot, subject, 0, 0))
            time = round(1000 * (1 + apart * (-1) ** robot))
            events.append((10 * second, EventKind.ESTIMATES, robot, time, time, time))
    return np.array(events, EVENT)


def test_the_share_of_the_cache_is_that_of_its_actions():
    share = cache_share(log(5000.0))
    assert share[0] == share[49] == pytest.approx(0.1) and share[-1] == pytest.approx(0.8)


@pytest.mark.parametrize("turn", [0.0, 3000.0, 12000.0])
def test_the_reaction_time_is_the_end_of_the_first_window_past_the_middle(turn):
    assert reaction_time(log(turn)) == turn + 600.0


def test_a_share_that_never_rises_has_no_reaction_time():
    assert reaction_time(log(0.0, level=0.1, before=0.4)) == float("inf")


def test_disagreement_is_the_spread_over_the_mean():
    expected = float(np.std([0.9, 1.1] * 5, ddof=1))
    assert spread(log(0.0)) == pytest.approx(expected, rel=1e-3)
    assert spread(log(0.0, apart=0.0)) == 0.0


def rows():
    made, draws = [], np.random.default_rng(2)
    plain = {
        "consistent": 1,
        "strategy.steepness_most": 0.0,
        "strategy.social_weight": 0.0,
        "strategy.exploration_age": 0.0,
    }
    for seed in range(4):
        for time in TIMES:
            for most in (0.0, 10.0):
                gain = 30.0 if most and time == 0.0 else 0.0
                objects = 200.0 - 0.2 * time + gain + draws.normal(0.0, 1.0)
                made.append(plain | {"cache.switch_time": -1.0, "interfacing_time_s": time, "seed": seed,
                                     "strategy.steepness_most": most, "objects_per_robot": objects,
                                     "strategy.giveup_draw_period": 0.1})  # fmt: skip
        for period in (0.1, 10.0):
            for weight, age in ((0.0, 0.0), (0.5, 0.0), (0.0, 3600.0)):
                made.append(plain | {"cache.switch_time": SWITCH, "interfacing_time_s": 200.0, "seed": seed,
                                     "strategy.giveup_draw_period": period, "strategy.social_weight": weight,
                                     "strategy.exploration_age": age, "objects_per_robot": 150.0 + seed})  # fmt: skip
    return made


def made_up_log(row):
    talks = row["strategy.social_weight"] > 0
    later = 600.0 * row["seed"]
    return log((3000.0 if talks else 9000.0) + later, apart=(0.05 if talks else 0.2) + 0.01 * row["seed"])


def test_gains_and_reactions_come_out_as_they_were_put_in():
    found = {time: (gain, p_value) for time, gain, p_value in gains(rows())}
    assert found[0.0][0].value == pytest.approx(30.0, abs=2.5) and found[0.0][1] < 0.001
    assert all(abs(found[time][0].value) < 3.0 for time in TIMES[1:])
    table = {(row["draw_period_s"], row["variant"]): row for row in table_of_changes(changed(rows(), made_up_log))}
    assert len(table) == 6 and table[10.0, "talking"]["reaction_median_s"] == 4500.0
    assert table[10.0, "as in the paper"]["reaction_median_s"] == 10500.0
    assert table[0.1, "talking"]["disagreement"] < table[0.1, "aged exploration"]["disagreement"]
    assert "| 10 s | talking | 4 |" in "\n".join(section(rows(), made_up_log))
    assert [len(trace.means) for trace in figure_options(rows()).panels[0].traces] == [5, 5]


def test_the_verdicts_follow_the_runs_and_wait_for_them():
    found = changed(rows(), made_up_log)
    assert talking_is_quicker(found, 10.0)[1] is True
    turned = {key: found[key[0], {"talking": "as in the paper", "as in the paper": "talking"}.get(key[1], key[1])]
              for key in found}  # fmt: skip
    assert talking_is_quicker(turned, 10.0)[1] is False
    alike = {key: found[key[0], "talking"] for key in found}
    assert talking_is_quicker(alike, 10.0)[1] is None
    assert talking_is_quicker({}, 10.0) == ("runs are missing", None)
    assert steeper_is_no_worse(gains(rows()))[1] is True
    worse = [r | {"objects_per_robot": 100.0 + r["seed"]}
             if r["strategy.steepness_most"] and r["interfacing_time_s"] == 50.0 else r for r in rows()]  # fmt: skip
    assert steeper_is_no_worse(gains(worse)) == ("worse beyond chance at Π 50, better at the ends 0", False)
    level = [r | {"objects_per_robot": 150.0 + r["seed"]} for r in rows()]
    assert steeper_is_no_worse(gains(level))[1] is None
    assert steeper_is_no_worse(gains([r for r in rows() if r["seed"] == 0]))[1] is None


def test_who_never_reacts_is_slower_than_all_others():
    found = changed(rows(), made_up_log)
    silent = found[10.0, "as in the paper"]
    found[10.0, "as in the paper"] = silent._replace(reactions=[float("inf")] * 4)
    assert talking_is_quicker(found, 10.0)[1] is True and "against inf s" not in talking_is_quicker(found, 10.0)[0]

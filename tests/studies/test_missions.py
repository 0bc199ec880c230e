"""The study of missions on made-up runs: a mission that is not done is infinitely late and never left out."""

import pytest

from formicarium.studies.missions import figure_missions, mission_rows, reach_rows, robots_of


def row(name="garden", condition="safe", done=1, seconds=300.0, **more):
    times = {"flock_s": 10.0, "erupt_s": 20.0, "hold_s": 30.0, "gather_s": 40.0, "planned_s": 60.0}
    connected = {"lost_share_range": 0.0, "longest_loss_range_s": 0.0, "died": 0, "bytes_most": 400}
    own = {"map": name, "condition": condition, "mission_done": done, "mission_s": seconds if done else None}
    return {**times, **connected, **own, "tasks": 5, "tasks_done": 5 * done, **more}


def test_a_mission_that_is_not_done_counts_as_infinitely_late():
    (cell, _) = mission_rows([row(seconds=300.0), row(done=0), row(done=0)])
    assert (cell["done"], cell["runs"], cell["mission_s"]) == (1, 3, None)
    (cell, _) = mission_rows([row(seconds=300.0), row(seconds=400.0), row(done=0)])
    assert cell["mission_s"] == 400.0
    assert cell["done_low"] == pytest.approx(0.208, abs=0.001)  # Wilson's interval of 2 of 3
    assert cell["done_high"] == pytest.approx(0.939, abs=0.001)


def test_a_row_for_every_map_and_one_over_all():
    rows = [row(), row("ring", done=0), row(condition="one dies", died=1), row("ring", "one dies", died=1, done=0)]
    found = {(cell["condition"], cell["map"]): cell for cell in mission_rows(rows)}
    assert found["safe", "all"]["runs"] == 2 and found["safe", "all"]["done"] == 1
    assert found["one dies", "all"]["struck"] == 2 and found["one dies", "all"]["struck_done"] == 1
    assert len(found) == 6


def test_who_parted_for_a_single_step_was_not_whole():
    (cell, _) = mission_rows([row(), row(lost_share_range=1e-4)])
    assert cell["whole"] == 1


def test_the_figure_stacks_the_phases_of_each_map():
    chart = figure_missions([row(), row("ring", "one dies")])
    assert [panel.title for panel in chart.panels] == ["garden: 60 s planned", "ring: 60 s planned"]
    assert chart.panels[0].stacks[0].parts == [10.0, 20.0, 30.0, 40.0]


def test_reach_is_length_for_each_robot_of_the_arm():
    assert [robots_of(20, 3, k) for k in range(3)] == [7, 7, 6]
    run = {"variant": "safe", "tasks": 3, "robots": 21, "length_1_m": 14.0, "length_2_m": 7.0, "length_3_m": 18.0}
    (cell,) = reach_rows([run])
    assert (cell["reach_least_m"], cell["reach_median_m"]) == (1.0, 2.0)
    assert cell["reach_p5_m"] == pytest.approx(1.1)

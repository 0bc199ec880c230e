"""The settings against the paper's Table 1, and the published times against its Table S3."""

import csv
import math
from importlib import resources
from itertools import pairwise
from pathlib import Path

import pytest

from formicarium.systems.sequencing.parameters import (
    BehaviourTable,
    mark_i3_parameters,
    mark_i4_parameters,
    mark_ii3_parameters,
    mark_ii4_parameters,
)
from formicarium.systems.sequencing.study import MARK_I3, MARK_I4, MARK_II3, MARK_II4, published_run_times

SHARED = Path(__file__).parents[3] / "shared" / "data"


def shared_rows(name: str) -> list[dict[str, str]]:
    path = SHARED / name
    if not path.exists():
        pytest.skip(f"the shared data of the project are not beside this checkout: no {name}")
    with path.open(encoding="utf-8") as file:
        return list(csv.DictReader(file))


def table_1(variant: str) -> list[dict[str, str]]:
    rows = shared_rows("ts_swarm_table1.csv")
    return [row for row in rows if row["variant"] == variant and row["level"] == "default"]


VARIANTS = {
    "Mark I3": mark_i3_parameters,
    "Mark I4": mark_i4_parameters,
    "Mark II3": mark_ii3_parameters,
    "Mark II4": mark_ii4_parameters,
}


@pytest.mark.parametrize("setting", range(5))
@pytest.mark.parametrize("variant", VARIANTS)
def test_a_setting_is_the_papers_row(variant, setting):
    row = next(row for row in table_1(variant) if int(row["setting"]) == setting)
    p = VARIANTS[variant](setting)
    assert p.swarm.robots == int(row["n_robots"])
    assert p.swarm.time_cap == float(row["time_cap_s"])
    assert p.arena.side == pytest.approx(float(row["side_m"]), abs=0.005)
    sides = p.arena.sides
    area = 0.25 * sides * p.arena.side**2 / math.tan(math.pi / sides)
    assert area == pytest.approx(float(row["area_m2"]), abs=0.022)  # C1: the octagons' areas are the hexagons'


def test_each_setting_doubles_the_area():
    """TS-34: the unrounded side."""
    sides = [mark_i3_parameters(k).arena.side for k in range(5)]
    assert sides[0] == 0.9
    assert all((b / a) ** 2 == pytest.approx(2.0) for a, b in pairwise(sides))


def test_the_controller_is_the_same_in_every_setting():
    """TS-3, TS-142."""
    first = mark_i3_parameters(0)
    for k in range(1, 5):
        p = mark_i3_parameters(k)
        assert (p.behaviour, p.epuck, p.booth, p.physics) == (
            first.behaviour,
            first.epuck,
            first.booth,
            first.physics,
        )


@pytest.mark.parametrize(("three", "four"), [("Mark I3", "Mark I4"), ("Mark II3", "Mark II4")])
def test_four_tasks_differ_in_the_controller_by_the_number_of_tasks_alone(three, four):
    """TS-3, T20: and the machine code is the same, as the system's loop is."""
    one, other = VARIANTS[three](), VARIANTS[four]()
    assert other.behaviour.model_dump() == one.behaviour.model_dump() | {"tasks": 4}
    assert (other.epuck, other.booth, other.physics) == (one.epuck, one.booth, one.physics)
    assert MARK_I3.advance is MARK_I4.advance is MARK_II3.advance is MARK_II4.advance


def test_the_marks_differ_by_their_name_and_the_feedback_alone():
    one, other = mark_i3_parameters(), mark_ii3_parameters()
    assert other.behaviour.model_dump() == one.behaviour.model_dump() | {"mark": 2}
    assert other.booth.model_dump() == one.booth.model_dump() | {"delayed_feedback": True}
    assert (other.epuck, other.physics, other.arena) == (one.epuck, one.physics, one.arena)


def test_robots_that_expect_another_feedback_than_the_booths_give_are_refused():
    with pytest.raises(ValueError, match="delayed_feedback"):
        mark_i3_parameters(behaviour={"mark": 2})


def test_robots_that_count_differently_than_there_are_booths_are_refused():
    with pytest.raises(ValueError, match=r"behaviour\.tasks is 4"):
        mark_i3_parameters(behaviour={"tasks": 4})


@pytest.mark.parametrize("setting", [-1, 5])
def test_a_setting_that_does_not_exist_is_refused(setting):
    with pytest.raises(ValueError, match="settings 0 to 4"):
        mark_i3_parameters(setting)


def test_what_the_paper_prints_is_what_the_tables_hold():
    b = BehaviourTable()
    assert b.tasks == 3
    assert b.spacing_tolerance == 0.05  # TS-69
    assert b.alignment_tolerance == pytest.approx(math.radians(10.0))
    assert b.exit_distance == 0.25  # TS-45
    assert mark_i3_parameters().physics.cycle_time == 0.1  # TS-40
    assert mark_i3_parameters().swarm.sequences == 10  # TS-136


def test_neighbours_in_a_chain_can_see_each_other():
    """TS-38, U6: wanted spacing and its tolerance stay within sight."""
    p = mark_i3_parameters()
    assert 0.15 <= p.behaviour.spacing <= 0.20
    assert p.behaviour.spacing + p.behaviour.spacing_tolerance < p.epuck.camera_range


def test_noise_is_on_by_default():
    """TS-19, T23."""
    e = mark_i3_parameters().epuck
    assert e.wheel_noise == 0.05 and e.proximity_noise == 0.05 and e.camera_miss == 0.05 and e.radio_loss == 0.05
    assert e.camera_distance_noise == 0.013 and e.camera_bearing_noise == pytest.approx(math.radians(2.0))
    assert e.radio_distance_noise == 0.25 and e.radio_distance_noise_floor == 0.03
    assert e.radio_bearing_noise == pytest.approx(math.radians(8.0)) and e.radio_capacity == 5
    assert mark_i3_parameters().booth.exchange_failure == 0.02  # TS-25


def test_the_published_table_is_the_papers():
    text = resources.files("formicarium.systems.sequencing.published").joinpath("table_s3.csv").read_text("utf-8")
    ours = list(csv.DictReader(line for line in text.splitlines() if not line.startswith("#")))
    assert ours == shared_rows("ts_swarm_table_s3.csv")


def test_the_published_run_times():
    """TS-150: medians and ranges; the ninth run did not reach ten sequences."""
    times = published_run_times()
    assert {name: len(values) for name, values in times.items()} == dict.fromkeys(
        ("time_chain_s", "time_1_s", "time_5_s", "time_10_s"), 10
    )

    def middle(values):
        return 0.5 * (sorted(values)[4] + sorted(values)[5])

    assert [middle(times[name]) for name in times] == [387.5, 475.0, 850.0, 1458.0]
    assert (min(times["time_chain_s"]), max(times["time_chain_s"])) == (290.0, 605.0)
    assert times["time_10_s"][8] == math.inf
    assert set(MARK_I3.targets.columns) <= set(times)

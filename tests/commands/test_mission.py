"""``formicarium run coverage --map``: from a file of tasks to missions, and what is refused on the way."""

import json

import pyarrow.parquet as pq
import pytest

from formicarium.commands.errors import UserError
from formicarium.commands.known import find_system
from formicarium.commands.main import exit_code
from formicarium.commands.mission import parameters_with_map

pytest.importorskip("highspy")

MAP = """
start = [1.0, 2.0]
[[teams]]
robots = 8
[[tasks]]
name = "well"
x = 4.0
y = 3.0
duration = 3.0
[[tasks]]
name = "gate"
x = -1.0
y = 4.0
duration = 2.0
after = ["well"]
"""


@pytest.fixture(autouse=True)
def elsewhere(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("COLUMNS", "160")
    (tmp_path / "map.toml").write_text(MAP)
    return tmp_path


def planned(file="map.toml", robots=None, settings=()):
    return parameters_with_map(find_system("coverage"), None, robots, settings, file)


def test_a_mission_is_run_summed_up_and_needs_no_map_any_more(tmp_path, capsys):
    command = ["run", "coverage", "--map", "map.toml", "--set", "variant=safe", "--out", "here", "--workers", "1"]
    assert exit_code([*command, "--runs", "2"]) == 0
    said = capsys.readouterr().out
    assert "missions  2 of 2 done, 4 of 4 tasks" in said and "5 s of them planned" in said
    (tmp_path / "map.toml").unlink()
    rows = pq.read_table("here/runs.parquet").to_pylist()
    assert [row["mission_done"] for row in rows] == [1, 1] and {row["robots"] for row in rows} == {8}
    kept = json.loads((tmp_path / "here" / "configuration.json").read_text())["parameters"]
    assert [[task["name"] for task in slot["tasks"]] for slot in kept["mission"]["slots"]] == [["well"], ["gate"]]


def test_places_are_relative_to_the_start_and_robots_are_relays_and_workers():
    plan = planned().mission
    well = plan.slots[0].tasks[0]
    assert (well.x, well.y) == (3.0, 1.0) and well.robots <= 7
    assert plan.duration == 5.0 and plan.planning_range == 1.0


def test_the_planning_range_is_a_parameter_unless_the_map_says_it(tmp_path):
    far = MAP.replace("x = 4.0", "x = 14.0")
    (tmp_path / "far.toml").write_text(far)
    (tmp_path / "said.toml").write_text(f"spacing = 2.0\n{far}")
    wide = planned("far.toml", settings=("planning_range=2.0",))
    assert wide.mission.slots == planned("said.toml").mission.slots != planned("far.toml").mission.slots
    assert planned("said.toml").mission.planning_range == 2.0


def test_settings_have_the_last_word():
    chosen = planned(settings=("time_cap=77", "rendezvous=potential"))
    assert chosen.swarm.time_cap == 77.0 and chosen.behaviour.rendezvous == "potential"
    assert chosen.tasks.programme == "mission" and chosen.behaviour.arm_choice == "quota"


@pytest.mark.parametrize(
    ("change", "said"),
    [
        (("duration = 3.0", "robots = 2"), "map.toml: task 'well': robots = 2: an arm brings one robot"),
        (("robots = 8", 'robots = 8\nabilities = ["dig"]'), None),
        (("duration = 3.0", "duration = -3.0"), "map.toml: task 'well': duration = -3.0: must be from 1e-06 to 1e+09"),
        (("duration = 3.0", "lasts = 3.0"), "map.toml: task 'well': lasts: there is no such field"),
        (("x = 4.0", 'x = "here"'), "map.toml: task 'well': x = 'here'"),
    ],
)
def test_a_map_is_refused_by_file_field_and_value(tmp_path, capsys, change, said):
    (tmp_path / "map.toml").write_text(MAP.replace(*change))
    if said is None:
        assert planned().swarm.robots == 8
        return
    assert exit_code(["run", "coverage", "--map", "map.toml"]) == 2
    assert said in capsys.readouterr().err


def test_too_many_tasks_for_a_slot_say_what_to_do(tmp_path):
    lines = [f"t{k},{0.5 * k},0.3,1,2" for k in range(7)]
    (tmp_path / "crowd.csv").write_text("\n".join(["name,x,y,robots,duration", *lines]))
    with pytest.raises(UserError, match="slot 1 of the plan has 7 tasks, a message has room for 6 arms: give fewer"):
        planned("crowd.csv", robots=40)


def test_only_systems_that_fly_missions_take_maps(capsys):
    assert exit_code(["run", "mark-i3", "--map", "map.toml"]) == 2
    assert "--map map.toml: mark-i3 does no tasks of a map; formicarium run coverage does" in capsys.readouterr().err


def test_a_csv_needs_the_number_of_robots(tmp_path, capsys):
    (tmp_path / "tasks.csv").write_text("name,x,y,duration\nwell,2,1,3\n")
    assert exit_code(["run", "coverage", "--map", "tasks.csv"]) == 2
    assert "list teams, or give their number (--robots)" in capsys.readouterr().err
    assert planned("tasks.csv", robots=6).swarm.robots == 6

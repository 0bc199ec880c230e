"""``formicarium campaign``: plan, run, status, collect, on a system without a simulator."""

import json
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pyarrow.csv
import pyarrow.parquet as pq
import pytest
from pydantic import create_model

import random_walk
from formicarium.campaigns import table
from formicarium.campaigns.parts import read_part, write_part
from formicarium.commands import work
from formicarium.commands.main import exit_code

TESTS = Path(__file__).parents[1]
WALK = "random_walk:RANDOM_WALK"
DESIGN = f"""
name = "walk"
system = "{WALK}"
replicates = 3

[factors]
robots = [5, 9]
"booth.dwell_time" = [1, 2.5]
"""


@pytest.fixture(autouse=True)
def elsewhere(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("COLUMNS", "160")
    (tmp_path / "study.toml").write_text(DESIGN)
    return tmp_path


def campaign(verb, *arguments):
    return exit_code(["campaign", verb, "study.toml", "--out", "here", *map(str, arguments)])


def rows(folder="here"):
    return pq.read_table(f"{folder}/runs.parquet").to_pylist()


def test_a_campaign_from_plan_to_table(tmp_path, capsys):
    assert campaign("plan") == 0
    said = capsys.readouterr().out
    assert "4 cells x 3 = 12 runs" in said
    assert not (tmp_path / "here").exists()
    assert campaign("run", "--workers", 2) == 0
    assert "12 of 12 runs done; 12 now" in capsys.readouterr().out
    assert campaign("status") == 0
    assert "12 of 12 runs done, 0 failed, 0 missing; nobody is at work" in capsys.readouterr().out
    assert campaign("collect", "--figures") == 0
    assert "12 of 12 runs" in capsys.readouterr().out
    found = rows()
    assert [row["cell"] for row in found] == [k // 3 for k in range(12)]
    assert [row["replicate"] for row in found] == [0, 1, 2] * 4
    assert {(row["robots"], row["booth.dwell_time"]) for row in found} == {(5, 1.0), (5, 2.5), (9, 1.0), (9, 2.5)}
    assert len({row["seed"] for row in found}) == 12
    assert len({row["identity"] for row in found}) == 4
    assert pyarrow.csv.read_csv("here/runs.csv")["seed"].to_pylist() == [row["seed"] for row in found]
    assert pyarrow.csv.read_csv("here/cells.csv").num_rows == 4
    assert len(list((tmp_path / "here" / "figures").glob("*.png"))) == 4
    assert json.loads((tmp_path / "here" / "campaign.json").read_text())["design"]["name"] == "walk"


def test_a_factor_may_be_a_list(tmp_path):
    (tmp_path / "study.toml").write_text(DESIGN.replace('"booth.dwell_time" = [1, 2.5]', "lamps = [[1, 2], [3]]"))
    assert campaign("run", "--workers", 1) == 0
    assert campaign("collect") == 0
    assert [row["lamps"] for row in rows()] == (["[1, 2]"] * 3 + ["[3]"] * 3) * 2
    assert pyarrow.csv.read_csv("here/cells.csv")["lamps"].to_pylist() == ["[1, 2]", "[3]"] * 2
    assert exit_code(["campaign", "compare", "here", "here", "--a", "lamps=[1, 2]", "--b", "lamps=[3]"]) == 0


def test_more_runs_only_add(capsys):
    campaign("run", "--workers", 1)
    campaign("collect")
    before = rows()
    assert campaign("run", "--runs", 4, "--workers", 1) == 0
    assert "16 of 16 runs done, 12 of them loaded; 4 now" in capsys.readouterr().out
    campaign("collect", "--runs", 4)
    assert [row for row in rows() if row["replicate"] < 3] == before


def test_a_setting_on_the_command_line_takes_the_place_of_a_factor(capsys):
    assert campaign("plan", "--set", "robots=7", "--set", "duration=300", "--runs", 1) == 0
    said = capsys.readouterr().out
    assert "2 cells x 1 = 2 runs" in said


def test_a_failing_run_is_recorded_and_run_again_on_request(tmp_path, capsys):
    text = DESIGN.replace("replicates = 3", "seeds = [1, 2, 3]\nset = { failing_seed = 2, robots = 5 }")
    (tmp_path / "study.toml").write_text(text.replace("robots = [5, 9]\n", ""))
    assert campaign("run", "--workers", 2) == 1
    said = capsys.readouterr()
    assert "4 of 6 runs done, 2 failed" in said.out
    assert "RuntimeError: this seed fails on purpose" in said.err
    assert campaign("status") == 1
    said = capsys.readouterr().out
    assert "cell 0, seed 2: RuntimeError: this seed fails on purpose" in said
    assert campaign("run", "--workers", 1) == 1
    assert "0 now" in capsys.readouterr().out
    assert campaign("run", "--workers", 1, "--retry") == 1
    assert "failed: cell 0 (booth.dwell_time = 1), seed 2\n" in capsys.readouterr().err
    assert campaign("collect") == 1
    assert [row["seed"] for row in rows()] == [1, 3, 1, 3]


def test_a_run_that_takes_too_long_is_ended(tmp_path, capsys):
    (tmp_path / "study.toml").write_text(f'name = "s"\nsystem = "{WALK}"\nseeds = [1]\nset = {{ pause = 60.0 }}')
    assert campaign("run", "--time-limit", 0.5) == 1
    assert "took longer than 0.5 s" in capsys.readouterr().err


def test_events_are_kept_if_the_design_says_so(tmp_path):
    (tmp_path / "study.toml").write_text(f'name = "s"\nsystem = "{WALK}"\nseeds = [4]\nkeep = ["events"]')
    assert campaign("run") == 0
    (path,) = (tmp_path / "here").glob("events/*/seed-4.parquet")
    assert set(pq.read_table(path)["kind"].to_pylist()) == {"ROLE", "SEQUENCE", "DEATH"}


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (("replicates = 3", "replicates = 0"), ["study.toml: replicates = 0"]),
        (("replicates = 3", "replicats = 3"), ["study.toml: replicats: no such key", "replicates"]),
        ((WALK, "random_walk:NOTHING"), ["study.toml: system", "NOTHING"]),
        (("robots = [5, 9]", "robbots = [5, 9]"), ["study.toml: factors.robbots", "Did you mean", "robots"]),
        (("robots = [5, 9]", "robots = [5, 900]"), ["study.toml: cell 2 (robots = 900", "less than or equal to 200"]),
        (("robots = [5, 9]", 'robots = [5, "nine"]'), ["cell 2 (robots = nine", "robots = 'nine': must be a whole"]),
        (
            ("robots = [5, 9]", "robots = [5, 5]"),
            ["study.toml: cells 0 (robots = 5", "and 2 (robots = 5", "are the same runs"],
        ),
        (("[1, 2.5]", '[1, "far"]'), ['booth.dwell_time = "far"', "valid number", "0 to 60 s"]),
        (("[1, 2.5]", "[1, true]"), ["booth.dwell_time = true", "valid number"]),
        (("[1, 2.5]", "[1, 99]"), ["booth.dwell_time = 99", "less than or equal to 60"]),
        (("[1, 2.5]", "[1, 1.0]"), ["are the same runs"]),
        (("[factors]", "keep = ['films']\n[factors]"), ["keep = 'films': must be among events, frames"]),
        (("[factors]", "set = { dwell_time = 3.0 }\n[factors]"), ["is the same parameter as 'dwell_time'"]),
        (("[factors]", "[factors"), ["study.toml: is not valid TOML"]),
    ],
)
@pytest.mark.parametrize("verb", ["run", "plan"])
def test_a_wrong_design_is_refused_before_anything_starts(tmp_path, capsys, change, words, verb):
    (tmp_path / "study.toml").write_text(DESIGN.replace(*change))
    assert campaign(verb) == 2
    said = capsys.readouterr()
    for word in words:
        assert word in said.err
    assert "Traceback" not in said.err
    assert not (tmp_path / "here").exists()


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["--runs", 0], "--runs 0: must be at least 1"),
        (["--workers", 0], "--workers 0: must be at least 1"),
        (["--time-limit", 0], "--time-limit 0: must be a time"),
        (["--set", "dwel=3"], "--set dwel: no parameter"),
        (["--set", "robots=many"], "--set robots=many: must be a whole number"),
    ],
)
def test_a_wrong_option_is_refused_before_anything_starts(tmp_path, capsys, arguments, words):
    assert campaign("run", *arguments) == 2
    assert words in capsys.readouterr().err
    assert not (tmp_path / "here").exists()


def test_rows_of_other_sources_do_not_count_are_told_and_can_be_cleaned_up(tmp_path, capsys, monkeypatch):
    monkeypatch.setattr(work, "sources_of", lambda system: "0123456789abcdef")
    assert campaign("run", "--workers", 1, "--runs", 2) == 1  # the workers find other sources and say so
    assert "the sources were edited" in capsys.readouterr().err
    monkeypatch.undo()
    monkeypatch.chdir(tmp_path)
    assert campaign("run", "--workers", 2) == 0
    monkeypatch.setattr(work, "sources_of", lambda system: "0123456789abcdef")
    assert campaign("status") == 1
    said = capsys.readouterr().out
    assert "0 of 12 runs done, 0 failed, 12 missing" in said
    assert "12 rows made by other sources (--sources " in said
    own = said.split("--sources ")[1].split(")")[0]
    assert campaign("collect") == 2
    assert f"it holds 12 rows made by other sources (--sources {own})" in capsys.readouterr().err
    assert campaign("collect", "--sources", own) == 0
    assert len(rows()) == 12
    assert campaign("clean") == 0
    assert "12 rows and 4 files can go, 0 rows stay" in capsys.readouterr().out
    assert campaign("clean", "--yes") == 0
    assert campaign("status") == 1
    assert "other sources" not in capsys.readouterr().out.split("removed")[-1]
    assert not list((tmp_path / "here" / "parts").iterdir())


def test_rows_of_sources_with_fewer_parameters_are_still_read(tmp_path, capsys, monkeypatch):
    """New sources bring new parameters and other defaults; what the design says is the same."""
    assert campaign("run", "--workers", 1, "--set", "duration=300") == 0
    assert campaign("run", "--workers", 1) == 0
    assert campaign("collect") == 0
    before = rows()
    monkeypatch.setattr(work, "sources_of", lambda system: "0123456789abcdef")
    monkeypatch.setattr(random_walk, "RANDOM_WALK", later_walk())
    capsys.readouterr()
    assert campaign("collect") == 2
    said = capsys.readouterr().err
    own = before[0]["sources"]
    assert f"12 rows made by other sources (--sources {own})" in said
    assert f"12 rows of other parameters, made by other sources ({own})" in said
    assert campaign("status") == 1
    assert [line.split()[-1] for line in capsys.readouterr().out.splitlines()[1:6]] == ["outdated", *"3333"]
    assert campaign("collect", "--sources", own) == 0
    assert rows() == before
    assert campaign("collect", "--sources", own, "--set", "duration=300") == 0
    assert {row["duration_s"] for row in rows()} == {300.0}


def test_cells_that_differ_in_seeds_only_are_still_read(tmp_path, monkeypatch):
    rows_of_seeds = "".join(f"[[rows]]\nrobots = 5\nfirst_seed = {seed}\n" for seed in (1, 100))
    (tmp_path / "study.toml").write_text(f'name = "walk"\nsystem = "{WALK}"\nreplicates = 2\n{rows_of_seeds}')
    assert campaign("run", "--workers", 1) == 0
    assert campaign("collect") == 0
    before = rows()
    assert [(row["cell"], row["seed"]) for row in before] == [(0, 1), (0, 2), (1, 100), (1, 101)]
    monkeypatch.setattr(work, "sources_of", lambda system: "0123456789abcdef")
    monkeypatch.setattr(random_walk, "RANDOM_WALK", later_walk())
    assert campaign("collect", "--sources", before[0]["sources"]) == 0
    assert rows() == before


def later_walk():
    """Return the system as other sources have it: with one parameter more, and another default."""
    trial = create_model("Trials", __base__=random_walk.Trials, patience=(float, 5.0))
    booth = create_model("Booth", __base__=random_walk.Booth, speed=(float, 2.0))
    parameters = create_model(
        "Parameters", __base__=random_walk.Parameters, trial=(trial, trial()), booth=(booth, booth())
    )

    def configure(setting=None, robots=None):
        return parameters(swarm=random_walk.configure(setting, robots).swarm)

    return random_walk.RANDOM_WALK._replace(parameters=parameters, configure=configure)


def collected(folder, text):
    (folder / "study.toml").write_text(text)
    assert campaign("run", "--workers", 1) == 0
    assert campaign("collect") == 0


def test_two_campaigns_are_compared_cell_by_cell(tmp_path, capsys):
    collected(tmp_path, DESIGN.replace("= 3", "= 8"))
    (tmp_path / "here").rename(tmp_path / "old")
    collected(tmp_path, DESIGN.replace("= 3", "= 8\nset = { duration = 300.0 }"))
    capsys.readouterr()
    assert exit_code(["campaign", "compare", "old", "here", "--out", "difference.csv"]) == 0
    said = capsys.readouterr().out
    assert "log-rank p" in said
    found = pyarrow.csv.read_csv("difference.csv").to_pylist()
    assert len(found) == 4 * 3
    assert [row["robots"] for row in found[::6]] == [5, 9]
    assert all(row["a.runs"] == row["b.runs"] == 8 for row in found)
    assert all(row["difference.low"] <= row["difference"] <= row["difference.high"] for row in found)
    assert all(row["fisher_p"] <= row["fisher_holm"] for row in found)
    slower = [row for row in found if row["target"] == "5 sequences"]
    assert all(row["hazard"] < 1 < row["medians"] for row in slower)  # twice the duration is twice the times


def test_cells_of_one_campaign_are_compared(tmp_path, capsys):
    collected(tmp_path, DESIGN)
    assert exit_code(["campaign", "compare", "here", "here", "--a", "robots=5", "--b", "robots=9"]) == 0
    assert exit_code(["run", WALK, "--robots", "5", "--runs", "4", "--workers", "1", "--out", "set"]) == 0
    choice = ["--a", "booth.dwell_time=1"]
    assert exit_code(["campaign", "compare", "here", "set", *choice]) == 0
    capsys.readouterr()
    for arguments, words in (
        (
            ["here", "set"],
            "varies booth.dwell_time (1.0, 2.5), the other does not: choose with --a booth.dwell_time=1.0",
        ),
        (["here", "nowhere"], "collect the campaign first"),
        (["here", "here", "--a", "robots=7"], "has no run with robots=7"),
        (["here", "here", "--a", "robbots=7"], "Did you mean robots"),
        (["here", "here", "--out", "x.txt"], "name a .csv file"),
    ):
        assert exit_code(["campaign", "compare", *arguments]) == 2
        assert words in capsys.readouterr().err


def stand_in_sbatch(script):
    """Do what Slurm would: read the array's size from the script and run it once a task."""
    text = script.read_text()
    last = int(re.search(r"^#SBATCH --array=0-(\d+)$", text, re.MULTILINE)[1])
    path = os.pathsep.join([str(TESTS), os.environ.get("PYTHONPATH", "")])
    tasks = [
        subprocess.Popen(["bash", script], env={**os.environ, "PYTHONPATH": path, "SLURM_ARRAY_TASK_ID": str(task)})
        for task in range(last + 1)
    ]
    assert [task.wait(timeout=60) for task in tasks] == [0] * len(tasks)


def test_a_task_of_an_array_tries_only_its_own_failures_again(tmp_path, capsys):
    """What another task has seen fail meanwhile stays a failure."""
    (tmp_path / "study.toml").write_text(f'name = "s"\nsystem = "{WALK}"\nseeds = [1, 2]\nset = {{ failing_seed = 1 }}')
    assert campaign("run", "--share", "0/2") == 1
    assert campaign("run", "--share", "1/2", "--retry") == 0
    assert campaign("status") == 1
    assert "1 of 2 runs done, 1 failed, 0 missing" in capsys.readouterr().out


@pytest.mark.long  # the guide's test does nearly the same
def test_one_process_two_dask_and_a_slurm_array_give_the_same_bytes(tmp_path, monkeypatch):
    monkeypatch.setenv("PYTHONPATH", os.pathsep.join([str(TESTS), os.environ.get("PYTHONPATH", "")]))
    found = {}
    ways = {
        "one": ["--workers", 1],
        "two": ["--workers", 2],
        "dask": ["--dask", "local", "--workers", 2],
        "slurm": ["--slurm-array", 3, "--sbatch=--time=00:10:00"],
    }
    for name, words in ways.items():
        assert campaign("run", *words) == 0
        if name == "slurm":
            assert "#SBATCH --time=00:10:00\n" in (tmp_path / "here" / "slurm.sh").read_text()
            stand_in_sbatch(tmp_path / "here" / "slurm.sh")
        assert campaign("collect") == 0
        found[name] = [(tmp_path / "here" / file).read_bytes() for file in ("runs.parquet", "runs.csv", "cells.csv")]
        (tmp_path / "here").rename(tmp_path / name)
    assert found["one"] == found["two"] == found["dask"] == found["slurm"]


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["--share", "2/2"], "--share 2/2: expected K/N"),
        (["--slurm-array", 0], "--slurm-array 0: must be at least 1"),
        (["--slurm-array", 2, "--sbatch", "time=1"], "--sbatch 'time=1': expected an option"),
        (["--sbatch=--time=1"], "only together with --slurm-array"),
        (["--slurm-array", 2, "--dask", "local"], "not together with --dask"),
        (["--dask-option", "queue=short"], "only together with --dask"),
        (["--dask", "tcp://nowhere:1", "--workers", 2], "has its own"),
        (["--dask", "local", "--dask-option", "queue"], "expected NAME=VALUE"),
    ],
)
def test_wrong_words_about_clusters_are_refused(tmp_path, capsys, arguments, words):
    assert campaign("run", *arguments) == 2
    assert words in capsys.readouterr().err
    assert not list(tmp_path.rglob("*.parquet"))


def test_without_the_extra_dask_says_what_to_install(capsys, monkeypatch):
    monkeypatch.setitem(sys.modules, "distributed", None)
    monkeypatch.delitem(sys.modules, "formicarium.campaigns.cluster", raising=False)
    assert campaign("run", "--dask", "local") == 2
    assert 'distributed is not installed: pip install "formicarium[cluster]"' in capsys.readouterr().err


def test_runs_of_other_folders_are_taken_over(tmp_path, capsys):
    """A set made by ``run``, then a campaign made elsewhere; what is there is checked, not overwritten."""
    head = f'name = "walk"\nsystem = "{WALK}"\nfirst_seed = 1\nreplicates = 4\nkeep = ["events"]\n'
    (tmp_path / "study.toml").write_text(head + "[factors]\nrobots = [5, 9]")
    assert campaign("run") == 0
    campaign("collect")
    undisturbed = (tmp_path / "here" / "runs.parquet").read_bytes()
    (tmp_path / "here").rename(tmp_path / "elsewhere")
    assert exit_code(["run", WALK, "--robots", "5", "--runs", "6", "--workers", "1", "--out", "set"]) == 0
    capsys.readouterr()
    assert exit_code(["campaign", "adopt", "study.toml", "set", "--out", "here"]) == 0
    assert "4 runs taken over, 0 were there, 2 are not in the design" in capsys.readouterr().out
    assert exit_code(["campaign", "adopt", "study.toml", "elsewhere", "--out", "here"]) == 0
    assert "4 runs taken over, 4 were there, 0 are not in the design" in capsys.readouterr().out
    assert campaign("run") == 0
    assert "0 now" in capsys.readouterr().out
    campaign("collect")
    assert (tmp_path / "here" / "runs.parquet").read_bytes() == undisturbed
    assert exit_code(["campaign", "adopt", "study.toml", str(tmp_path / "nowhere"), "--out", "new"]) == 2
    assert "holds no results" in capsys.readouterr().err
    assert not (tmp_path / "new").exists()


def test_a_campaign_goes_on_from_one_file_where_its_folder_is_not(tmp_path, capsys):
    head = f'name = "walk"\nsystem = "{WALK}"\nfirst_seed = 1\nreplicates = 3\n'
    (tmp_path / "study.toml").write_text(head + "[factors]\nrobots = [5, 9]")
    assert campaign("run", "--runs", "3") == 0
    campaign("collect", "--runs", "3")
    undisturbed = (tmp_path / "here" / "runs.parquet").read_bytes()
    assert exit_code(["campaign", "pack", "study.toml", "kept.parquet", "--out", "here", "--runs", "2"]) == 0
    assert "4 runs packed" in capsys.readouterr().out
    shutil.rmtree(tmp_path / "here")
    assert exit_code(["campaign", "pack", "study.toml", "none.parquet", "--out", "here"]) == 2
    assert exit_code(["campaign", "adopt", "study.toml", "kept.parquet", "--out", "here", "--runs", "3"]) == 0
    assert "4 runs taken over" in capsys.readouterr().out
    assert campaign("run", "--runs", "3") == 0
    assert "2 now" in capsys.readouterr().out
    campaign("collect", "--runs", "3")
    assert (tmp_path / "here" / "runs.parquet").read_bytes() == undisturbed
    (tmp_path / "kept.parquet").write_bytes((tmp_path / "kept.parquet").read_bytes()[:-9])
    assert exit_code(["campaign", "adopt", "study.toml", "kept.parquet", "--out", "here"]) == 2
    assert "kept.parquet is damaged" in capsys.readouterr().err


def outdated(path, **changed):
    """Make a packed file one of other sources, with columns changed."""
    rows = read_part(path)
    columns = {"identity": ["0123456789abcdef"] * len(rows), "sources": ["fedcba9876543210"] * len(rows), **changed}
    for name, values in columns.items():
        place = rows.column_names.index(name)
        rows = rows.set_column(place, name, pyarrow.array(values, rows.schema.field(name).type))
    path.unlink()
    write_part(rows, path)


def test_rows_of_other_sources_are_taken_over_if_a_sample_of_them_comes_out_again(tmp_path, capsys):
    head = f'name = "walk"\nsystem = "{WALK}"\nfirst_seed = 1\nreplicates = 3\n'
    (tmp_path / "study.toml").write_text(head + "[factors]\nrobots = [5, 9]")
    assert campaign("run") == 0
    campaign("collect")
    undisturbed = table.read(tmp_path / "here" / "runs.parquet")
    campaign("pack", "kept.parquet")
    outdated(tmp_path / "kept.parquet")
    shutil.rmtree(tmp_path / "here")
    adopt = ["campaign", "adopt", "study.toml", "kept.parquet", "--out", "here"]
    capsys.readouterr()
    assert exit_code(adopt) == 0
    assert "0 runs taken over, 0 were there, 6 are not in the design\n" in capsys.readouterr().out
    assert exit_code([*adopt, "--runs", "2", "--repeat", "3"]) == 0
    said = capsys.readouterr().out
    assert said.count("repeating seed") == 3 and "; 4 of other sources taken over, 3 of them repeated: the same" in said
    assert campaign("run") == 0
    assert "2 now" in capsys.readouterr().out
    campaign("collect")
    assert table.read(tmp_path / "here" / "runs.parquet").equals(undisturbed)
    design = (tmp_path / "study.toml").read_text()
    (tmp_path / "study.toml").write_text(design.replace("[factors]", "set.dwell_time = 9.0\n[factors]"))
    assert exit_code(["campaign", "adopt", "study.toml", "here", "--out", "other", "--repeat", "3"]) == 0
    assert "; 0 of other sources taken over" in capsys.readouterr().out  # other parameters, the same sources
    (tmp_path / "study.toml").write_text(design)
    outdated(tmp_path / "kept.parquet", sequences=[7] * 6)
    adopt[-1] = "elsewhere"
    assert exit_code([*adopt, "--repeat", "1"]) == 2
    said = capsys.readouterr().err
    assert "gives another row with today's sources: sequences was 7, is" in said and "Nothing was taken over" in said
    assert not (tmp_path / "elsewhere").exists()


def test_runs_without_the_tables_that_a_design_keeps_are_left_to_be_run_again(tmp_path, capsys):
    (tmp_path / "study.toml").write_text(f'name = "walk"\nsystem = "{WALK}"\nseeds = [1, 2, 3]\nkeep = ["events"]')
    assert campaign("run") == 0
    campaign("pack", "kept.parquet")
    shutil.move(tmp_path / "here", tmp_path / "before")
    next((tmp_path / "before" / "events").rglob("*2.parquet")).unlink()
    capsys.readouterr()
    assert exit_code(["campaign", "adopt", "study.toml", "kept.parquet", "--out", "here"]) == 0
    assert "; 3 are without the events that the design keeps: run them again" in capsys.readouterr().out
    assert exit_code(["campaign", "adopt", "study.toml", "before", "--out", "here"]) == 0
    said = capsys.readouterr().out
    assert "2 runs taken over" in said and "; 1 are without the events" in said
    assert len(list((tmp_path / "here" / "events").rglob("*.parquet"))) == 2
    assert campaign("run") == 0
    assert "1 now" in capsys.readouterr().out
    outdated(tmp_path / "kept.parquet")
    assert exit_code(["campaign", "adopt", "study.toml", "kept.parquet", "--out", "other", "--repeat", "1"]) == 0
    assert "; 0 of other sources taken over" in capsys.readouterr().out


def test_a_folder_that_contradicts_is_not_taken_over(tmp_path, capsys):
    (tmp_path / "study.toml").write_text(f'name = "walk"\nsystem = "{WALK}"\nseeds = [1, 2]')
    campaign("run")
    exit_code(["run", WALK, "--runs", "2", "--workers", "1", "--out", "set"])
    path = tmp_path / "set" / "runs.parquet"
    rows = table.read(path)
    changed = rows.set_column(rows.column_names.index("sequences"), "sequences", pyarrow.array([99, 98]))
    table.write(changed.replace_schema_metadata(rows.schema.metadata), path)
    capsys.readouterr()
    assert exit_code(["campaign", "adopt", "study.toml", "set", "--out", "here"]) == 2
    assert "contradict each other: seed 1" in capsys.readouterr().err

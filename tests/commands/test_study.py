"""``formicarium study sequencing``: from its runs to its figures, and from what is there."""

import csv
from pathlib import Path
from time import perf_counter

import pytest

from formicarium.commands.main import exit_code
from formicarium.commands.published import answers, store
from formicarium.commands.published.store import NEEDS, TABLES, Asked, Part, needed, open_design

RESULTS = Path(__file__).parents[2] / "docs" / "results"


@pytest.fixture(autouse=True)
def short(monkeypatch, tmp_path):
    """Twenty simulated seconds a run, and as long without a runner."""
    monkeypatch.setattr(store, "MORE", ("swarm.time_cap=20",))
    monkeypatch.chdir(tmp_path)


def study(*arguments):
    return exit_code(["study", "sequencing", "--out", "here", *arguments])


@pytest.mark.parametrize(
    ("figure", "runs"), [("4", 120), ("5", 2400), ("7", 2400), ("S18", 150), ("S19", 60), ("all", 4830)]
)
def test_a_figure_runs_only_the_cells_that_it_shows(figure, runs, tmp_path):
    asked = Asked(figure, tmp_path)
    assert sum(needed(part, asked).total for part in NEEDS[figure]) == runs


def test_settings_can_be_run_one_by_one(tmp_path):
    part = Part(TABLES["mark-ii4"])
    assert needed(part, Asked("7", tmp_path, runs=10, settings=(3, 4))).total == 160
    assert len({job.cell.factors["setting"] for job in needed(part, Asked("7", tmp_path, settings=(3,))).jobs}) == 1


def test_figure_s19_is_run_and_drawn_and_loaded_again(tmp_path, capsys):
    assert study("--figure", "S19", "--collect-only") == 2
    assert "no run of this study" in capsys.readouterr().err
    once = ("--figure", "S19", "--runs", "2", "--workers", "1")
    assert study(*once) == 0
    assert "drawn from 4 of 4 runs" in capsys.readouterr().out
    picture = (tmp_path / "here" / "figure-s19.png").read_bytes()
    assert study(*once) == 0
    assert "2 of them loaded" in capsys.readouterr().out
    assert (tmp_path / "here" / "figure-s19.png").read_bytes() == picture
    assert study("--figure", "S19", "--collect-only") == 1  # 56 of the paper's 60 are missing
    assert study("--figure", "S19", "--sources", "0123456789abcdef") == 2
    own = open_design("mark-ii3-table-1", Asked("S19", tmp_path)).jobs[0].configuration.sources
    several = ("--sources", "0123456789abcdef", "--sources", own)
    capsys.readouterr()
    assert study("--figure", "S19", "--runs", "2", *several) == 0
    assert "drawn from 4 of 4 runs" in capsys.readouterr().out


def test_an_unfinished_study_is_drawn_as_far_as_it_goes(tmp_path, capsys):
    design = open_design("mark-i3-table-1", Asked("all", tmp_path / "here", runs=1))
    assert answers.perform(design._replace(jobs=design.jobs[:3]), answers.Request(workers=1)) == 0
    assert study("--collect-only") == 1
    assert "drawn from 3 of 4830 runs" in capsys.readouterr().out
    names = {path.name for path in (tmp_path / "here").iterdir() if path.is_file()}
    numbers = ("3", "4", "5a", "5b", "6", "7a", "7b", "s15", "s17", "s18", "s19")  # Fig. 2 shows runs of its own
    figures = {f"figure-{number}.png" for number in numbers}
    assert names == {*figures, "cells.csv", "table-s3.csv", "report.md", "report.html"}
    with (tmp_path / "here" / "cells.csv").open() as file:
        rows = list(csv.DictReader(file))
    assert [row["runs"] for row in rows] == ["1"] * 3 + ["0"] * 157
    text = (tmp_path / "here" / "report.md").read_text()
    assert "| Mark I3 | 3 | 3 of 40 | 0 |" in text
    assert text.count("| too few runs yet |") == 39
    assert "3 of 1200 listed runs (3 of them failures)" in text


def test_one_run_in_so_many_is_done_again(tmp_path):
    """With every run in the sample: the rows come out again, doubled noise changes them, members are counted anew."""
    assert study("--figure", "S19", "--runs", "2", "--workers", "1", "--check", "1") == 0
    text = (tmp_path / "here" / "report.md").read_text()
    for name in ("Mark II3", "Mark II4"):
        assert f"| T23 {name} | doubled noise changes the result | 0 of 2 rows stayed the same | passed |" in text
        assert "2 of 2 rows the same, times of 2 recomputed from the log | passed |" in text
        assert "by the log 2 of 2 runs done again | passed |" in text


def test_what_is_there_is_checked_before_the_study_is_done(tmp_path):
    design = open_design("mark-ii3-table-1", Asked("all", tmp_path / "here", runs=1))
    assert answers.perform(design._replace(jobs=design.jobs[:1]), answers.Request(workers=1)) == 0
    assert study("--figure", "7", "--workers", "1", "--collect-only", "--check", "1") == 1
    text = (tmp_path / "here" / "report.md").read_text()
    assert "| T23 Mark II3 | doubled noise changes the result | 0 of 1 rows stayed the same | passed |" in text
    assert "1 of 1200 listed runs" in text


@pytest.mark.parametrize(
    ("asked", "words"),
    [
        (("sequencing", "--check", "0"), "--check 0: must be at least 1"),
        (("sequencing", "--check", "5", "--sources", "abc"), "leave out --sources and --from-tables"),
        (("sequencing", "--check", "5", "--from-tables", "tables"), "leave out --sources and --from-tables"),
        (("sequencing", "--figure", "S15", "--check", "5"), "--check: figure S15 is drawn without runs"),
        (("partitioning", "--check", "5"), "--check: of the study sequencing alone"),
        (("coverage", "--setting", "1"), "--setting: of the study sequencing alone"),
        (("scheduling", "--from-tables", "tables"), "--from-tables: of the study sequencing alone"),
        (("sequencing", "--reference", "here"), "--reference: of the study connectivity alone"),
    ],
)
def test_an_option_that_would_be_ignored_is_refused(asked, words, capsys):
    assert exit_code(["study", *asked]) == 2
    assert words in " ".join(capsys.readouterr().err.split())


def test_a_run_that_was_ended_early_is_run_on_to_the_cap(tmp_path, monkeypatch):
    """Four robots, all of which join the chain: nobody is left after two minutes or so."""
    few = ("swarm.robots=4", "swarm.time_cap=600")
    monkeypatch.setattr(store, "MORE", (*few, "swarm.idle_limit=30"))
    asked = Asked("all", tmp_path / "here", runs=1)
    design = open_design("mark-ii3-table-1", asked)
    first = design._replace(jobs=design.jobs[:1])
    assert answers.perform(first, answers.Request(workers=1)) == 0
    (row,) = store.tidy_rows(first)
    assert (row["hopeless_s"] < 600.0, row["duration_s"], row["success"]) == (True, 600.0, 0)
    monkeypatch.setattr(store, "MORE", few)
    assert answers.checks.run_checks([first], 1, 1) == 0
    found = answers.checks.stored(first, store.cells_of(first), None)
    assert [run["hopeless_s"] is None for run in found.control] == [True]
    assert [run["duration_s"] for run in found.control] == [600.0]


def test_figures_are_drawn_from_tables_alone(tmp_path):
    assert study("--figure", "S19", "--runs", "2", "--workers", "1") == 0
    tables = str(tmp_path / "here" / "tables")
    assert exit_code(["study", "sequencing", "--figure", "S19", "--out", "there", "--from-tables", tables]) == 1
    for name in ("tables/mark_ii3_table_1.csv", "tables/mark_ii4_table_1.csv", "cells.csv", "figure-s19.png"):
        assert (tmp_path / "there" / name).read_bytes() == (tmp_path / "here" / name).read_bytes()


def test_the_committed_report_is_what_the_committed_tables_say(tmp_path, monkeypatch):
    monkeypatch.setattr(store, "MORE", ())
    asked = ["study", "sequencing", "--out", "there", "--from-tables", str(RESULTS / "tables")]
    assert exit_code(asked) in (0, 1)  # 1: not all of the paper's runs yet
    text = (tmp_path / "there" / "report.md").read_text()
    report = (RESULTS / "task_sequencing_report.md").read_text()
    assert report == text.replace("](figure-", "](../images/task-sequencing/study/figure-")


def test_snapshots_arenas_and_trees_need_no_study(tmp_path):
    assert study("--figure", "2", "--collect-only") == 2
    for figure in ("2", "3", "6", "S15", "S17"):
        assert study("--figure", figure, "--workers", "1") == 0
        assert (tmp_path / "here" / f"figure-{figure.lower()}.png").exists()


@pytest.mark.long
def test_a_new_user_makes_figure_4_in_ten_minutes(monkeypatch):
    """Five runs a panel at the paper's caps, with one worker; hopeless runs are ended."""
    monkeypatch.setattr(store, "MORE", ())
    begun = perf_counter()
    assert study("--figure", "4", "--runs", "5", "--workers", "1") == 0
    assert perf_counter() - begun < 600.0

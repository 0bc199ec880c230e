"""``formicarium study sequencing``: from its runs to its figures, and from what is there."""

import csv
import tomllib
from importlib import resources

import pytest

from formicarium.commands import published
from formicarium.commands.main import exit_code
from formicarium.studies.cells import LEVELS, level_of


@pytest.fixture(autouse=True)
def short(monkeypatch):
    """Twenty simulated seconds a run."""
    original = published.Overrides
    monkeypatch.setattr(
        published, "Overrides", lambda runs, sources=None: original(runs, ("swarm.time_cap=20",), sources)
    )


def study(*arguments):
    return exit_code(["study", "sequencing", "--out", "here", *arguments])


def test_the_design_is_table_1():
    text = resources.files("formicarium.systems.sequencing.published").joinpath("mark-i3-table-1.toml").read_text()
    rows = tomllib.loads(text)["rows"]
    assert [row["first_seed"] for row in rows] == [81001 + 100 * k for k in range(40)]
    assert [level_of(row["setting"], row["robots"]) for row in rows] == list(LEVELS) * 5


def test_figure_4_is_run_and_drawn_and_loaded_again(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    assert study("--figure", "4", "--collect-only") == 2
    assert "no run of this study" in capsys.readouterr().err
    assert study("--figure", "4", "--runs", "2", "--workers", "1") == 0
    assert "drawn from 2 of 2 runs" in capsys.readouterr().out
    picture = (tmp_path / "here" / "figure-4.png").read_bytes()
    assert study("--figure", "4", "--runs", "2", "--workers", "1") == 0
    assert "2 of them loaded" in capsys.readouterr().out
    assert (tmp_path / "here" / "figure-4.png").read_bytes() == picture
    assert study("--figure", "4", "--collect-only") == 1  # 28 of the paper's 30 are missing
    assert study("--figure", "4", "--sources", "0123456789abcdef") == 2


def test_an_unfinished_table_1_is_drawn_as_far_as_it_goes(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    designs = published._open("mark-i3-table-1", tmp_path / "here", published.Overrides(1))
    assert published.perform(designs._replace(jobs=designs.jobs[:3]), published.Request(workers=1)) == 0
    assert study("--collect-only") == 1
    assert "drawn from 3 of 1230 runs" in capsys.readouterr().out
    names = {path.name for path in (tmp_path / "here").iterdir() if path.is_file()}
    assert names == {"figure-4.png", "figure-5a.png", "figure-s18.png", "cells.csv", "report.md"}
    with (tmp_path / "here" / "cells.csv").open() as file:
        assert [row["runs"] for row in csv.DictReader(file)] == ["1"] * 3 + ["0"] * 37
    report = (tmp_path / "here" / "report.md").read_text()
    assert "3 runs in 3 of 40 cells" in report
    assert report.count(": not testable.**") == 6

"""``formicarium study coverage``: from its designs to its figures, made short."""

import tomllib
from importlib import resources

import pytest

from formicarium.commands import prominences
from formicarium.commands.main import exit_code
from formicarium.studies.prominences import table_1


def design(name):
    published = resources.files("formicarium.systems.coverage.published")
    return tomllib.loads((published / f"{name}.toml").read_text())


def test_every_design_has_twenty_seeds_of_its_own():
    designs = [design(name) for name in prominences.DESIGNS["all"]]
    assert all(found["replicates"] == 20 for found in designs)
    firsts = [found["first_seed"] for found in designs]
    assert len(set(firsts)) == len(firsts) and all(first % 1000 == 1 for first in firsts)


def test_the_designs_cover_what_the_paper_tables_and_announces():
    factors = design("coverage-table-1")["factors"]
    assert {cell.spacing for cell in table_1()} <= set(factors["behaviour.spacing"]) == {0.9, 1.2, 2.4, 2.75}
    assert {cell.backbone + 1 for cell in table_1()} <= set(factors["swarm.robots"])
    assert design("coverage-arms")["factors"]["tasks.count"] == [1, 3, 5]
    safe = design("coverage-safe")
    cells = len(safe["factors"]["behaviour.spacing"]) * len(safe["factors"]["swarm.robots"])
    assert cells * safe["replicates"] == 200


def test_the_papers_table_is_the_shared_one():
    assert len(table_1()) == 40 and sum(cell.latency is not None for cell in table_1()) == 21


def test_a_figure_runs_loads_and_draws(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setitem(prominences.DESIGNS, "laboratory", ("coverage-laboratory",))
    arguments = ["study", "coverage", "--figure", "laboratory", "--out", "here", "--runs", "1", "--workers", "1"]
    assert exit_code(arguments) == 0
    lines = (tmp_path / "here" / "coverage-laboratory.csv").read_text().splitlines()
    assert len(lines) == 5 and "never_parted" in lines[0]
    assert exit_code([*arguments, "--collect-only"]) == 0


def test_a_figure_of_another_study_is_refused(capsys):
    assert exit_code(["study", "coverage", "--figure", "S18"]) == 2
    assert "the study coverage has table-1, arms" in capsys.readouterr().err


@pytest.mark.parametrize("word", ["not reached", "backbone"])
def test_a_report_of_made_up_rows_says_what_was_not_reached(word):
    row = {"spacing_m": 1.2, "robots": 4, "variant": "faithful", "length_m": 2.0, "density_m": 1.0}
    row |= {f"latency_{target}_s": None for target in ("2r2", "3r2", "5r2", "10r2", "15r2")}
    text = prominences.report({"coverage-table-1": [row, row]})
    assert word in text and "0/2 | as in the paper" in text

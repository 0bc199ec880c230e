"""``formicarium connectivity`` and ``formicarium study connectivity``, as a person types them."""

import csv

import numpy as np
import pytest
from matplotlib.image import imread

from formicarium.commands import connectivity_study
from formicarium.commands.main import exit_code
from formicarium.studies.estimators import ESTIMATORS, GraphsTable, as_text, from_text


@pytest.fixture(autouse=True)
def folder(monkeypatch, tmp_path):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "edges.txt").write_text("0 1\n1 2\n2 3\n3 0\n3 4\n0 2\n")
    return tmp_path


def test_a_graph_is_told_exactly_and_estimated(folder, capsys):
    assert exit_code(["connectivity", "edges.txt", "--iterations", "300", "--drop", "0.1", "--runs", "2"]) == 0
    told = capsys.readouterr().out
    assert "0.829914" in told  # lambda2
    assert "0.565741" in told  # mu2
    out = folder / "formicarium-results" / "connectivity-edges"
    assert imread(out / "errors.png").std() > 0.01
    rows = list(csv.DictReader((out / "errors.csv").open()))
    assert len(rows) == 900
    assert {row["estimator"] for row in rows} == {"PI1", "PI2", "Wave"}


def test_author_mode_is_flagged_and_honest_mode_is_not(capsys):
    assert exit_code(["connectivity", "edges.txt", "--iterations", "50", "--mode", "author", "--method", "PI1"]) == 0
    assert "no robot can" in capsys.readouterr().out
    assert exit_code(["connectivity", "edges.txt", "--iterations", "50", "--method", "PI1"]) == 0
    assert "no robot can" not in capsys.readouterr().out


def test_a_graph_in_parts_is_told_and_not_estimated(folder, capsys):
    np.save(folder / "parts.npy", np.kron(np.eye(2), 1 - np.eye(2)))
    assert exit_code(["connectivity", "parts.npy"]) == 0
    assert "No graph is connected" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (["nowhere.txt"], "cannot read nowhere.txt"),
        (["edges.txt", "--drop", "1.5"], "--drop"),
        (["edges.txt", "--iterations", "0"], "--iterations 0"),
        (["edges.txt", "--runs", "0"], "--runs 0"),
        (["edges.txt", "--set", "windo=9"], "Did you mean window"),
        (["edges.txt", "--set", "window=2"], "at least 8"),
        (["edges.txt", "--at", "3"], "--at: only for a recorded run"),
        (["edges.txt", "--as", "positions"], "--range METRES"),
        (["edges.txt", "--range", "-1"], "--range -1"),
        (["edges.txt", "--as", "matrix"], "line 1: 2 values in a row of a matrix of 6 rows"),
        ([".", "--range", "1"], "holds no run"),
    ],
)
def test_what_cannot_be_is_said(words, told, capsys, folder):
    assert exit_code(["connectivity", *words]) == 2
    assert told in capsys.readouterr().err
    assert not (folder / "formicarium-results").exists()


def test_a_recorded_swarm_is_a_graph_at_every_frame(folder, capsys):
    made = ["run", "mark-i3", "--seed", "7", "--record", "--out", "seven", "--set", "time_cap=5", "--workers", "1"]
    assert exit_code(made) == 0
    words = ["connectivity", "seven", "--range", "0.6", "--iterations", "60", "--out", "here", "--at", "2"]
    assert exit_code(words) == 0
    assert "connected in" in capsys.readouterr().out
    assert (folder / "here" / "lambda2.png").exists()
    assert exit_code(["connectivity", "seven"]) == 2
    assert "--range METRES" in capsys.readouterr().err


def test_the_study_is_run_and_drawn(monkeypatch, folder, capsys):
    monkeypatch.setattr(connectivity_study, "SHORTER", ("length.iterations=120", "graphs.count=2"))
    monkeypatch.setattr(connectivity_study, "DESIGNS", ("connectivity-pi1",))
    assert exit_code(["study", "connectivity", "--collect-only", "--out", "here"]) == 2
    assert exit_code(["study", "connectivity", "--runs", "1", "--workers", "1", "--out", "here"]) == 0
    assert "drawn from 36 of 36 runs" in capsys.readouterr().out
    for name in ("figure-2.png", "figure-2-best.png"):
        assert imread(folder / "here" / name).std() > 0.01
    assert len((folder / "here" / "cells.csv").read_text().splitlines()) == 37
    report = (folder / "here" / "report.md").read_text()
    assert "| PI1, author* | directed |" in report
    assert "| PI1, honest | directed |" in report
    assert exit_code(["study", "connectivity", "--figure", "4"]) == 2
    assert "the study connectivity has 2, all, aboard" in capsys.readouterr().err
    assert exit_code(["study", "connectivity", "--reference", "nowhere"]) == 2
    assert "A10s.mat" in capsys.readouterr().err


def test_a_run_of_the_study_repeats_and_its_text_reads_back():
    parameters = ESTIMATORS.configure()
    parameters = parameters.model_validate(
        parameters.model_dump() | {"length": {"iterations": 50, "every": 10}, "graphs": {"count": 2}}
    )
    rows = [ESTIMATORS.run(parameters, seed).outcome for seed in (1, 1, 2)]
    assert rows[0] == rows[1] != rows[2]
    assert len(from_text(rows[0]["errors"])) == 5
    assert from_text(as_text(np.array([0.25, np.inf, 1e-7]))).tolist() == [0.25, np.inf, 1e-7]
    with pytest.raises(ValueError, match="not connected"):
        GraphsTable(given="B?")

"""Rows that are committed come out again."""

import csv
from pathlib import Path

import pytest

from formicarium.systems.registry import resolve

TABLES = Path(__file__).parents[2] / "docs" / "results" / "tables"


def value(text):
    """What a cell of a CSV file stands for."""
    try:
        return float(text)
    except ValueError:
        return text or None


@pytest.mark.parametrize("seed", [62001, 62004, 62007])
def test_a_row_of_the_sixth_freeze(seed):
    system = resolve("mark-i3")
    with (TABLES / "mark_i3_sixth_freeze.csv").open(newline="") as file:
        stored = next(row for row in csv.DictReader(file) if row["seed"] == str(seed))
    outcome = system.run(system.configure(), seed).outcome
    columns = [name for name in stored if name != "seed"]
    assert {name: outcome[name] for name in columns} == {name: value(stored[name]) for name in columns}

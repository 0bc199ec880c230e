"""What docs/results/mark_i4_ii3_ii4.md says of the runs, worked out again from the committed rows."""

import csv
import math
from collections import Counter
from pathlib import Path

import pytest
from scipy import stats

from formicarium.studies.mark_ii import FAULTS
from formicarium.systems.registry import resolve

TABLES = Path(__file__).parents[2] / "docs" / "results" / "tables"


def rows(name):
    with (TABLES / f"{name}.csv").open(newline="") as file:
        return list(csv.DictReader(file))


@pytest.mark.parametrize("mark, first, done", [("i4", 64001, 92), ("ii3", 65001, 96), ("ii4", 66001, 86)])
def test_all_hundred_listed_seeds_are_there_and_none_was_ended_early(mark, first, done):
    runs = rows(f"mark_{mark}_first_freeze")
    assert [int(run["seed"]) for run in runs] == list(range(first, first + 100))
    assert sum(run["success"] == "1" for run in runs) == done
    assert all(run["success"] == "1" or float(run["duration_s"]) == pytest.approx(100_000.0) for run in runs)
    assert all(not run.get("hopeless_s") for run in runs)


@pytest.mark.parametrize("mark, first, more, tasks", [("ii3", 67001, 60, 3), ("ii4", 68001, 80, 4)])
def test_the_search_finds_the_order_where_it_stands_and_it_stands_anywhere(mark, first, more, tasks):
    """TS-151: as many failed sequences as the UPI says in every loop without a fault; the UPI is uniform over m!."""
    others = rows(f"mark_{mark}_more_loops")
    assert [int(run["seed"]) for run in others] == list(range(first, first + more))
    loops = [run for run in rows(f"mark_{mark}_first_freeze") + others if run["time_elected_s"]]
    assert len(loops) >= 120
    for run in loops:
        if run["time_1_s"] and not any(int(run[fault]) for fault in FAULTS):
            assert run["failed_sequences"] == run["upi_correct"] == run["upi_found"]
    counted = Counter(int(run["upi_correct"]) for run in loops)
    assert stats.chisquare([counted[k] for k in range(math.factorial(tasks))]).pvalue > 0.05


@pytest.mark.parametrize(
    "table, system, seed",
    [
        ("mark_i3_sixth_freeze", "mark-i3", 62001),
        ("mark_i4_first_freeze", "mark-i4", 64001),
        ("mark_ii3_first_freeze", "mark-ii3", 65001),
    ],
)
def test_a_stored_row_comes_out_again(table, system, seed):
    """On the sources of today, in every column; what no run of a table fills is no column of it."""
    stored = next(row for row in rows(table) if row["seed"] == str(seed))
    found = resolve(system)
    again = dict(found.run(found.configure(), seed).outcome)
    again = {name: "" if value is None else str(value) for name, value in again.items()}
    assert {name: again[name] for name in stored if name != "seed"} == {n: v for n, v in stored.items() if n != "seed"}

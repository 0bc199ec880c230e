"""The coverage study on made-up runs: what counts as the paper's, and that no run is left out of a median."""

import math

import pytest

from formicarium.studies.prominence_figures import statements_safe, statements_table_1
from formicarium.studies.prominences import Published, median, table_1, table_1_rows, verdict


def runs(latency, count=5, **more):
    return [{"latency_3r2_s": latency, "length_m": 5.0, "losses_range": 0, **more} for _ in range(count)]


@pytest.mark.parametrize(
    ("paper", "ours", "word"),
    [
        (60.0, 30.0, "as in the paper"),
        (60.0, 19.0, "3.2 times sooner"),
        (60.0, None, "reached in the paper alone"),
        (None, None, "as in the paper"),
        (None, 50.0, "reached here alone"),
    ],
)
def test_a_cell_is_held_against_the_papers(paper, ours, word):
    assert verdict(Published(2.4, 3, "3r2", paper, None), runs(ours)) == word


def test_a_run_that_never_arrived_counts_as_infinitely_late():
    """Trap 14: medians are over all runs, never over the survivors."""
    rows = [*runs(10.0, 2), *runs(None, 3)]
    assert median(rows, "latency_3r2_s") == math.inf
    assert verdict(Published(2.4, 3, "3r2", 10.0, None), rows) == "reached in the paper alone"


def test_the_safe_variant_is_judged_by_every_step_and_every_cell():
    def cell(variant, length, losses):
        more = {"variant": variant, "spacing_m": 2.4, "robots": 11, "longest_loss_range_s": 2.0}
        return [
            row | {"length_m": length, "losses_range": losses, "lost_share_range": 0.1 * losses} | more
            for row in runs(1.0, 100)
        ]

    good = statements_safe([*cell("safe", 8.0, 0), *cell("faithful", 10.0, 1)])
    assert [s.verdict for s in good] == ["holds", "holds", "fails"]
    bad = statements_safe([*cell("safe", 7.0, 1), *cell("faithful", 10.0, 0)])
    assert [s.verdict for s in bad] == ["fails", "fails", "holds"]


def test_a_table_of_runs_like_the_papers_agrees_with_it():
    rows = []
    for spacing in (1.2, 2.4):
        for backbone in (3, 5, 10, 15, 20):
            row = {"spacing_m": spacing, "robots": backbone + 1, "length_m": backbone * spacing}
            for target in ("2r2", "3r2", "5r2", "10r2", "15r2"):
                row[f"latency_{target}_s"] = None
            for cell in table_1():
                if (cell.spacing, cell.backbone) == (spacing, backbone):
                    row[f"latency_{cell.target}_s"] = cell.latency
            rows.append(row)
    assert all(cell["verdict"] == "as in the paper" for cell in table_1_rows(rows))
    assert {s.verdict for s in statements_table_1(rows)} == {"holds"}

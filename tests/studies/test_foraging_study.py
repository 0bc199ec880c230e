"""The partitioning study on made-up runs: its figures and what the statements say of them."""

import itertools

import numpy as np
from matplotlib.image import imread

from formicarium.statistics.means import mean_of, welch
from formicarium.studies import foraging_anova
from formicarium.studies.foraging import TIMES, cells_of, share_by_hour
from formicarium.studies.foraging_claims import FAILS, HOLDS, OPEN, Runs, claims
from formicarium.studies.foraging_figures import figure_7, figure_8, figure_9, figure_10, figure_anova
from formicarium.views.charts import draw_chart


def row(method, time, objects, seed=1, **fields):
    whole, parts = 400.0, 60.0 + 3.0 * time
    made = {
        "method": method, "interfacing_time_s": time, "robots": 10, "duration_s": 60000.0, "consistent": 1,
        "objects_per_robot": objects, "seed": seed, "phantoms": 0, "lost": 0, "escapes": 0,
        "share_used": {"never": 0.0, "always": 1.0, "adaptive": 0.8 - time / 400}[method],
        "share_gave_up": 0.0,
        "share_corridor": {"never": 1.0, "always": 0.0, "adaptive": 0.2 + time / 400}[method],
        "whole_mean_s": whole, "harvest_mean_s": parts, "store_mean_s": parts,
        "harvest_sd_s": parts, "store_sd_s": parts,
    }  # fmt: skip
    for name in ("whole", "harvest", "store"):
        made |= {f"{name}_p{share}_s": 50.0 + share for share in (5, 25, 50, 75, 95)}
    return made | fields


def performance():
    return [
        row(
            method,
            t,
            {"never": 150.0, "always": 500.0 / (1 + t / 20), "adaptive": 400.0 - 1.2 * t}[method] + seed,
            seed,
        )
        for method in ("never", "always", "adaptive")
        for t in TIMES
        for seed in (1, 2)
    ]


def hours(used, corridor):
    return {"used_by_hour": used, "gave_up_by_hour": "0 " * 16 + "0", "corridor_by_hour": corridor}


def test_statements_are_found_true_or_false_or_left_open():
    verdicts = {claim.number: claim.verdict for claim in claims(Runs(performance()))}
    assert verdicts["AC-5"] == verdicts["AC-11"] == verdicts["AC-16"] == HOLDS
    assert verdicts["AC-17"] == verdicts["AC-22"] == verdicts["AC-28"] == OPEN
    turned = [r | {"objects_per_robot": 1.0} if r["method"] == "always" else r for r in performance()]
    assert {c.number: c.verdict for c in claims(Runs(turned))}["AC-5"] == FAILS


def test_a_reversal_is_one_when_the_cache_is_taken_more_often_than_not():
    up = row("adaptive", 0.0, 1.0, **hours("9 " * 8 + "5 " + "1 " * 8, "1 " * 8 + "5 " + "9 " * 8))
    down = row("adaptive", 200.0, 1.0, **hours("1 " * 8 + "5 " + "9 " * 8, "9 " * 8 + "5 " + "1 " * 8))
    rows = [up | {"cache.switched_time": 200.0}, down | {"cache.switched_time": 0.0}]
    verdicts = {claim.number: claim.verdict for claim in claims(Runs([], rows))}
    assert verdicts["AC-17"] == verdicts["AC-18"] == HOLDS
    assert share_by_hour(up)[0] == (0.9, 0.1)


def test_runs_with_phantoms_are_left_out_and_counted():
    rows = [row("always", 0.0, 400.0), row("always", 0.0, 100.0, consistent=0, phantoms=2)]
    (cell,) = cells_of(rows, ("method", "interfacing_time_s"))
    assert (cell["runs"], cell["excluded"], cell["phantoms"]) == (2, 1, 2)
    assert (cell["objects_per_robot"], cell["objects_per_robot_all_runs"]) == (400.0, 250.0)


def grid(alpha=10.0, turn=1.0, patience=-8.0, runs=3):
    """Return runs of Table 1's grid: what alpha gives, how S turns with Pi, what K and O give, and noise of 2."""
    draws, rows = np.random.default_rng(3), []
    for levels in itertools.product(*(values for _, values in foraging_anova.GRID.values())):
        time, a, s, k, o = levels
        mean = 250.0 - 0.5 * time + alpha * a + turn * s * (1.0 - time / 100.0) + patience * (k + 0.3 * o)
        for seed in range(runs):
            objects = mean + draws.normal(0.0, 2.0)
            rows.append(row("adaptive", time, objects, seed) | dict(zip(foraging_anova.GRID, levels, strict=True)))
    return rows


def verdicts_of(rows):
    return {claim.number: (claim.verdict, claim.finding) for claim in claims(Runs([], anova=rows))}


def test_the_effects_of_the_grid_are_found_with_their_size_and_sign():
    rows = grid()
    found = verdicts_of(rows)
    assert found["AC-27"][0] == found["AC-28"][0] == HOLDS and found["AC-26"][0] == OPEN
    effect = foraging_anova.difference(rows, "strategy.alpha", 1.0, 0.5, [(0.0, 1.0)])
    assert effect.low < 5.0 < effect.high and effect.high - effect.low < 2.0
    turn = foraging_anova.difference(rows, "strategy.steepness", 10.0, 0.5, [(0.0, 1.0), (200.0, -1.0)])
    assert turn.low < 19.0 < turn.high
    assert "best (-2.5, -9.0)" in found["AC-28"][1]


def test_the_other_way_round_they_fail_and_without_a_sign_they_stay_open():
    assert verdicts_of(grid(turn=-1.0))["AC-27"][0] == FAILS
    assert verdicts_of(grid(turn=0.0))["AC-27"][0] == OPEN
    assert verdicts_of(grid(patience=0.0))["AC-28"][0] == FAILS
    without = [r for r in grid() if r["cache.interfacing_time"] != 200.0]
    assert "runs are missing" in verdicts_of(without)["AC-27"][1]
    assert verdicts_of([])["AC-28"][0] == OPEN


def test_there_are_four_analyses_and_a_lost_run_makes_none_of_them_fail():
    rows = [r | {"consistent": int(k % 50 != 0)} for k, r in enumerate(grid())]
    studies = foraging_anova.analyses(rows)
    assert [study.cells for study in studies] == [243, 81, 81, 81]
    assert [len(study.analysis.terms) for study in studies] == [15, 10, 10, 10]
    assert all(study.spread_p > 1e-4 and abs(study.skewness) < 0.5 for study in studies)
    assert len(foraging_anova.table_of_terms(rows)) == 16 + 3 * 11
    assert sum("###" in line for line in foraging_anova.section(rows)) == 4


def test_every_figure_is_drawn(tmp_path):
    change = row("adaptive", 200.0, 1.0, **hours("1 " * 17, "3 " * 17)) | {"cache.switched_time": 0.0}
    charts = [draw(performance()) for draw in (figure_7, figure_8, figure_9)] + [
        figure_10([change]),
        figure_anova(grid()),
    ]
    for chart in charts:
        assert imread(draw_chart(chart, tmp_path / f"{chart.name}.png")).std() > 0.01


def test_means_have_students_interval():
    mean = mean_of([1.0, 2.0, 3.0])
    assert (mean.value, round(mean.high - mean.value, 3)) == (2.0, 2.484)
    assert welch([1.0, 1.1, 0.9], [2.0, 2.1, 1.9]) < 0.001
    assert welch([1.0], [2.0, 3.0]) == 1.0

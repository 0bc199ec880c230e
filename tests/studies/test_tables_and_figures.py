"""The published study on made-up runs: what the tables and the figures hold."""

import math

import pytest
from matplotlib.image import imread

from formicarium.campaigns import table
from formicarium.commands.campaign.answers import write_csv
from formicarium.statistics.lines import fit_line
from formicarium.studies.cells import LEVELS, VARIANTS, StudyCell, level_of
from formicarium.studies.figures import figure_4, figure_of_variant, figure_s18, figure_s19
from formicarium.studies.search import letter, sequences
from formicarium.studies.tables import TableError, compact, read_compact, table_of, table_s3, with_rows
from formicarium.systems.sequencing.study import published_run_times
from formicarium.views.sheets import draw_sheet
from formicarium.views.tree import draw_tree
from studies.made_up import TABLE_1, cell, design, run, study

ENDED_EARLY = {"swarm.idle_limit": 2000.0, "swarm.stall_limit": 30000.0}
FIRST_SEED = {"mark-i3": 81001, "mark-i4": 91001, "mark-ii3": 101001, "mark-ii4": 131001}


@pytest.mark.parametrize("variant", VARIANTS)
def test_the_designs_are_table_1(variant):
    found = design(variant)
    assert [row["first_seed"] for row in found["rows"]] == [FIRST_SEED[variant] + 100 * k for k in range(40)]
    assert [level_of(variant, row["setting"], row["robots"]) for row in found["rows"]] == list(LEVELS) * 5
    assert [levels[2] for levels in TABLE_1[variant]] == list(VARIANTS[variant].robots)
    assert (found["system"], found["replicates"]) == (variant, 30)
    assert found.get("set", {}) == ({} if variant == "mark-i3" else ENDED_EARLY)


def test_a_row_of_the_table_with_the_interval_of_wilson():
    """27 of 30: 0.74 to 0.97, as in section 14 of the ledger."""
    row = table_of([cell(0, 0, 27)])[0]
    assert (row["runs"], row["successes"], row["level"]) == (30, 27, "default")
    assert (row["low"], row["high"]) == (pytest.approx(0.744, abs=5e-4), pytest.approx(0.965, abs=5e-4))
    assert row["median_time_10_s"] == 1200.0
    assert row["causes"] == "3 runners stuck"
    assert table_of([cell(0, 0, 3)])[0]["median_time_10_s"] == math.inf
    assert table_of([cell(0, 0, 0, runs=0)])[0]["median_time_10_s"] is None


def test_ten_sequences_exactly_at_the_cap_are_no_success():
    late = run(True, 16, 2400.0) | {"time_10_s": 2400.0, "duration_s": 2400.0}
    assert StudyCell("mark-i3", 0, 0.9, 20, 2400.0, [late]).successes == 0


def test_a_compact_table_is_read_as_it_was_written(tmp_path):
    cells = [cell(0, 0, 1, runs=2, variant="mark-ii3"), cell(4, 100, 0, runs=1, variant="mark-ii3")]
    write_csv(table.from_rows(compact(cells)), tmp_path / "rows.csv")
    empty = [one._replace(runs=[]) for one in cells]
    back = with_rows(empty, read_compact(tmp_path / "rows.csv"))
    assert [one.successes for one in back] == [1, 0]
    assert compact(back) == compact(cells)
    assert table_of(back) == table_of(cells)


@pytest.mark.parametrize(
    "edit, words",
    [
        (lambda text: text.replace('"links"', '"chained"', 1), "has no column links"),
        (lambda text: text.replace("4,200,", "4,many,", 1), 'line 2, robots: "many" is not a number'),
        (lambda text: text.replace("4,200,", "4,1e999,", 1), 'line 2, robots: "1e999" is not a number'),
        (lambda text: text.replace("4,200,", "4,101,", 1), "setting 4 with 101 robots is no cell"),
        (lambda text: "", "has no column setting"),
    ],
)
def test_a_table_that_cannot_be_used_is_told_by_line_column_and_value(edit, words, tmp_path):
    path = tmp_path / "rows.csv"
    filled = cell(4, 100, 0, runs=1, variant="mark-ii3")
    write_csv(table.from_rows(compact([filled])), path)
    path.write_text(edit(path.read_text()))
    with pytest.raises(TableError, match=words):
        with_rows([filled], read_compact(path))


def test_table_s3_beside_ours():
    rows = table_s3(published_run_times(), cell(0, 0, 29, cap=7200.0))
    assert [row["run"] for row in rows] == [*map(str, range(1, 11)), "median"]
    assert (rows[0]["paper_time_10_s"], rows[8]["paper_time_10_s"]) == (1198.0, math.inf)
    assert rows[-1]["paper_time_10_s"] == 1458.0
    assert rows[0]["time_10_s"] == 1200.0


def test_a_line_through_points_on_it():
    line = fit_line([1, 2, 4], [3, 5, 9])
    assert (line.slope, line.intercept, line.r_squared) == pytest.approx((2, 1, 1))
    with pytest.raises(ValueError, match="at least 3"):
        fit_line([1, 2], [3, 5])


@pytest.mark.parametrize("runs", [0, 1])
def test_figures_survive_missing_cells(tmp_path, runs):
    cells = [cell(0, 0, 1, runs=runs), cell(1, 0, 0, runs=runs), *(cell(3, level, 0, runs=0) for level in LEVELS)]
    bases = [cell(0, 0, 1, runs=runs, variant=variant) for variant in VARIANTS]
    sheets = [figure_4(published_run_times(), bases), figure_of_variant(cells), figure_s18(cells), figure_s19(bases)]
    for sheet in sheets:
        assert imread(draw_sheet(sheet, tmp_path / f"{sheet.name}.png")).shape[2] == 4
    assert sheets[1].panels[0][2].note == "no runs yet, 57 robots"


def test_figure_4_holds_what_the_paper_shows():
    bases = [cell(0, 0, 29, cap=7200.0), *(cell(0, 0, 29, variant=variant) for variant in list(VARIANTS)[1:])]
    (robots, prolonged, four), (two_three, two_four) = figure_4(published_run_times(), bases).panels
    assert [curve.times.reached for curve in robots.curves] == [10, 10, 9]
    assert "Table S3" in robots.note
    assert (prolonged.end, four.end) == (7200.0, 100_000.0)
    assert [panel.ratios[0][1][:2] for panel in (prolonged, four, two_three, two_four)] == [
        (27, 30),
        (27, 30),
        (24, 30),
        (20, 30),
    ]
    assert "29/30" in prolonged.note
    assert [panel.limits[0][0] for panel in (two_three, two_four)] == [2000.0, 8000.0]


@pytest.mark.parametrize(("variant", "name"), [("mark-i3", "figure-5a"), ("mark-ii4", "figure-7b")])
def test_the_figures_of_a_variant_hold_what_the_paper_shows(variant, name):
    sheet = figure_of_variant(study(lambda _, level: 20, variant=variant))
    assert sheet.name == name
    assert [len(row) for row in sheet.panels] == [5, 5, 5]
    assert [panel.title[0] for row in sheet.panels for panel in row] == list("abcdefghijklmno")
    assert [curve.style for curve in sheet.panels[0][0].curves] == ["dotted", "dashdot", "solid"]
    assert all(len(panel.curves) == 8 for panel in sheet.panels[1])
    assert all(len(box.flagged) == 10 for panel in sheet.panels[2] for box in panel.boxes)
    assert sheet.panels[2][4].ticks == [str(robots) for robots in TABLE_1[variant][4]]


def test_figures_s18_and_s19_hold_what_the_paper_shows():
    line, label = figure_s18(study()).panels[0][0].line
    assert line.r_squared > 0.99
    assert f"R² = {line.r_squared:.3f}" in label
    sheet = figure_s19([cell(0, 0, 20, variant="mark-ii3"), cell(0, 0, 20, variant="mark-ii4", branch_links="4 4 3 4")])
    curves, boxes = sheet.panels[0][0].curves, sheet.panels[0][1].boxes
    assert [(curve.style, sheet.colours[curve.shade]) for curve in curves] == [
        ("dashed", "blue"),
        ("dotted", "blue"),
        ("dashed", "red"),
        ("dotted", "red"),
    ]
    assert [len(box.values) for box in boxes] == [90, 120]


def test_the_search_tries_the_orders_of_figure_s15():
    """a b c, a c b, b a c, b c a, c a b, c b a."""
    tried = ["".join(map(letter, order)) for order in sequences(3)]
    assert tried == ["abc", "acb", "bac", "bca", "cab", "cba"]
    assert len(set(sequences(4))) == 24


def test_a_guardian_knows_its_own_place_alone(tmp_path):
    assert imread(draw_tree("Fig. 6", sequences(3), letter, tmp_path / "six.png", own=2)).shape[2] == 4

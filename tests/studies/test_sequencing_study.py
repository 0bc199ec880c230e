"""The published study on made-up runs: what the table, the claims and the figures say of them."""

import math

import pytest
from matplotlib.image import imread

from formicarium.statistics.lines import fit_line
from formicarium.studies.cells import LEVELS, StudyCell, level_of, table_of
from formicarium.studies.claims import claims
from formicarium.studies.figures import figure_4, figure_5a, figure_s18
from formicarium.systems.sequencing.parameters import MARK_I3_TIME_CAPS
from formicarium.systems.sequencing.study import published_run_times
from formicarium.views.sheets import draw_sheet

TABLE_1 = (
    (16, 18, 20, 24, 28, 32, 36, 40),
    (23, 25, 28, 34, 39, 45, 50, 56),
    (32, 36, 40, 48, 56, 64, 72, 80),
    (45, 51, 57, 68, 80, 91, 103, 114),
    (64, 72, 80, 96, 112, 128, 144, 160),
)


def run(success, members, cap):
    """A run that did ten sequences at half its cap, or built a chain and did one."""
    half = cap / 2
    row = {"time_chain_s": 0.2 * half, "time_1_s": 0.4 * half, "time_5_s": None, "time_10_s": None, "duration_s": cap}
    row |= {"members": members, "members_at_completion": members, "cause": "runners stuck"}
    return row | {"time_5_s": 0.7 * half, "time_10_s": half, "duration_s": half, "cause": None} if success else row


def cell(setting, level, successes, runs=30, members=None, cap=None):
    side, cap = 0.9 * math.sqrt(2) ** setting, cap or MARK_I3_TIME_CAPS[setting]
    chain = 20 * side if members is None else members
    rows = [run(k < successes, chain, cap) for k in range(runs)]
    return StudyCell(setting, side, TABLE_1[setting][LEVELS.index(level)], cap, rows)


def study(successes=lambda setting, level: 28, **others):
    return [cell(k, level, successes(k, level), **others) for k in range(5) for level in LEVELS]


def verdicts(cells):
    return {claim.number: claim.verdict for claim in claims(cells)}


def finding(cells, number):
    return next(claim.finding for claim in claims(cells) if claim.number == number)


def test_every_cell_of_table_1_has_the_level_of_its_column():
    assert [[level_of(k, robots) for robots in row] for k, row in enumerate(TABLE_1)] == [list(LEVELS)] * 5


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
    assert StudyCell(0, 0.9, 20, 2400.0, [late]).successes == 0


def test_a_study_as_the_paper_tells_it_is_compatible():
    cells = study(lambda _, level: 28 if level >= 0 else 5)
    assert set(verdicts(cells).values()) == {"compatible"}
    tables = [math.comb(30, k) * math.comb(30, 33 - k) / math.comb(60, 33) for k in range(3, 31)]
    p_value = sum(p for p in tables if p <= tables[5 - 3] * (1 + 1e-9))  # as likely as 5 and 28, or less
    assert f"setting 0: 5/30 against 28/30, p {p_value:.2g}" in finding(cells, "R11b")
    assert "0.0 members + 20.0 per metre through the means of 5 arenas, R² = 1.000" in finding(cells, "R10")
    assert "spread 0%" in finding(cells, "R13")


def test_what_is_worse_is_called_worse():
    crowded = study(lambda _, level: 10 if level >= 20 else 28)
    assert verdicts(crowded)["R11a"] == verdicts(crowded)["R11c"] == "worse"
    told = "+100 %: 50/150 against 140/150 in 5 settings"
    assert told in finding(crowded, "R11c")
    slightly = study(lambda _, level: 23 if level == 100 else 28)  # clear only in all settings together
    assert "significantly lower in 0 of them" in finding(slightly, "R11c")
    assert verdicts(slightly)["R11c"] == "worse"
    assert verdicts(study(lambda setting, _: 28 - 6 * setting))["R9"] == "worse"
    bent = [cell(k, 0, 28, members=members) for k, members in enumerate((16, 16, 17, 18, 60))]
    assert verdicts(bent)["R10"] == "worse"
    growing = [cell(0, 0, 28, members=16), cell(0, 100, 28, members=32)]
    assert verdicts(growing)["R13"] == "worse"
    assert "16.0 to 32.0, spread 67%" in finding(growing, "R13")


def test_better_needs_a_clear_difference():
    assert verdicts(study(lambda _, level: 28))["R11b"] == "better"
    assert verdicts(study(lambda *_: 200, runs=200))["R9"] == "better"


def test_too_few_runs_are_not_tested():
    assert set(verdicts([])) == {"R9", "R10", "R11a", "R11b", "R11c", "R13"}
    for cells in ([], study(lambda *_: 9, runs=9)):
        assert set(verdicts(cells).values()) == {"not testable"}


def test_a_line_through_points_on_it():
    line = fit_line([1, 2, 4], [3, 5, 9])
    assert (line.slope, line.intercept, line.r_squared) == pytest.approx((2, 1, 1))
    with pytest.raises(ValueError, match="at least 3"):
        fit_line([1, 2], [3, 5])


@pytest.mark.parametrize("runs", [0, 1])
def test_figures_survive_missing_cells(tmp_path, runs):
    cells = [cell(0, 0, 1, runs=runs), cell(1, 0, 0, runs=runs), *(cell(3, level, 0, runs=0) for level in LEVELS)]
    sheets = [figure_4(published_run_times(), cell(0, 0, 1, runs=runs, cap=7200.0)), figure_5a(cells)]
    for sheet in [*sheets, figure_s18(cells)]:
        assert imread(draw_sheet(sheet, tmp_path / f"{sheet.name}.png")).shape[2] == 4
    assert sheets[1].panels[0][2].note == "no runs yet, 57 robots"


def test_the_figures_hold_what_the_paper_shows(tmp_path):
    cells = study(lambda _, level: 20)
    (robots, simulated), *_ = figure_4(published_run_times(), cell(0, 0, 29, cap=7200.0)).panels
    assert [curve.times.reached for curve in robots.curves] == [10, 10, 9]
    assert "Table S3" in robots.title
    assert simulated.end == 7200.0
    assert simulated.ratios[0][1][:2] == (27, 30)
    assert "0/30" in simulated.note  # the made-up runs take 3,600 s
    sheet = figure_5a(cells)
    assert [len(row) for row in sheet.panels] == [5, 5, 5]
    assert [panel.title[0] for row in sheet.panels for panel in row] == list("abcdefghijklmno")
    assert [curve.style for curve in sheet.panels[0][0].curves] == ["dotted", "dashdot", "solid"]
    assert all(len(panel.curves) == 8 for panel in sheet.panels[1])
    assert all(len(box.flagged) == 10 for panel in sheet.panels[2] for box in panel.boxes)
    assert sheet.panels[2][4].ticks == [str(robots) for robots in TABLE_1[4]]
    draw_sheet(sheet, tmp_path / "figure.png")
    line, label = figure_s18(cells).panels[0][0].line
    assert line.r_squared > 0.99
    assert f"R² = {line.r_squared:.3f}" in label

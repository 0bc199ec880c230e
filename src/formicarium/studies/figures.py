"""Figs 4, 5A and S18 of Garattoni & Birattari 2018 from our runs, the paper's own numbers beside them."""

from collections.abc import Mapping, Sequence

from formicarium.statistics.intervals import wilson
from formicarium.statistics.lines import fit_line
from formicarium.statistics.runtimes import run_times
from formicarium.studies.cells import LEVELS, PAPER_SUCCESS, TARGETS, StudyCell, by_setting, level_name
from formicarium.studies.sheet import Box, Curve, Panel, Sheet

STYLES = {1: "dotted", 5: "dashdot", 10: "solid"}
STYLE_KEY = [(style, f"{count} sequence{'s' * (count > 1)}") for count, style in STYLES.items()]
PAPER_CAP = 2400.0  # s, setting 0
TIME, SHARE = "time (s)", "share of runs"


def counted(cells: Sequence[StudyCell], wanted: int | None = None) -> str:
    """Say on how many runs a panel stands: "30 runs", "12 to 30 runs a cell, 7 of 8 cells"."""
    numbers = [len(cell.runs) for cell in cells if cell.runs]
    if not numbers:
        return "no runs yet"
    span = str(min(numbers)) if min(numbers) == max(numbers) else f"{min(numbers)} to {max(numbers)}"
    runs = f"{span} run{'s' * (max(numbers) > 1)}"
    if wanted is None:
        return runs
    return f"{runs} a cell" + (f", {len(numbers)} of {wanted} cells" if len(numbers) < wanted else "")


def figure_4(published: Mapping[str, Sequence[float]], prolonged: StudyCell) -> Sheet:
    """Return the paper's robot runs (A) beside ours, prolonged (B)."""
    theirs = [
        Curve(run_times(published[column], [PAPER_CAP] * len(published[column])), STYLES[count], band=count == 10)
        for column, count in TARGETS.items()
    ]
    robots = Panel(
        "A  The paper's e-pucks (its data, Table S3)",
        f"{len(published['time_10_s'])} runs, 20 robots",
        TIME, SHARE, theirs, end=PAPER_CAP,
    )  # fmt: skip
    note = counted([prolonged])
    if prolonged.runs:
        share = wilson(prolonged.reached(PAPER_CAP), len(prolonged.runs))
        note += f", {prolonged.robots} robots; ten sequences by {PAPER_CAP:,.0f} s: {share.successes}/{share.runs}"
        note += f" ({share.low:.0%} to {share.high:.0%})"
    simulated = Panel(
        f"B  Simulated here, prolonged to {prolonged.cap:,.0f} s", note, TIME, SHARE, _three_targets(prolonged),
        end=prolonged.cap, limits=[(PAPER_CAP, f"cap {PAPER_CAP:,.0f} s")],
        ratios=[(PAPER_CAP, wilson(*PAPER_SUCCESS), "paper, simulated: 27/30 by the cap, 95 % interval")],
    )  # fmt: skip
    return Sheet("figure-4", "Fig. 4: Mark I3, time to 1, 5 and 10 sequences", [[robots, simulated]], styles=STYLE_KEY)


def figure_5a(cells: Sequence[StudyCell]) -> Sheet:
    """Return scalability (a to e), robustness (f to j) and chain members (k to o) of Mark I3."""
    settings = {cell.setting: [other for other in cells if other.setting == cell.setting] for cell in cells}
    rows: list[list[Panel]] = [[], [], []]
    for k, (setting, all_cells) in enumerate(sorted(settings.items())):
        own = by_setting(all_cells).get(setting, {})
        place, cap = f"setting {setting}, side {all_cells[0].side:.2f} m", all_cells[0].cap
        default = own.get(0)
        curves = _three_targets(default) if default else []
        robots = next((f", {cell.robots} robots" for cell in all_cells if cell.level == 0), "")
        note = counted([default] if default else []) + robots
        rows[0].append(Panel(f"{chr(97 + k)}  {place}", note, TIME, SHARE, curves, end=cap))
        shaded = [(LEVELS.index(level), cell) for level, cell in own.items()]
        note = counted(list(own.values()), len(all_cells))
        curves = [Curve(cell.times(), shade=shade) for shade, cell in shaded]
        rows[1].append(Panel(f"{chr(102 + k)}  ten sequences", note, TIME, SHARE, curves, end=cap))
        boxes = [
            Box(shade, cell.members(), [float(run["members"]) for run in cell.runs if not cell.succeeded(run)], shade)
            for shade, cell in shaded
        ]
        numbers = {cell.level: str(cell.robots) for cell in all_cells}
        ticks = [numbers.get(level, "") for level in LEVELS]
        title = f"{chr(107 + k)}  chain at the end"
        rows[2].append(Panel(title, note, "robots", "chain members", boxes=boxes, ticks=ticks))
    return Sheet(
        "figure-5a",
        "Fig. 5A: Mark I3 in five arenas with few and many robots",
        rows,
        [level_name(level) for level in LEVELS],
        STYLE_KEY,
        "unsuccessful run",
    )


def figure_s18(cells: Sequence[StudyCell]) -> Sheet:
    """Return chain members against the side of the arena, with the default numbers of robots."""
    own = [levels[0] for levels in by_setting(cells).values() if levels.get(0)]
    measured = [(cell.side, cell.members("members_at_completion")) for cell in own]
    measured = [(side, values) for side, values in measured if values]
    boxes = [Box(side, values) for side, values in measured]
    line = None
    if len(measured) > 2:
        fit = fit_line([side for side, _ in measured], [sum(values) / len(values) for _, values in measured])
        line = (fit, f"{fit.slope:.1f} × side {fit.intercept:+.1f} through the means, R² = {fit.r_squared:.3f}")
    complete, runs = sum(len(values) for _, values in measured), sum(len(cell.runs) for cell in own)
    note = f"{complete} completed chains of {runs} runs, {len(own)} arenas" if runs else "no runs yet"
    panel = Panel("", note, "side of the arena (m)", "chain members at completion", boxes=boxes, line=line)
    return Sheet("figure-s18", "Fig. S18: chain members of Mark I3 and the side of the arena", [[panel]])


def _three_targets(cell: StudyCell) -> list[Curve]:
    if not cell.runs:
        return []
    return [Curve(cell.times(column), STYLES[count], band=count == 10) for column, count in TARGETS.items()]

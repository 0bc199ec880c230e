"""Figs 4, 5, 7, S18 and S19 of Garattoni & Birattari 2018 from our runs, the paper's own numbers beside them."""

from collections.abc import Mapping, Sequence

from formicarium.statistics.intervals import wilson
from formicarium.statistics.lines import fit_line
from formicarium.statistics.runtimes import run_times
from formicarium.studies.cells import LEVELS, NAMES, PAPER, TARGETS, VARIANTS, StudyCell, grid, level_name
from formicarium.studies.sheet import Box, Curve, Panel, Sheet

STYLES = {1: "dotted", 5: "dashdot", 10: "solid"}
STYLE_KEY = [(style, f"{count} sequence{'s' * (count > 1)}") for count, style in STYLES.items()]
SCALABILITY = {"mark-i3": "5A", "mark-i4": "5B", "mark-ii3": "7A", "mark-ii4": "7B"}
HALF_OF_THE_RUNS = {"mark-ii3": (2000.0, "paper: half before 2,000 s"), "mark-ii4": (8000.0, "half after 8,000 s")}
LONG = 20_000.0  # s; a longer axis of time is logarithmic,
FIRST = 100.0  # s, and begins here
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


def figure_4(published: Mapping[str, Sequence[float]], bases: Sequence[StudyCell]) -> Sheet:
    """Return the paper's robot runs (A) beside ours in the smallest arena (B to E; B prolonged)."""
    cap = VARIANTS["mark-i3"].time_caps[0]
    theirs = [
        Curve(run_times(published[column], [cap] * len(published[column])), STYLES[count], band=count == 10)
        for column, count in TARGETS.items()
    ]
    note = f"{len(published['time_10_s'])} runs, 20 robots: the paper's data, Table S3"
    robots = Panel("A  Mark I3, the paper's e-pucks", note, TIME, SHARE, theirs, end=cap)
    panels = [robots, *(_base(letter, cell) for letter, cell in zip("BCDE", bases))]
    title = "Fig. 4: time to 1, 5 and 10 sequences in the smallest arena"
    return Sheet("figure-4", title, [panels[:3], panels[3:]], styles=STYLE_KEY)


def _base(letter: str, cell: StudyCell) -> Panel:
    cap = VARIANTS[cell.variant].time_caps[0]
    note = f"{counted([cell])}, {cell.robots} robots"
    if cell.runs:
        share = wilson(cell.reached(cap), len(cell.runs))
        note += f"; ten by {cap:,.0f} s: {share.successes}/{share.runs} ({share.low:.0%} to {share.high:.0%})"
    limits = [(cap, f"cap {cap:,.0f} s")] if cap < cell.cap else []
    return Panel(
        f"{letter}  {NAMES[cell.variant]}, simulated here", note, TIME, SHARE, _three_targets(cell),
        start=_start(cell.cap), end=cell.cap, limits=[*limits, *filter(None, [HALF_OF_THE_RUNS.get(cell.variant)])],
        ratios=[(cap, wilson(*PAPER[cell.variant]), "paper: {}/{} by the cap".format(*PAPER[cell.variant]))],
    )  # fmt: skip


def figure_of_variant(cells: Sequence[StudyCell]) -> Sheet:
    """Return scalability (a to e), robustness (f to j) and chain members (k to o) of one variant: Figs 5 and 7."""
    variant = cells[0].variant
    settings = {cell.setting: [other for other in cells if other.setting == cell.setting] for cell in cells}
    rows: list[list[Panel]] = [[], [], []]
    for k, (setting, all_cells) in enumerate(sorted(settings.items())):
        own = grid(all_cells)[variant].get(setting, {})
        place, cap = f"setting {setting}, side {all_cells[0].side:.2f} m", all_cells[0].cap
        default = own.get(0)
        robots = next((f", {cell.robots} robots" for cell in all_cells if cell.level == 0), "")
        note = counted([default] if default else []) + robots
        curves = _three_targets(default) if default else []
        start = _start(cap)
        rows[0].append(Panel(f"{chr(97 + k)}  {place}", note, TIME, SHARE, curves, start=start, end=cap))
        shaded = [(LEVELS.index(level), cell) for level, cell in own.items()]
        note = counted(list(own.values()), len(all_cells))
        curves = [Curve(cell.times(), shade=shade) for shade, cell in shaded]
        rows[1].append(Panel(f"{chr(102 + k)}  ten sequences", note, TIME, SHARE, curves, start=start, end=cap))
        boxes = [
            Box(shade, cell.members(), [float(run["members"]) for run in cell.runs if not cell.succeeded(run)], shade)
            for shade, cell in shaded
        ]
        numbers = {cell.level: str(cell.robots) for cell in all_cells}
        ticks = [numbers.get(level, "") for level in LEVELS]
        title = f"{chr(107 + k)}  chain at the end"
        rows[2].append(Panel(title, note, "robots", "chain members", boxes=boxes, ticks=ticks))
    number = SCALABILITY[variant]
    title = f"Fig. {number}: {NAMES[variant]} in five arenas with few and many robots"
    shades = [level_name(level) for level in LEVELS]
    return Sheet(f"figure-{number.lower()}", title, rows, shades, (), STYLE_KEY, "unsuccessful run")


def figure_s18(cells: Sequence[StudyCell]) -> Sheet:
    """Return chain members of Mark I3 against the side of the arena, with the default numbers of robots."""
    own = [levels[0] for levels in grid(cells)["mark-i3"].values() if levels.get(0)]
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


def figure_s19(bases: Sequence[StudyCell]) -> Sheet:
    """Return Mark II3 beside Mark II4: chain and first sequence (A), links of a branch (B), in the smallest arena."""
    cells = [cell for cell in bases if VARIANTS[cell.variant].mark == 2]
    notes, curves, boxes = [], [], []
    for shade, cell in enumerate(cells):
        notes.append(f"{NAMES[cell.variant]} {counted([cell])}")
        if cell.runs:
            curves.append(Curve(cell.times("time_chain_s"), "dashed", shade))
            curves.append(Curve(cell.times("time_1_s"), "dotted", shade))
        if links := cell.links_of_branches:
            boxes.append(Box(shade, links, shade=shade))
    end = max((cell.cap for cell in cells), default=None)
    branches = f"{sum(len(box.values) for box in boxes)} branches of closed loops; guardians not counted"
    names = [NAMES[cell.variant] for cell in cells]
    panels = [
        Panel("A  Chain and first sequence", ", ".join(notes), TIME, SHARE, curves, start=FIRST / 2, end=end),
        Panel("B  Robots in a branch", branches, "", "links", boxes=boxes, ticks=names),
    ]
    keys = [("dashed", "chain complete"), ("dotted", "first sequence")]
    return Sheet(
        "figure-s19", "Fig. S19: Mark II3 and Mark II4 in the smallest arena", [panels], names, ("blue", "red"), keys
    )


def _three_targets(cell: StudyCell) -> list[Curve]:
    if not cell.runs:
        return []
    return [Curve(cell.times(column), STYLES[count], band=count == 10) for column, count in TARGETS.items()]


def _start(end: float) -> float:
    return FIRST if end > LONG else 0.0

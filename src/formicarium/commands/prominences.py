"""The published study of coverage: its campaigns joined to its tables and figures."""

from collections.abc import Callable, Sequence
from importlib import resources
from pathlib import Path

from rich.console import Console

from formicarium.campaigns import table
from formicarium.campaigns.files import replacing
from formicarium.campaigns.ledger import Ledger
from formicarium.campaigns.tidy import tidy
from formicarium.commands.campaign.answers import write_csv
from formicarium.commands.campaign.sitting import Request, perform
from formicarium.commands.campaign.study import Overrides, Study, open_study
from formicarium.commands.errors import UserError
from formicarium.studies import prominence_figures as figures
from formicarium.studies.chart import Chart
from formicarium.studies.missions import reach_rows
from formicarium.studies.prominences import Row, cells_of, table_1_rows

TABLE_1, ARMS, SAFE, DROPS = "coverage-table-1", "coverage-arms", "coverage-safe", "coverage-drops"
OCCLUSION, PICTURES = "coverage-occlusion", "coverage-figures"
LABORATORY, SCALE, TOURS = "coverage-laboratory", "coverage-scale", "coverage-tours"
PLANNING_RANGE = "coverage-planning-range"
DESIGNS = {
    "table-1": (TABLE_1,),
    "arms": (ARMS,),
    "safe": (SAFE,),
    "drops": (DROPS,),
    "occlusion": (OCCLUSION,),
    "4": (PICTURES,),
    "5": (PICTURES,),
    "laboratory": (LABORATORY,),
    "scale": (SCALE,),
    "tours": (TOURS,),
    "planning-range": (PLANNING_RANGE,),
    "all": (SAFE, TABLE_1, TOURS, ARMS, PICTURES, LABORATORY, DROPS, OCCLUSION, SCALE),
}
CHARTS: dict[str, tuple[Callable[[Sequence[Row]], Chart], str]] = {
    "table-1": (figures.figure_table_1, TABLE_1),
    "arms": (figures.figure_arms, ARMS),
    "safe": (figures.figure_safe, SAFE),
    "drops": (figures.figure_drops, DROPS),
    "occlusion": (figures.figure_occlusion, OCCLUSION),
    "scale": (figures.figure_scale, SCALE),
}
STATEMENTS = (
    (TABLE_1, figures.statements_table_1),
    (TABLE_1, figures.statements_density),
    (SAFE, figures.statements_safe),
    (DROPS, figures.statements_drops),
)
SHOWN = {"4": (3, 4), "5": (5,)}  # settings of the figures that are pictures of a swarm


def run_study(figure: str, folder: Path, runs: int | None, workers: int | None) -> int:
    """Run what the campaigns of a figure lack; return 0 if every run is done, 1 if some failed."""
    studies = [_open(name, folder, Overrides(runs)) for name in DESIGNS[figure]]
    return max(perform(study, Request(workers=workers)) for study in studies)


def draw_study(figure: str, folder: Path, runs: int | None, sources: str | None) -> int:
    """Write figures, a table of cells a campaign and report.md; return 0 if no run is missing, else 1.

    Raises:
        UserError: if no run is there.
        StoreError: if the folder cannot be read or written.
    """
    from formicarium.views.charts import draw_chart

    studies = {name: _open(name, folder, Overrides(runs, sources=sources)) for name in DESIGNS[figure]}
    rows = {name: tidy(Ledger(study.folder).rows(), study.jobs).to_pylist() for name, study in studies.items()}
    there = sum(map(len, rows.values()))
    if not there:
        raise UserError(f"{folder}: no run of this study is there in {' or '.join(studies)}. Run it first.")
    written = []
    for name in CHARTS if figure == "all" else [figure]:
        if name in CHARTS and rows[CHARTS[name][1]]:
            draw, campaign = CHARTS[name]
            written.append(draw_chart(draw(rows[campaign]), folder / f"figure-{name}.png"))
    for name, found in rows.items():
        if found:
            written.append(_write_table(cells_of(found, _factors(studies[name])), folder / f"{name}.csv"))
    if rows.get(TABLE_1):
        written.append(_write_table(table_1_rows(rows[TABLE_1]), folder / "table-1.csv"))
    if rows.get(PLANNING_RANGE):
        written.append(_write_table(reach_rows(rows[PLANNING_RANGE]), folder / "planning-range.csv"))
    for name in SHOWN if figure == "all" else [figure]:
        written += draw_swarms(name, folder) if name in SHOWN else []
    with replacing(folder / "report.md") as temporary:
        temporary.write_text(report(rows), encoding="utf-8")
    written.append(folder / "report.md")
    total = sum(study.total for study in studies.values())
    screen = Console()
    screen.print(f"[bold]coverage[/bold]: drawn from {there} of {total} runs", highlight=False)
    for path in written:
        screen.print(f"results   {path}", highlight=False, soft_wrap=True)
    return 0 if there == total else 1


def draw_swarms(figure: str, folder: Path) -> list[Path]:
    """Draw the last frame of the first run of the settings that a figure of the paper shows (Figs 4 and 5)."""
    from formicarium.commands.known import find_system
    from formicarium.views.frames import draw_frame

    system = find_system("coverage")
    seed = 157001
    paths = []
    for setting in SHOWN[figure]:
        trial = system.run(system.configure(setting), seed, frames_every=5.0)
        assert trial.frames is not None
        name = f"figure-{figure}{'ab'[setting - 3]}" if figure == "4" else f"figure-{figure}"
        paths.append(draw_frame(trial.scene, trial.frames, folder / f"{name}.png", title=f"coverage\nseed {seed}"))
    return paths


def report(rows: dict[str, list[Row]]) -> str:
    """Return in Markdown what the paper says, or what is asked for, and what our runs say."""
    counts = ", ".join(f"{name} {len(found)}" for name, found in rows.items())
    lines = ["# Coverage: what the paper says, and what is asked for", "", f"Runs: {counts}.", ""]
    lines += ["| statement | ours | verdict |", "|---|---|---|"]
    for campaign, statements in STATEMENTS:
        if rows.get(campaign):
            lines += [f"| {s.statement} | {s.finding} | {s.verdict} |" for s in statements(rows[campaign])]
    if rows.get(TABLE_1):
        lines += ["", "## Table I", "", "| δ (m) | backbone | target | the paper | reached, median | verdict |"]
        lines += ["|---|---|---|---|---|---|"]
        for cell in table_1_rows(rows[TABLE_1]):
            paper = "not reached" if cell["paper_s"] is None else f"{cell['paper_s']:.1f} s"
            ours = f"{cell['reached']}/{cell['runs']}"
            ours += f", {cell['median_s']:.1f} s" if cell["median_s"] is not None else ""
            target = cell["target"].replace("r", " √")
            lines.append(
                f"| {cell['spacing_m']:g} | {cell['backbone']} | {target} m | {paper} | {ours} | {cell['verdict']} |"
            )
    return "\n".join(lines) + "\n"


def _write_table(cells: list[dict], path: Path) -> Path:
    write_csv(table.from_rows(cells), path)
    return path


def _open(name: str, folder: Path, overrides: Overrides) -> Study:
    published = resources.files("formicarium.systems.coverage.published")
    with resources.as_file(published / f"{name}.toml") as path:
        return open_study(str(path), str(folder / name), overrides)


def _factors(study: Study) -> list[str]:
    columns = {
        "behaviour.variant": "variant",
        "behaviour.spacing": "spacing_m",
        "swarm.robots": "robots",
        "tasks.count": "tasks",
    }
    names = dict.fromkeys(columns.get(name, name) for job in study.jobs for name in job.cell.factors)
    return list(names)

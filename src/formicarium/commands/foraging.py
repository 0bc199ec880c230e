"""The published study of task partitioning: its campaigns joined to its tables and figures."""

from importlib import resources
from pathlib import Path

import numpy as np
from rich.console import Console

from formicarium.campaigns import table
from formicarium.campaigns.files import replacing
from formicarium.campaigns.ledger import Ledger
from formicarium.campaigns.tidy import tidy
from formicarium.commands.campaign.answers import write_csv
from formicarium.commands.campaign.sitting import Request, perform
from formicarium.commands.campaign.study import Overrides, Study, open_study
from formicarium.commands.errors import UserError
from formicarium.commands.replacements import with_replacements
from formicarium.commands.tables import events_of
from formicarium.studies import foraging_anova, foraging_hierarchy, foraging_options, foraging_tables
from formicarium.studies.foraging import Row, cells_of, picked
from formicarium.studies.foraging_claims import Claim, Runs, claims
from formicarium.studies.foraging_figures import (
    figure_7,
    figure_8,
    figure_9,
    figure_10,
    figure_11,
    figure_anova,
    figure_giving_up,
)
from formicarium.studies.foraging_hierarchy import figure_hierarchy
from formicarium.studies.foraging_options import figure_options

PERFORMANCE, ADAPTIVITY = "partitioning-performance", "partitioning-adaptivity"
SCALABILITY, GIVING_UP, THRESHOLD = "partitioning-scalability", "partitioning-giving-up", "partitioning-threshold"
PATIENT, ANOVA, OPTIONS = "partitioning-patient", "partitioning-anova", "partitioning-options"
HIERARCHY = "partitioning-hierarchy"
PERIODS = (10.0, 30.0)  # s, of the draws in the patient campaign
OF_THE_READING = ("AC-9", "AC-10", "AC-11", "AC-12", "AC-14", "AC-17", "AC-18", "AC-19", "AC-20")
ALL = (PERFORMANCE, ADAPTIVITY, SCALABILITY, GIVING_UP, THRESHOLD, PATIENT, ANOVA)
DRAWN = ("3", "4", "5", "6")  # from the implementation, without a run
DESIGNS = {
    **dict.fromkeys(DRAWN, ()),
    "7": (PERFORMANCE,),
    "8": (PERFORMANCE,),
    "9": (PERFORMANCE,),
    "10": (ADAPTIVITY,),
    "11": (SCALABILITY,),
    "giving-up": (GIVING_UP, THRESHOLD, PATIENT),
    "anova": (ANOVA,),
    "options": (OPTIONS,),
    "hierarchy": (HIERARCHY,),
    "all": ALL,
}
FIGURES = {
    "7": (figure_7, PERFORMANCE),
    "8": (figure_8, PERFORMANCE),
    "9": (figure_9, PERFORMANCE),
    "10": (figure_10, ADAPTIVITY),
    "11": (figure_11, SCALABILITY),
    "giving-up": (figure_giving_up, GIVING_UP),
    "anova": (figure_anova, ANOVA),
    "options": (figure_options, OPTIONS),
    "hierarchy": (figure_hierarchy, HIERARCHY),
}


def run_study(figure: str, folder: Path, runs: int | None, workers: int | None) -> int:
    """Run what the campaigns of a figure lack; return 0 if every run is done, 1 if some failed."""
    return max((_run(_open(name, folder, Overrides(runs)), workers) for name in DESIGNS[figure]), default=0)


def _run(study: Study, workers: int | None) -> int:
    """Run a campaign, then the next seeds of what is left out until nothing more is."""
    code, asked = perform(study, Request(workers=workers)), study.total
    while (grown := with_replacements(study)).total > asked:
        code, asked = perform(grown, Request(workers=workers)), grown.total
    return code


def draw_study(figure: str, folder: Path, runs: int | None, sources: str | None) -> int:
    """Write figures, a table of cells a campaign and report.md; return 0 if no run is missing, else 1.

    Raises:
        UserError: if no run is there.
        StoreError: if the folder cannot be read or written.
    """
    from formicarium.views.charts import draw_chart

    if figure in DRAWN:
        Console().print(f"results   {draw_implementation(figure, folder)}", highlight=False, soft_wrap=True)
        return 0
    opened = {name: _open(name, folder, Overrides(runs, sources=sources)) for name in DESIGNS[figure]}
    studies = {name: with_replacements(study) for name, study in opened.items()}
    rows = {name: _rows(study) for name, study in studies.items()}
    there = sum(map(len, rows.values()))
    if not there:
        raise UserError(f"{folder}: no run of this study is there in {' or '.join(studies)}. Run it first.")
    wanted = [name for name in FIGURES if FIGURES[name][1] in rows] if figure == "all" else [figure]
    written = [draw_implementation(name, folder) for name in DRAWN] if figure == "all" else []
    for name in wanted:
        draw, campaign = FIGURES[name]
        if rows[campaign]:
            written.append(draw_chart(draw(rows[campaign]), folder / f"figure-{name}.png"))
    for name, found in rows.items():
        if found:
            path = folder / f"{name}.csv"
            write_csv(table.from_rows(cells_of(found, _factors(studies[name]))), path)
            written.append(path)
    if rows.get(ANOVA):
        written += _write_anova(rows[ANOVA], folder)
    if rows.get(OPTIONS):
        written.append(_write_options(studies[OPTIONS], rows[OPTIONS], folder))
    if rows.get(HIERARCHY):
        written.append(_write("hierarchy", foraging_hierarchy.section(rows[HIERARCHY]), folder))
    if figure == "all":
        with replacing(folder / "report.md") as temporary:
            temporary.write_text(report(rows), encoding="utf-8")
        written.append(folder / "report.md")
    total = sum(study.total for study in studies.values())
    screen = Console()
    screen.print(f"[bold]partitioning[/bold]: drawn from {there} of {total} runs", highlight=False)
    for path in written:
        screen.print(f"results   {path}", highlight=False, soft_wrap=True)
    return 0 if there == total else 1


def _write_options(study: Study, rows: list[Row], folder: Path) -> Path:
    """Write what the options bring; their event logs are beside the rows."""
    ledger = Ledger(study.folder)
    keys = {(job.cell.number, key[1]): key for job in study.jobs for key in job.keys}

    def log(row: Row) -> np.ndarray:
        return events_of(table.read(ledger.table_path("events", keys[row["cell"], row["seed"]])), study.system.kinds)

    return _write("options", foraging_options.section(rows, log), folder)


def _write(name: str, lines: list[str], folder: Path) -> Path:
    """Write a block of Markdown into a file of its own; return the path."""
    path = folder / f"{name}.md"
    with replacing(path) as temporary:
        temporary.write_text("\n".join(_block(name, lines)) + "\n", encoding="utf-8")
    return path


def _block(name: str, lines: list[str]) -> list[str]:
    """Return lines with the marks by which ``docs/fill.py`` knows them."""
    return [f"<!-- block: {name} -->", *lines, "<!-- end of block -->"]


def draw_implementation(figure: str, folder: Path) -> Path:
    """Draw the state machine, an array of booths, a pair of the cache or the arena; return the path."""
    from formicarium.studies.foraging_machine import machine
    from formicarium.studies.foraging_plans import figure_4, figure_5, figure_6
    from formicarium.views.diagrams import draw_machine, draw_plans

    path = folder / f"figure-{figure}.png"
    if figure == "3":
        return draw_machine(machine(), path)
    return draw_plans({"4": figure_4, "5": figure_5, "6": figure_6}[figure](), path)


def report(rows: dict[str, list[Row]]) -> str:
    """Return in Markdown what the paper says, or what follows from it, and what our runs say.

    In blocks, which ``docs/fill.py`` puts into the page of results.
    """
    of = {name: rows.get(name, []) for name in ALL}
    blocks = {
        "runs": foraging_tables.runs_of(dict(of)),
        "objects per robot": foraging_tables.performance(of[PERFORMANCE]),
        "statements": _statements(claims(Runs(*(of[name] for name in (PERFORMANCE, ADAPTIVITY, SCALABILITY, ANOVA))))),
        "giving up": foraging_tables.giving_up(of[GIVING_UP], of[THRESHOLD]),
    }
    for period in PERIODS:
        blocks[f"statements, draw every {period:g} s"] = _statements(claims_of_reading(of, period))
    blocks |= {"sizes": foraging_tables.sizes(of[SCALABILITY]), "anova": foraging_anova.section(of[ANOVA])}
    lines = ["# Task partitioning: what the runs say"]
    for name, block in blocks.items():
        lines += ["", *_block(name, block)]
    return "\n".join(lines) + "\n"


def claims_of_reading(rows: dict[str, list[Row]], period: float) -> list[Claim]:
    """Return the statements that patience can change, with the references and draws of P_g so long apart."""
    chosen = picked(rows[PATIENT], strategy__giveup_draw_period=period)
    references = [row for row in rows[PERFORMANCE] if row["method"] != "adaptive"]
    steady = [row for row in chosen if row["cache.switched_time"] == row["interfacing_time_s"]]
    return [claim for claim in claims(Runs([*references, *steady], chosen)) if claim.number in OF_THE_READING]


def _statements(found: list[Claim]) -> list[str]:
    lines = ["| | statement | ours | verdict |", "|---|---|---|---|"]
    return lines + [f"| {c.number} | {c.statement} | {c.finding} | {c.verdict} |" for c in found]


def _write_anova(rows: list[Row], folder: Path) -> list[Path]:
    """Write the terms of the four analyses, if the runs are enough for them."""
    try:
        terms = foraging_anova.table_of_terms(rows)
    except ValueError:
        return []
    write_csv(table.from_rows(terms), folder / "anova.csv")
    return [folder / "anova.csv"]


def _open(name: str, folder: Path, overrides: Overrides) -> Study:
    published = resources.files("formicarium.systems.partitioning.published")
    with resources.as_file(published / f"{name}.toml") as path:
        return open_study(str(path), str(folder / name), overrides)


def _factors(study: Study) -> list[str]:
    columns = {"strategy.method": "method", "cache.interfacing_time": "interfacing_time_s", "swarm.robots": "robots"}
    names = dict.fromkeys(columns.get(name, name) for job in study.jobs for name in job.cell.factors)
    return list(names)


def _rows(study: Study) -> list[Row]:
    return tidy(Ledger(study.folder).rows(), study.jobs).to_pylist()

"""The published study of task sequencing: its campaigns joined to its tables and figures."""

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
from formicarium.studies.cells import StudyCell, table_of
from formicarium.studies.claims import LEAST_RUNS, claims
from formicarium.studies.figures import figure_4, figure_5a, figure_s18
from formicarium.studies.sheet import Sheet

PROLONGED, TABLE_1 = "mark-i3-figure-4b", "mark-i3-table-1"
DESIGNS = {"4": (PROLONGED,), "5": (TABLE_1,), "S18": (TABLE_1,), "all": (PROLONGED, TABLE_1)}


def run_study(figure: str, folder: Path, runs: int | None, workers: int | None) -> int:
    """Run what the campaigns of a figure lack; return 0 if every run is done, 1 if some failed."""
    studies = [_open(name, folder, Overrides(runs)) for name in DESIGNS[figure]]
    return max(perform(study, Request(workers=workers)) for study in studies)


def draw_study(figure: str, folder: Path, runs: int | None, sources: str | None) -> int:
    """Write figures, cells.csv and report.md from the runs that are there; return 0 if none is missing, else 1.

    Raises:
        UserError: if no run is there.
        StoreError: if the folder cannot be read or written.
    """
    from formicarium.views.sheets import draw_sheet

    studies = {name: _open(name, folder, Overrides(runs, sources=sources)) for name in DESIGNS[figure]}
    cells = {name: _cells(study) for name, study in studies.items()}
    there = sum(len(cell.runs) for group in cells.values() for cell in group)
    if not there:
        words = f" and sources {sources}" if sources else ""
        raise UserError(f"{folder}: no run of this study{words} is there in {' or '.join(cells)}. Run it first.")
    written = [draw_sheet(sheet, folder / f"{sheet.name}.png") for sheet in _sheets(figure, studies, cells)]
    if TABLE_1 in cells:
        write_csv(table.from_rows(table_of(cells[TABLE_1])), folder / "cells.csv")
        with replacing(folder / "report.md") as temporary:
            temporary.write_text(report(cells[TABLE_1]), encoding="utf-8")
        written += [folder / "cells.csv", folder / "report.md"]
    total = sum(study.total for study in studies.values())
    screen = Console()
    screen.print(f"[bold]sequencing[/bold]: drawn from {there} of {total} runs", highlight=False)
    for path in written:
        screen.print(f"results   {path}", highlight=False, soft_wrap=True)
    return 0 if there == total else 1


def report(cells: list[StudyCell]) -> str:
    """Return in Markdown what the paper says and what our runs say to it."""
    there, full = sum(len(cell.runs) for cell in cells), sum(len(cell.runs) >= LEAST_RUNS for cell in cells)
    lines = [
        "# Mark I3: scalability and robustness",
        "",
        f"{there} runs in {sum(bool(cell.runs) for cell in cells)} of {len(cells)} cells of Table 1 "
        f"(Garattoni & Birattari 2018); the {full} cells with {LEAST_RUNS} runs or more are tested.",
        "",
        "Level 5 %; p-values of several settings are adjusted together (Holm) for the verdict. Compatible: these runs "
        "do not contradict the paper, which is less than proving it right.",
    ]
    for claim in claims(cells):
        lines += ["", f"**{claim.number}: {claim.verdict}.** The paper: {claim.statement}. Ours: {claim.finding}."]
    return "\n".join(lines) + "\n"


def _open(name: str, folder: Path, overrides: Overrides) -> Study:
    published = resources.files("formicarium.systems.sequencing.published")
    with resources.as_file(published / f"{name}.toml") as path:
        return open_study(str(path), str(folder / name), overrides)


def _cells(study: Study) -> list[StudyCell]:
    rows = tidy(Ledger(study.folder).rows(), study.jobs).to_pylist()
    cells = []
    for job in study.jobs:
        parameters = job.configuration.parameters
        cells.append(
            StudyCell(
                job.cell.factors["setting"],
                parameters["arena"]["side"],
                parameters["swarm"]["robots"],
                parameters["swarm"]["time_cap"],
                [row for row in rows if row["cell"] == job.cell.number],
            )
        )
    return cells


def _sheets(figure: str, studies: dict[str, Study], cells: dict[str, list[StudyCell]]) -> list[Sheet]:
    sheets = []
    if figure in ("4", "all"):
        published = studies[PROLONGED].system.targets.published
        sheets.append(figure_4(published, cells[PROLONGED][0]))
    if figure in ("5", "all"):
        sheets.append(figure_5a(cells[TABLE_1]))
    if figure in ("S18", "all"):
        sheets.append(figure_s18(cells[TABLE_1]))
    return sheets

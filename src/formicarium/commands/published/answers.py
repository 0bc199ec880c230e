"""Figures, tables and report of the published study, from the runs that are there."""

from pathlib import Path

from rich.console import Console

from formicarium.campaigns import table
from formicarium.commands.campaign.answers import write_csv
from formicarium.commands.campaign.sitting import Request, perform
from formicarium.commands.errors import UserError
from formicarium.commands.published import checks, pictures, store
from formicarium.commands.published.store import NEEDS, PROLONGED, TABLES, Asked
from formicarium.studies.cells import NAMES, VARIANTS, StudyCell, grid
from formicarium.studies.document import Picture
from formicarium.studies.figures import SCALABILITY, figure_4, figure_of_variant, figure_s18, figure_s19
from formicarium.studies.report import report
from formicarium.studies.sheet import Sheet
from formicarium.studies.tables import TableError, compact, read_compact, table_of, table_s3, with_rows
from formicarium.studies.traps import checks as look_for_traps
from formicarium.systems.sequencing.study import published_run_times

Cells = dict[str, list[StudyCell]]  # design -> its cells


def run_study(asked: Asked) -> int:
    """Run what the campaigns of a figure lack; return 0 if every run is done, 1 if some failed."""
    parts = NEEDS.get(asked.figure, [])
    code = max((perform(store.needed(part, asked), Request(workers=asked.workers)) for part in parts), default=0)
    if asked.figure in ("2", "all"):
        code = max(code, pictures.run_snapshots(asked.folder, asked.workers))
    return code


def check_study(asked: Asked, one_in: int) -> int:
    """Run one in so many of the runs that are there again, in all cells of a figure's campaigns; return as above."""
    designs = [part.design for part in NEEDS.get(asked.figure, []) if part.design != PROLONGED]
    return checks.run_checks([store.open_design(name, asked) for name in designs], one_in, asked.workers)


def draw_study(asked: Asked) -> int:
    """Write figures, tables and report from the runs that are there; return 0 if none is missing, else 1.

    Raises:
        UserError: if no run is there.
        StoreError: if the folder cannot be read or written.
    """
    from formicarium.views.sheets import draw_sheet

    studies = {name: store.open_design(name, asked) for name in (PROLONGED, *TABLES.values())}
    cells: Cells = {name: _cells(name, study, asked) for name, study in studies.items()}
    parts = NEEDS.get(asked.figure, [])
    wanted = [cell for part in parts for cell in cells[part.design] if store.is_asked(cell, part, asked)]
    there = sum(len(cell.runs) for cell in wanted)
    total = sum(store.needed(part, asked).total for part in parts)
    if parts and not there:
        if asked.tables is not None:
            raise UserError(f"{asked.tables}: no table of this figure is there, for example {_file(parts[0].design)}.")
        words = f" and sources {', '.join(asked.sources)}" if asked.sources else ""
        raise UserError(f"{asked.folder}: no run of this study{words} is there. Run it first.")
    drawn = [figure for figure in pictures.DRAWN if asked.figure in (figure, "all")]
    if asked.figure == "all" and not pictures.snapshots_are_there(asked.folder):
        drawn.remove("2")
    written = [pictures.draw(figure, asked.folder) for figure in drawn]
    written += [draw_sheet(sheet, asked.folder / f"{sheet.name}.png") for sheet in _sheets(asked.figure, cells)]
    if parts:
        written += _write_tables(asked.folder, cells)
        written += _write_report(asked, studies, cells)
    screen = Console()
    screen.print(f"[bold]sequencing[/bold]: drawn from {there} of {total} runs", highlight=False)
    for path in written:
        screen.print(f"results   {path}", highlight=False, soft_wrap=True)
    return 0 if there == total else 1


def _cells(name: str, study: store.Study, asked: Asked) -> list[StudyCell]:
    if asked.tables is None:
        return store.cells_of(study)
    path = asked.tables / _file(name)
    empty = [store.empty_cell(study, job) for job in study.jobs]
    try:
        return with_rows(empty, read_compact(path)) if path.exists() else empty
    except TableError as error:
        raise UserError(f'{path}: {error}. A study writes such tables into "tables"; take one of those.') from error


def _file(design: str) -> str:
    return f"{design.replace('-', '_')}.csv"


def _table_1(cells: Cells) -> list[StudyCell]:
    """Return the 160 cells; where Mark I3 has no run of its base cell, the prolonged runs up to the paper's cap."""
    found = [cell for design in TABLES.values() for cell in cells[design]]
    base = grid(store.cut(cells[PROLONGED]))["mark-i3"].get(0, {}).get(0)
    return [
        base if base and store.is_base(cell) and cell.variant == "mark-i3" and not cell.runs else cell for cell in found
    ]


def _sheets(figure: str, cells: Cells) -> list[Sheet]:
    bases = cells[PROLONGED] + [
        cell for name in list(TABLES.values())[1:] for cell in cells[name] if store.is_base(cell)
    ]
    sheets = []
    if figure in ("4", "all"):
        sheets.append(figure_4(published_run_times(), bases))
    for variant, number in SCALABILITY.items():
        if figure in (number[:1], "all"):
            sheets.append(figure_of_variant(cells[TABLES[variant]]))
    if figure in ("S18", "all"):
        sheets.append(figure_s18(cells[TABLES["mark-i3"]]))
    if figure in ("S19", "all"):
        sheets.append(figure_s19(bases))
    return sheets


def _write_tables(folder: Path, cells: Cells) -> list[Path]:
    everything = _table_1(cells)
    tables = {"cells.csv": table_of(everything)}
    base = grid(everything)["mark-i3"].get(0, {}).get(0)
    if base:
        tables["table-s3.csv"] = table_s3(published_run_times(), base)
    for design, own in cells.items():
        if rows := compact(own):
            tables[f"tables/{_file(design)}"] = rows
    for name, rows in tables.items():
        write_csv(table.from_rows(rows), folder / name)
    return [folder / name for name in tables]


def _write_report(asked: Asked, studies: dict[str, store.Study], cells: Cells) -> list[Path]:
    from formicarium.views.pages import write_html, write_markdown

    found = []
    for variant in VARIANTS:
        name = TABLES[variant]
        if asked.tables is None and any(cell.runs for cell in cells[name]):
            sources = studies[name].jobs[0].configuration.sources if asked.sources else None
            found += look_for_traps(checks.stored(studies[name], cells[name], sources))
    figures = [Picture(path, _caption(path)) for path in sorted(asked.folder.glob("figure-*.png"))]
    blocks = report(_table_1(cells), published_run_times(), found, figures)
    return [write_markdown(blocks, asked.folder / "report.md"), write_html(blocks, asked.folder / "report.html")]


def _caption(path: Path) -> str:
    number = path.stem.removeprefix("figure-").upper()
    variant = next((NAMES[name] for name, own in SCALABILITY.items() if own == number), "")
    return f"Fig. {number}{f': {variant}' if variant else ''}"

"""The study of estimators on the messages of an eruption: its campaign joined to a table and a figure (ST-73)."""

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
from formicarium.studies.estimators_aboard import cells_of, figure_of, report

DESIGN = "estimators-aboard"
SHORTER: tuple[str, ...] = ()  # settings that tests add


def run_study(folder: Path, runs: int | None, workers: int | None) -> int:
    """Run what the campaign lacks; return 0 if every run is done, 1 if some failed."""
    return perform(_study(folder, runs, None), Request(workers=workers))


def draw_study(folder: Path, runs: int | None, sources: str | None) -> int:
    """Write figure, table of cells and report.md; return 0 if no run is missing, else 1.

    Raises:
        UserError: if no run is there.
        StoreError: if the folder cannot be read or written.
    """
    from formicarium.views.curves import draw_curves

    study = _study(folder, runs, sources)
    rows = tidy(Ledger(study.folder).rows(), study.jobs).to_pylist()
    if not rows:
        raise UserError(f"{folder}: no run of this study is there in {DESIGN}. Run it first.")
    cells = cells_of(rows)
    write_csv(table.from_rows(cells), folder / "aboard.csv")
    with replacing(folder / "aboard.md") as temporary:
        temporary.write_text(report(cells), encoding="utf-8")
    written = [draw_curves(figure_of(rows), folder / "aboard.png"), folder / "aboard.csv", folder / "aboard.md"]
    screen = Console()
    screen.print(f"[bold]{DESIGN}[/bold]: drawn from {len(rows)} of {study.total} runs", highlight=False)
    for path in written:
        screen.print(f"results   {path}", highlight=False, soft_wrap=True)
    return 0 if len(rows) == study.total else 1


def _study(folder: Path, runs: int | None, sources: str | None) -> Study:
    published = resources.files("formicarium.studies.published")
    with resources.as_file(published / f"{DESIGN}.toml") as path:
        return open_study(str(path), str(folder / DESIGN), Overrides(runs, SHORTER, sources))

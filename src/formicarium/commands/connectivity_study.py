"""The published study of estimators (Fig. 2 of Panerati et al. 2018): campaigns joined to figures and table."""

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
from formicarium.connectivity.files import GraphError, read_graphs
from formicarium.connectivity.graphs import to_graph6
from formicarium.studies.estimator_figures import LOSSES, Published, figure_2, figure_best, report, table_of_cells

DESIGNS = ("connectivity-pi1", "connectivity-pi2", "connectivity-wave")
FIGURES = ("2", "all")
MATRICES = "A10s.mat"  # the published graphs; the curves are of the first ten (ST-3)
CURVES = {"PI1": "bertrand", "PI2": "dilorenzo", "Wave": "sahai"}
PUBLISHED_GRAPHS = 10
SHORTER: tuple[str, ...] = ()  # settings that tests add


def run_study(folder: Path, runs: int | None, workers: int | None, reference: str | None) -> int:
    """Run what the campaigns lack; return 0 if every run is done, 1 if some failed."""
    return max(perform(study, Request(workers=workers)) for study in _studies(folder, runs, reference, None))


def draw_study(folder: Path, runs: int | None, reference: str | None, sources: str | None) -> int:
    """Write figures, the table of cells and report.md; return 0 if no run is missing, else 1.

    Raises:
        UserError: if no run is there.
        StoreError: if the folder cannot be read or written.
    """
    from formicarium.views.curves import draw_curves

    studies = _studies(folder, runs, reference, sources)
    rows = [row for study in studies for row in tidy(Ledger(study.folder).rows(), study.jobs).to_pylist()]
    if not rows:
        raise UserError(f"{folder}: no run of this study is there in {' or '.join(DESIGNS)}. Run it first.")
    every = studies[0].jobs[0].configuration.parameters["length"]["every"]
    cells = table_of_cells(rows, every)
    written = [
        draw_curves(figure_2(rows, every, _published(reference)), folder / "figure-2.png"),
        draw_curves(figure_best(rows, every), folder / "figure-2-best.png"),
        folder / "cells.csv",
        folder / "report.md",
    ]
    write_csv(table.from_rows(cells), folder / "cells.csv")
    with replacing(folder / "report.md") as temporary:
        temporary.write_text(report(cells), encoding="utf-8")
    total = sum(study.total for study in studies)
    screen = Console()
    screen.print(f"[bold]connectivity[/bold]: drawn from {len(rows)} of {total} runs", highlight=False)
    for path in written:
        screen.print(f"results   {path}", highlight=False, soft_wrap=True)
    return 0 if len(rows) == total else 1


def _studies(folder: Path, runs: int | None, reference: str | None, sources: str | None) -> list[Study]:
    settings = SHORTER
    if reference is not None:
        settings += (f"graphs.given={_given(Path(reference))}",)
    overrides = Overrides(runs, settings, sources)
    published = resources.files("formicarium.studies.published")
    found = []
    for name in DESIGNS:
        with resources.as_file(published / f"{name}.toml") as path:
            found.append(open_study(str(path), str(folder / name), overrides))
    return found


def _given(reference: Path) -> str:
    """Return the published graphs as text."""
    try:
        graphs = read_graphs(reference / MATRICES)[:PUBLISHED_GRAPHS]
    except GraphError as error:
        raise UserError(f"--reference {reference}: {error}") from error
    return " ".join(to_graph6(graph.adjacency) for graph in graphs)


def _published(reference: str | None) -> Published:
    """Return the paper's own curves, those that are there."""
    found = {}
    for method, name in CURVES.items():
        for drop in LOSSES:
            path = Path(reference or "") / f"errorvssteps-{name}-1-{drop:g}.dat"
            if reference is not None and path.exists():
                try:
                    values = np.loadtxt(path, skiprows=1, ndmin=2)
                    found[method, drop] = (values[:, 0], values[:, 1])
                except (ValueError, IndexError) as error:
                    raise UserError(f"{path} is no table of a published curve: {error}") from error
    return found

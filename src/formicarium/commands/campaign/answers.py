"""The tables and figures of a campaign."""

from pathlib import Path
from typing import Any

import pyarrow as pa
from rich.console import Console
from rich.table import Table

from formicarium.campaigns import lock, table
from formicarium.campaigns.cells import Job
from formicarium.campaigns.files import replacing
from formicarium.campaigns.ledger import Ledger
from formicarium.campaigns.tidy import tidy
from formicarium.commands.campaign.screen import wide_console
from formicarium.commands.campaign.standing import other_rows
from formicarium.commands.campaign.study import Study, factor_names
from formicarium.commands.errors import UserError
from formicarium.commands.summary import END, measured, published
from formicarium.statistics.intervals import wilson
from formicarium.statistics.runtimes import in_words


def write_answers(study: Study, figures: bool) -> int:
    """Write runs.parquet, runs.csv, cells.csv and, if asked for, figures; return the exit code.

    Raises:
        UserError: if no run of the design is done.
        StoreError: if the folder cannot be read or written.
    """
    ledger = Ledger(study.folder)
    rows = tidy(ledger.rows(), study.jobs)
    trouble, screen = Console(stderr=True), wide_console()
    for name, reason in ledger.damaged.items():
        path = study.folder / "parts" / name
        trouble.print(f"formicarium: {path} is damaged ({reason}): its runs are missing here. Run the campaign again.",
                      highlight=False, soft_wrap=True, markup=False)  # fmt: skip
    if not len(rows):
        ledger.refresh()
        besides = "".join(f"; it holds {count} rows {reason}" for reason, count in other_rows(study, ledger).items())
        raise UserError(
            f"{study.folder}: no run of this design is done{besides}. "
            f"Start with: formicarium campaign run {study.source}{study.options}"
        )
    summary, shown = _summaries(study, rows)
    with lock.held(study.folder / lock.NAME):  # another terminal may be collecting too
        table.write(rows, study.folder / "runs.parquet")
        write_csv(rows, study.folder / "runs.csv")
        write_csv(table.from_rows(summary), study.folder / "cells.csv")
    pictures = _draw(study, rows) if figures else []
    screen.print(f"[bold]{study.design.name}[/bold]: {len(rows)} of {study.total} runs", highlight=False)
    screen.print(shown)
    for path in [study.folder / name for name in ("runs.parquet", "runs.csv", "cells.csv")] + pictures:
        screen.print(f"results   {path}", highlight=False, soft_wrap=True)
    return 0 if len(rows) == study.total else 1


def write_csv(rows: pa.Table, path: Path) -> None:
    """Write a table as CSV, whole; what is missing is empty."""
    from pyarrow import csv

    with replacing(path) as temporary, pa.OSFile(str(temporary), "wb") as file:  # given a path it would start a thread
        csv.write_csv(rows, file)


def _outcomes(study: Study, rows: pa.Table, job: Job) -> list[dict[str, Any]]:
    """Return what run times are made of, of the runs of a cell."""
    import pyarrow.compute as pc

    names = [name for name in (END, *study.system.targets.columns) if name in rows.column_names]
    return rows.select(names).filter(pc.equal(rows["cell"], job.cell.number)).to_pylist()


def _summaries(study: Study, rows: pa.Table) -> tuple[list[dict[str, Any]], Table]:
    factors = factor_names(study.jobs)
    shown = Table(box=None, pad_edge=False, padding=(0, 2, 0, 0))
    for title in ["cell", *factors, "runs"]:
        shown.add_column(title, justify="left" if title in factors else "right")
    for label in study.system.targets.columns.values():
        shown.add_column(f"{label}: share", justify="right")
        shown.add_column("median", justify="right")
    summary = []
    for job in study.jobs:
        own = _outcomes(study, rows, job)
        row: dict[str, Any] = {"cell": job.cell.number, **job.cell.factors, "runs": len(own)}
        cells = [str(job.cell.number), *(str(job.cell.factors.get(name, "")) for name in factors), str(len(own))]
        columns = {label: column for column, label in study.system.targets.columns.items()}
        for label, times in measured(study.system, own).items():
            share, column = wilson(times.reached, times.runs), columns[label]
            row |= {f"{column}.reached": share.successes, f"{column}.share": share.value}
            row |= {f"{column}.low": share.low, f"{column}.high": share.high, f"{column}.median": times.median}
            cells += [f"{share.value:.0%} ({share.low:.0%} to {share.high:.0%})", in_words(times.median)]
        summary.append(row)
        shown.add_row(*cells)
    return summary, shown


def _draw(study: Study, rows: pa.Table) -> list[Path]:
    from formicarium.views.runtimes import draw_run_times

    pictures = []
    for job in study.jobs:
        found = measured(study.system, _outcomes(study, rows, job))
        if found:
            title = f"{study.design.name}, cell {job.cell.number}: {job.cell.label}"
            path = study.folder / "figures" / f"runtimes-cell-{job.cell.number:03d}.png"
            label = study.system.targets.published_label
            pictures.append(draw_run_times(found, published(study.system), path, title=title, published_label=label))
    return pictures

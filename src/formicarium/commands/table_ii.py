"""The published study of task schedules: its campaigns joined to its tables and figures."""

import os
import sys
from pathlib import Path
from typing import Any

from rich.console import Console

from formicarium.campaigns import table
from formicarium.campaigns.coordinator import run_campaign
from formicarium.campaigns.files import write_text
from formicarium.campaigns.ledger import Ledger
from formicarium.campaigns.provenance import session
from formicarium.campaigns.tidy import tidy
from formicarium.campaigns.workers import Processes
from formicarium.campaigns.writer import Writer
from formicarium.commands.campaign.answers import write_csv
from formicarium.commands.campaign.earlier import made_by
from formicarium.commands.campaign.progress import CampaignProgress
from formicarium.commands.campaign.sitting import terminable
from formicarium.commands.errors import UserError
from formicarium.compiled import PACKAGE
from formicarium.studies.scheduling import PARTS, Part, Row
from formicarium.studies.scheduling_tables import beside, figure_7, figure_8, figure_scale, grid, improved

TABLES: dict[str, tuple[str, ...]] = {
    "table-2-time": ("time",),
    "table-2-travel": ("travel",),
    "paper-model": ("paper-time", "paper-travel"),
    "hundred-tasks": ("hundred-tasks",),
    "scale": ("scale",),
    "all": tuple(PARTS),
}
LIBRARIES = ("numpy", "numba", "highspy")


def run_study(figure: str, folder: Path, runs: int | None, workers: int | None) -> int:
    """Solve the instances that are not there yet; return 0 if all are, 1 if some failed.

    Raises:
        KeyboardInterrupt: on Ctrl-C, with a message that says how to go on; every instance that was done is kept.
    """
    if workers is not None and workers < 1:
        raise UserError(f"--workers {workers}: must be at least 1")
    if runs is not None and runs < 1:
        raise UserError(f"--runs {runs}: must be at least 1")
    return max(_run(PARTS[name], folder, runs, workers or os.cpu_count() or 1) for name in TABLES[figure])


def _run(part: Part, folder: Path, runs: int | None, workers: int) -> int:
    design, jobs = part.design(runs), part.jobs(runs)
    ledger = Ledger(folder / design.name)
    manifest = {"name": design.name, "system": design.system, "design": design.content()}
    trouble = Console(stderr=True)
    with terminable(), Writer(ledger, manifest, jobs) as writer:
        writer.note_session(session(sys.argv, PACKAGE, LIBRARIES))
        with CampaignProgress(trouble, design.name) as progress:
            try:
                report = run_campaign(jobs, writer, Processes(workers), progress=progress.show)
            except KeyboardInterrupt:
                done = sum(ledger.has(key) for job in jobs for key in job.keys)
                said = (
                    f"interrupted: {done} instances are done and kept in {ledger.folder}. The same command continues."
                )
                raise KeyboardInterrupt(said) from None
    for run in report.failures[:3]:
        trouble.print(f"formicarium: seed {run.seed} {run.ending}\n{run.failure}", highlight=False, markup=False)
    return 0 if report.standing.done == report.standing.total else 1


def draw_study(figure: str, folder: Path, runs: int | None, sources: str | None) -> int:
    """Write a table of cells a part, a row an instance and the figures; return 1 if instances are missing, else 0.

    Raises:
        UserError: if no instance is there.
        StoreError: if the folder cannot be read or written.
    """
    found, lines, missing = {}, [], 0
    for name in TABLES[figure]:
        rows, total = _rows(PARTS[name], folder, runs, sources)
        missing += total - len(rows)
        if rows:
            found[name] = rows
            lines += _in_words(PARTS[name], rows, total)
    if not found:
        raise UserError(f"{folder}: no instance of this study is there. Run it first.")
    written = [path for name, rows in found.items() for path in _write(PARTS[name], rows, folder, sources)]
    write_text(folder / "report.md", "# Task schedules\n\n" + "\n".join(lines) + "\n")
    screen = Console()
    for line in lines:
        screen.print(line, highlight=False, soft_wrap=True)
    for path in [*written, folder / "report.md"]:
        screen.print(f"results   {path}", highlight=False, soft_wrap=True)
    return 1 if missing else 0


def _write(part: Part, rows: list[Row], folder: Path, sources: str | None) -> list[Path]:
    from formicarium.views.charts import draw_chart

    cells = [cell.content(part.said["objective"]) for cell in grid(rows)]
    written = [
        _table(cells, folder / f"cells-{part.name}.csv"),
        _table([_compact(row) for row in rows], folder / f"instances-{part.name}.csv"),
    ]
    if part.name == "travel":
        written += [
            draw_chart(figure_7(rows), folder / "figure-7.png"),
            draw_chart(figure_8(rows), folder / "figure-8.png"),
        ]
    if part.name == "scale":
        written.append(draw_chart(figure_scale(rows), folder / "figure-growing.png"))
    if part.one_in > 1:
        ours, _ = _rows(PARTS[part.said["objective"]], folder, None, sources)
        if both := beside(ours, rows):
            written.append(_table([_compact(row) for row in both], folder / f"beside-{part.name}.csv"))
    return written


def _table(rows: list[dict[str, Any]], path: Path) -> Path:
    write_csv(table.from_rows(rows), path)
    return path


def _rows(part: Part, folder: Path, runs: int | None, sources: str | None) -> tuple[list[Row], int]:
    ledger = Ledger(folder / part.design(runs).name)
    jobs = part.jobs(runs) if sources is None else made_by(sources, part.jobs(runs), ledger)
    return tidy(ledger.rows(), jobs).to_pylist(), sum(len(job.keys) for job in jobs)


def _compact(row: Row) -> dict[str, Any]:
    left_out = ("cell", "replicate", "identity")
    return {
        name: float(f"{value:.6g}") if isinstance(value, float) else value
        for name, value in row.items()
        if name not in left_out
    }


def _in_words(part: Part, rows: list[Row], total: int) -> list[str]:
    seconds = sorted(row["seconds"] for row in rows)
    proven = sum(row["ended"] == "proven" for row in rows)
    refused, none = sum(bool(row["faults"]) for row in rows), sum(row["faults"] is None for row in rows)
    words = [
        f"- {part.name}: {len(rows)} of {total} instances solved, {proven} proven ({proven / len(rows):.1%}); "
        f"processor time median {seconds[len(seconds) // 2]:.2f} s, worst {seconds[-1]:.1f} s; "
        f"without a schedule {none}, schedules that the checker refuses: {refused}",
    ]
    if part.name == "travel":
        for name, after, before in (("7", "trip_m", "time_trip_m"), ("8", "relays", "time_relays")):
            better, count = improved(rows, after, before)
            words.append(f"- Fig. {name}: less in {better} of {count} instances than in the schedule of least time")
    return words

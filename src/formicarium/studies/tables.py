"""Tables of the study: a row a cell, the compact rows of all runs, Table S3 beside ours."""

import csv
import statistics
from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

from formicarium.statistics.intervals import wilson
from formicarium.studies.cells import TARGETS, VARIANTS, Row, StudyCell, level_name

# What the compact table keeps of a run, besides setting, robots and seed; the later ones are Mark II's.
RESULTS = (
    *("success", "sequences", "time_chain_s", "time_1_s", "time_5_s", "time_10_s", "duration_s", "hopeless_s"),
    *("members_at_completion", "members", "links", "displaced", "no_answers", "protocol_faults", "disagreements"),
    *("unfounded", "upi_correct", "upi_found", "failed_sequences", "mixed", "branch_links", "cause"),
)
TEXTS = ("branch_links", "cause", "sources")
COLUMNS = ("setting", "robots", "cap_s", "seed", *RESULTS, "sources")


def table_of(cells: Iterable[StudyCell]) -> list[dict[str, Any]]:
    """Return a row a cell: success with Wilson's interval, medians (infinite: not reached), members, causes."""
    rows = []
    for cell in cells:
        row: dict[str, Any] = {"variant": cell.variant, "setting": cell.setting, "side_m": round(cell.side, 4)}
        row |= {"robots": cell.robots, "level": level_name(cell.level), "cap_s": cell.cap, "runs": len(cell.runs)}
        share = wilson(*cell.counts) if cell.runs else None
        row |= {"successes": cell.successes, "low": share and share.low, "high": share and share.high}
        row["ended_early"] = sum(run.get("hopeless_s") is not None for run in cell.runs)
        for column in ("time_chain_s", *TARGETS):
            row[f"median_{column}"] = cell.times(column).median if cell.runs else None
        for column in ("members", "members_at_completion"):
            values = cell.members(column)
            row[f"{column}_mean"] = statistics.fmean(values) if values else None
            row[f"{column}_sd"] = statistics.stdev(values) if len(values) > 1 else None
        row["causes"] = "; ".join(f"{count} {cause}" for cause, count in causes(cell.runs).most_common())
        rows.append(row)
    return rows


def causes(runs: Iterable[Row]) -> Counter[str]:
    """Count why runs failed."""
    return Counter(str(run["cause"]) for run in runs if run["cause"])


def compact(cells: Iterable[StudyCell]) -> list[dict[str, Any]]:
    """Return a row a run, in the order of the cells: what figures and report need, and nothing else."""
    return [
        {"setting": cell.setting, "robots": cell.robots, "cap_s": cell.cap, "seed": run["seed"]}
        | {name: (run.get(name) or None) if name in TEXTS else run.get(name) for name in RESULTS}
        | {"sources": run["sources"]}
        for cell in cells
        for run in cell.runs
    ]


class TableError(Exception):
    """A compact table cannot be used; the message names the line, the column and the value."""


def read_compact(path: Path) -> list[dict[str, Any]]:
    """Read what ``compact`` returned from a CSV file.

    Raises:
        TableError: if the file is no such table.
    """
    try:
        with path.open(newline="", encoding="utf-8") as file:
            reader = csv.DictReader(file)
            heads = reader.fieldnames or ()
            lines = [(reader.line_num, line) for line in reader]
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        raise TableError(f"cannot be read: {error}") from error
    if missing := [name for name in COLUMNS if name not in heads]:
        raise TableError(f"has no column {', '.join(missing)}")
    return [{name: _value(number, name, line[name]) for name in COLUMNS} for number, line in lines]


def _value(number: int, name: str, text: str | None) -> Any:
    if not text:
        return None
    try:
        return text if name in TEXTS else float(text) if name.endswith("_s") else int(float(text))
    except (ValueError, OverflowError):
        raise TableError(f'line {number}, {name}: "{text}" is not a number') from None


def with_rows(cells: Iterable[StudyCell], rows: Iterable[Row]) -> list[StudyCell]:
    """Return the cells of a variant with the rows of a compact table.

    Raises:
        TableError: if a row belongs to none of them.
    """
    found: dict[tuple[int, int], list[Row]] = {}
    for row in rows:
        found.setdefault((row["setting"], row["robots"]), []).append(row)
    filled = [cell._replace(runs=found.pop((cell.setting, cell.robots), [])) for cell in cells]
    if found:
        setting, robots = next(iter(found))
        raise TableError(f"setting {setting} with {robots} robots is no cell of this variant")
    return filled


def table_s3(published: Mapping[str, Sequence[float]], ours: StudyCell) -> list[dict[str, Any]]:
    """Return the paper's ten robot runs, our first ten by seed beside them, and the medians of all."""
    rows: list[dict[str, Any]] = []
    for k in range(len(published["time_chain_s"])):
        row: dict[str, Any] = {"run": str(k + 1)}
        for column, times in published.items():
            run = ours.runs[k] if k < len(ours.runs) else None
            row |= {f"paper_{column}": times[k], column: _within(run[column], VARIANTS[ours.variant]) if run else None}
        rows.append(row)
    medians: dict[str, Any] = {"run": "median"}
    for column, times in published.items():
        medians[f"paper_{column}"] = statistics.median(times)
        found = [_within(run[column], VARIANTS[ours.variant]) for run in ours.runs]
        medians[column] = statistics.median(found) if found else None
    return [*rows, medians]


def _within(time: float | None, variant: Any) -> float:
    """Return a time, infinite if the paper's cap of the smallest arena came first."""
    return time if time is not None and time < variant.time_caps[0] else float("inf")

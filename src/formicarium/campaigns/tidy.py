"""One tidy table of a campaign: a row a run, in the order of the design."""

from collections.abc import Sequence
from typing import Any

import pyarrow as pa

from formicarium.campaigns.cells import Job
from formicarium.campaigns.parts import OWN
from formicarium.campaigns.table import column_of

PLACE = ("cell", "replicate")  # columns that say where in the design a run is


def tidy(rows: pa.Table, jobs: Sequence[Job]) -> pa.Table:
    """Pick the runs of a design out of a ledger and put its factors beside them.

    Columns: cell, the factors, replicate, seed, the columns of the result, identity, sources. A factor that the
    result has a column for is that column if they agree everywhere; if not, it is called ``factor.<name>``.

    Args:
        rows: of the ledger, every run once.
        jobs: the cells of the design.

    Returns:
        The runs that are done, sorted by cell and replicate; equal runs give equal tables.
    """
    places = _places(rows, jobs)
    found = rows.take(pa.array([place for place, _, _ in places], pa.int64()))
    cells = [jobs[cell].cell for _, cell, _ in places]
    results = {
        f"result.{name}" if name in PLACE else name: found[name] for name in found.column_names if name not in OWN
    }
    results = {name: column for name, column in results.items() if column.null_count < len(column)} | {
        name: column.cast(pa.string()) if pa.types.is_null(column.type) else column
        for name, column in results.items()
        if column.null_count == len(column)
    }
    columns: dict[str, Any] = {"cell": pa.array([cell.number for cell in cells], pa.int64())}
    for name in dict.fromkeys(name for job in jobs for name in job.cell.factors):
        values = [cell.factors.get(name) for cell in cells]
        if name in results and results[name].to_pylist() == values:
            columns[name] = results.pop(name)
        else:
            taken = name in results or name in (*PLACE, *OWN)
            columns[f"factor.{name}" if taken else name] = column_of(values)
    columns["replicate"] = pa.array([replicate for _, _, replicate in places], pa.int64())
    columns["seed"] = found["seed"]
    columns |= results
    return pa.table(columns | {name: found[name] for name in ("identity", "sources")}).combine_chunks()


def _places(rows: pa.Table, jobs: Sequence[Job]) -> list[tuple[int, int, int]]:
    """Return (row of the ledger, cell, replicate) of every run that is there, sorted by cell and replicate."""
    wanted = {key: (cell, k) for cell, job in enumerate(jobs) for k, key in enumerate(job.keys)}
    keys = zip(rows["identity"].to_pylist(), rows["seed"].to_pylist())
    found = [(place, *wanted[key]) for place, key in enumerate(keys) if key in wanted]
    return sorted(found, key=lambda entry: entry[1:])

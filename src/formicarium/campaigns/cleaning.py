"""Remove from a ledger what belongs to no run of a design."""

import shutil
from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

import pyarrow as pa

from formicarium.campaigns.cells import Job, Key
from formicarium.campaigns.files import StoreError
from formicarium.campaigns.ledger import Ledger
from formicarium.campaigns.writer import Writer


class Leftovers(NamedTuple):
    """What belongs to no run of the design."""

    rows: int
    files: tuple[Path, ...]  # failures, tables and configurations, and damaged files that were set aside


def leftovers(ledger: Ledger, jobs: Sequence[Job]) -> Leftovers:
    """Return what could be removed; the ledger has been refreshed."""
    wanted = {key for job in jobs for key in job.keys}
    identities = {identity for identity, _ in wanted}
    files = [path for path in (ledger.folder / "configurations").glob("*.json") if path.stem not in identities]
    files += [ledger.failure_path(key) for key in ledger.failures() - wanted]
    for path in ledger.folder.glob("*/*/seed-*.parquet"):
        if (path.parent.name, int(path.stem.removeprefix("seed-"))) not in wanted:
            files.append(path)
    files += (ledger.folder / "damaged").glob("*")
    return Leftovers(len(ledger.done - wanted), tuple(sorted(files)))


def clean_up(writer: Writer, jobs: Sequence[Job]) -> Leftovers:
    """Remove it: all rows that stay go into one new part before the old ones are removed.

    Raises:
        StoreError: if another writer is at work, or the folder cannot be written.
    """
    wanted = {key for job in jobs for key in job.keys}
    with writer.alone() as ledger:
        found = leftovers(ledger, jobs)
        if ledger.done - wanted:
            rows = ledger.rows()
            keys: list[Key] = list(zip(rows["identity"].to_pylist(), rows["seed"].to_pylist()))
            writer.replace_all(rows.filter(pa.array([key in wanted for key in keys], pa.bool_())))
        for path in found.files:
            try:
                path.unlink(missing_ok=True)
                if path.parent.parent.parent == ledger.folder and not any(path.parent.iterdir()):
                    shutil.rmtree(path.parent)
            except OSError as error:
                raise StoreError(f"cannot remove {path}: {error.strerror or error}") from error
    return found

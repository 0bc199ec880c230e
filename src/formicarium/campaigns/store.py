"""A folder of results: one configuration, one row a run, and the tables of each run.

    configuration.json            what was run, with its identity
    runs.parquet                  one row a run, sorted by seed; a run is done when its row is here
    <table>/seed-<seed>.parquet   what else a run left (events, frames)
    failures/seed-<seed>.txt      traceback of a run that failed, until it succeeds
    timings.parquet               wall-clock seconds and worker of each run
    provenance.json               who ran what, when and where

All but the last two are the same bytes whatever the number of workers and the order in which runs ended.
"""

from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import IO, Any

import pyarrow as pa

from formicarium.campaigns import lock, table
from formicarium.campaigns.configuration import Configuration, difference
from formicarium.campaigns.files import StoreError, read_json, write_json, write_text
from formicarium.campaigns.result import Finished
from formicarium.campaigns.table import Row


class Store:
    """Results of one configuration in one folder, locked against other writers while it is open."""

    def __init__(self, folder: Path, configuration: Configuration):
        """Open or create the folder.

        Raises:
            StoreError: if the folder cannot be written, holds another configuration, is in use or is damaged.
        """
        self.folder = folder
        self.configuration = configuration
        self._lock: IO[str] = lock.acquire(folder)
        try:
            self._check_configuration()
            self.rows: dict[int, Row] = self._read_rows("runs.parquet")
            self.timings: dict[int, Row] = self._read_rows("timings.parquet")
        except BaseException:
            self._lock.close()
            raise

    def __enter__(self) -> "Store":
        """Return the open store."""
        return self

    def __exit__(self, *_: object) -> None:
        """Release the folder."""
        self._lock.close()

    def path(self, name: str, seed: int, suffix: str = "parquet") -> Path:
        """Return where the table ``name`` of a run is."""
        return self.folder / name / f"seed-{seed}.{suffix}"

    def has(self, seed: int, wanted: Mapping[str, Mapping[str, str]]) -> bool:
        """Tell whether a run is done and left the wanted tables, each with the wanted metadata.

        Raises:
            StoreError: if one of these tables is damaged.
        """
        if seed not in self.rows or not all(self.path(name, seed).exists() for name in wanted):
            return False
        stored = {name: table.metadata_of(self.table(name, seed).schema) for name in wanted}
        return all(stored[name].get(key) == value for name in wanted for key, value in wanted[name].items())

    def table(self, name: str, seed: int) -> pa.Table:
        """Read a table of a run.

        Raises:
            StoreError: if it is damaged or was left by another configuration.
        """
        path = self.path(name, seed)
        content = table.read(path)
        self._check_identity(path, content)
        return content

    def add(self, finished: Finished) -> Finished:
        """Keep a run that has ended. Its row comes last: only then is the run done.

        A run repeated for a table it lacked must give the row it gave before; otherwise it is kept as failed.
        Returns the run as it was kept.
        """
        seed, result = finished.seed, finished.result
        if result is not None and seed in self.rows and not table.same({"seed": seed, **result.row}, self.rows[seed]):
            reason = f"seed {seed} was run again and gave another row than the one stored: it does not repeat"
            finished, result = finished._replace(result=None, failure=reason), None
        if result is None:
            write_text(self.path("failures", seed, "txt"), finished.failure.rstrip() + "\n")
            return finished
        for name, content in result.tables.items():
            table.write(self._signed(content, seed=str(seed)), self.path(name, seed))
        timing = {"seed": seed, "wall_seconds": finished.seconds, "worker": finished.worker}
        self.timings = self._write_rows("timings.parquet", {**self.timings, seed: timing})
        self.rows = self._write_rows("runs.parquet", {**self.rows, seed: {"seed": seed, **result.row}})
        self.path("failures", seed, "txt").unlink(missing_ok=True)
        return finished

    def rows_of(self, seeds: Iterable[int]) -> list[Row]:
        """Return the rows of those of these seeds that are done, in the order of the seeds."""
        return [self.rows[seed] for seed in seeds if seed in self.rows]

    def note(self, provenance: Mapping[str, Any]) -> None:
        """Add a session to ``provenance.json``."""
        path = self.folder / "provenance.json"
        sessions = read_json(path).get("sessions", []) if path.exists() else []
        write_json(path, {"sessions": [*sessions, provenance]})

    def _check_configuration(self) -> None:
        path = self.folder / "configuration.json"
        wanted = self.configuration.content()
        if not path.exists():
            write_json(path, wanted)
            return
        stored = read_json(path)
        if stored.get("identity") != wanted["identity"]:
            raise StoreError(
                f"{self.folder} belongs to another configuration: {difference(stored, wanted)} "
                f"(see {path.name}). Choose another folder, or move this one away."
            )

    def _check_identity(self, path: Path, content: pa.Table) -> None:
        if table.metadata_of(content.schema).get("identity") != self.configuration.identity:
            raise StoreError(
                f"{path} was left by another configuration than {self.folder / 'configuration.json'}. "
                "Move it away, then run the same command again."
            )

    def _signed(self, content: pa.Table, **more: str) -> pa.Table:
        own = {"system": self.configuration.system, "identity": self.configuration.identity}
        return table.with_metadata(content, {**own, **more})

    def _read_rows(self, name: str) -> dict[int, Row]:
        path = self.folder / name
        if not path.exists():
            return {}
        content = table.read(path)
        self._check_identity(path, content)
        if "seed" not in content.column_names:
            raise StoreError(f"{path} has no column 'seed'. Move it away, then run the same command again.")
        return {row["seed"]: row for row in content.to_pylist()}

    def _write_rows(self, name: str, rows: dict[int, Row]) -> dict[int, Row]:
        table.write(self._signed(table.from_rows(rows[seed] for seed in sorted(rows))), self.folder / name)
        return rows

"""Writing to a ledger: one transaction at a time, by any number of processes on any number of machines."""

import contextlib
import uuid
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import IO, Any

import pyarrow as pa

from formicarium.campaigns import claims, lock, table
from formicarium.campaigns.agreement import agreeing
from formicarium.campaigns.cells import Job, Key
from formicarium.campaigns.damaged import set_aside, sweep
from formicarium.campaigns.files import StoreError
from formicarium.campaigns.ledger import Ledger
from formicarium.campaigns.parts import DamagedPart, distinct, joined, part_of, read_part, write_part
from formicarium.campaigns.records import write_configuration, write_failure, write_manifest, write_session
from formicarium.campaigns.result import Finished

SMALL_PARTS = 64  # as many parts below LARGE rows are merged into one
LARGE = 4096  # rows


class Writer:
    """The right to add rows to a folder; others may hold it too."""

    def __init__(self, ledger: Ledger, manifest: Mapping[str, Any], jobs: Sequence[Job]):
        """Open or create the folder.

        Raises:
            StoreError: if the folder cannot be written, or belongs to another campaign.
        """
        self.ledger = ledger
        self.name = uuid.uuid4().hex[:12]
        self.notes: list[str] = []  # what a person should know: files that were set aside, and why
        self._jobs = {job.configuration.identity: job for job in jobs}
        self._written = 0
        self._claimed: set[Key] = set()
        self._alive: IO[str] | None = None
        with self.transaction():
            write_manifest(ledger.folder, manifest)
            for job in self._jobs.values():
                self.notes += write_configuration(ledger.folder, job)
            sweep(ledger.folder)
            self._alive = claims.register(self._writers, self.name)

    def __enter__(self) -> "Writer":
        """Return the open writer."""
        return self

    def __exit__(self, *_: object) -> None:
        """Give the work that was not done back to others."""
        if self._alive is not None:
            claims.withdraw(self._writers, self.name, self._alive)

    @contextmanager
    def transaction(self) -> Iterator[Ledger]:
        """Hold the folder during the block; gives the ledger as it is."""
        with lock.held(self.ledger.folder / lock.NAME):
            self.ledger.refresh()
            for name, reason in list(self.ledger.damaged.items()):
                self._set_aside(name, reason)
                del self.ledger.damaged[name]
            yield self.ledger

    @contextmanager
    def alone(self) -> Iterator[Ledger]:
        """Hold the folder while nobody else is at work on it.

        Raises:
            StoreError: if another writer is at work.
        """
        with self.transaction():
            claims.taken_by_others(self._writers, self.name)  # forgets dead writers
            if claims.writers(self._writers) > 1:
                raise StoreError(f"{self.ledger.folder} is in use: a campaign is running in it. Wait for it to end.")
            yield self.ledger

    def exchange(
        self, finished: Sequence[Finished], wanted: Iterable[Key], room: int, keep: Sequence[str] = ()
    ) -> tuple[list[Finished], list[Key], list[Key]]:
        """Keep runs that have ended and take others, in one transaction.

        Args:
            finished: runs to be kept.
            wanted: runs to choose from, in order; looked at until enough are taken.
            room: how many to take at most.
            keep: tables a run must have left to count as done.

        Returns:
            The finished runs as they were kept, the runs taken, and those passed over because another
            writer is at work on them. What was looked at and is in neither list is done or has failed.
        """
        with self.transaction():
            kept = self._commit(finished)
            self._claimed -= {(run.identity, run.seed) for run in finished}
            taken, passed = self._choose(wanted, room, keep) if room > 0 else ([], [])
            self._claimed |= set(taken)
            claims.note(self._writers, self.name, sorted(self._claimed))
        return kept, taken, passed

    def forget_failures(self, keys: Iterable[Key]) -> int:
        """Remove the records of failed runs, so that they are run again; returns how many."""
        with self.transaction():
            failed = self.ledger.failures() & set(keys)
            for key in failed:
                self.ledger.failure_path(key).unlink(missing_ok=True)
        return len(failed)

    def note_session(self, provenance: Mapping[str, Any]) -> None:
        """Record who runs what, when and where."""
        write_session(self.ledger.folder, self.name, provenance)

    def add(self, rows: pa.Table, suffix: str = "") -> None:
        """Add rows that are not there yet, as one part; only to be called in a ``transaction``."""
        name = f"{self.name}-{self._written:06d}{suffix}.parquet"
        write_part(rows, self.ledger.folder / "parts" / name)
        self._written += 1
        self.ledger.known[name] = len(rows)
        self.ledger.done.update(zip(rows["identity"].to_pylist(), rows["seed"].to_pylist()))

    def replace_all(self, rows: pa.Table) -> None:
        """Put these rows in place of all rows, in one part; only to be called ``alone``.

        Killed in between, the old parts are there too: nothing is lost, and the next time it is done.
        """
        before = list(self.ledger.known)
        self.ledger.done = set()
        if len(rows):
            self.add(rows, "-merged")
        self._remove(before)

    @property
    def _writers(self) -> Path:
        return self.ledger.folder / "writers"

    def _set_aside(self, part: str, reason: str) -> None:
        path = self.ledger.folder / "parts" / part
        self.notes.append(set_aside(self.ledger.folder, path, reason, "the runs it held are run again"))

    def _choose(self, wanted: Iterable[Key], room: int, keep: Sequence[str]) -> tuple[list[Key], list[Key]]:
        others, failed = claims.taken_by_others(self._writers, self.name), self.ledger.failures()
        taken: list[Key] = []
        passed: list[Key] = []
        for key in wanted:
            if key in others:
                passed.append(key)
            elif key not in failed and not self.ledger.has(key, keep):
                taken.append(key)
            if len(taken) == room:
                break
        return taken, passed

    def _commit(self, finished: Sequence[Finished]) -> list[Finished]:
        kept = agreeing(self.ledger, finished)
        for run in kept:
            key = (run.identity, run.seed)
            if run.result is None:
                write_failure(self.ledger.failure_path(key), run, self._jobs[run.identity].cell.factors)
                continue
            for name, content in run.result.tables.items():
                own = {"identity": run.identity, "seed": str(run.seed)}
                table.write(table.with_metadata(content, own), self.ledger.table_path(name, key))
        fresh = [run for run in kept if run.result is not None and (run.identity, run.seed) not in self.ledger.done]
        if fresh:
            jobs = [self._jobs[run.identity] for run in fresh]
            self.add(part_of((run, job.configuration.sources, job.cell.factors) for run, job in zip(fresh, jobs)))
            for run in fresh:
                self.ledger.failure_path((run.identity, run.seed)).unlink(missing_ok=True)
        small = [name for name, rows in self.ledger.known.items() if rows < LARGE]
        if self.ledger.repeated:
            self.merge(list(self.ledger.known))
        elif len(small) >= SMALL_PARTS:
            self.merge(small)
        return kept

    def merge(self, names: Sequence[str]) -> None:
        """Put parts into one; only to be called in a ``transaction``.

        Killed in between, rows are there twice, are read once, and are merged the next time.
        """
        tables = []
        for name in names:
            try:
                tables.append(read_part(self.ledger.folder / "parts" / name))
            except FileNotFoundError:
                continue
            except DamagedPart as reason:  # since it was read last
                self._set_aside(name, str(reason))
        self.add(distinct(joined(tables)), "-merged")
        self._remove(names)
        self.ledger.repeated = 0

    def _remove(self, names: Sequence[str]) -> None:
        for name in names:
            with contextlib.suppress(PermissionError):  # somebody reads it (Windows): merged again another time
                (self.ledger.folder / "parts" / name).unlink(missing_ok=True)
            del self.ledger.known[name]

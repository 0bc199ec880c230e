"""Writing to a ledger: one transaction at a time, by any number of processes on any number of machines."""

import contextlib
import os
import time
import uuid
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from datetime import UTC, datetime
from pathlib import Path
from typing import IO, Any

import pyarrow as pa

from formicarium.campaigns import claims, lock, table
from formicarium.campaigns.cells import Job, Key
from formicarium.campaigns.files import StoreError, read_json, unwritable, write_json
from formicarium.campaigns.ledger import FORMAT, MANIFEST, Ledger
from formicarium.campaigns.parts import OWN, DamagedPart, distinct, joined, part_of, read_part, write_part
from formicarium.campaigns.result import Ending, Finished

SMALL_PARTS = 64  # as many parts below LARGE rows are merged into one
LARGE = 4096  # rows
HALF_WRITTEN = 600.0  # seconds after which a temporary file has no owner any more


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
        with self._locked():
            self._write_manifest(manifest)
            for job in jobs:
                self._write_configuration(job)
            self._alive = claims.register(self._writers, self.name)

    def __enter__(self) -> "Writer":
        """Return the open writer."""
        return self

    def __exit__(self, *_: object) -> None:
        """Give the work that was not done back to others."""
        if self._alive is not None:
            claims.withdraw(self._writers, self.name, self._alive)

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
        with self._locked():
            kept = self._commit(finished)
            self._claimed -= {(run.identity, run.seed) for run in finished}
            taken: list[Key] = []
            passed: list[Key] = []
            if room > 0:
                others = claims.taken_by_others(self._writers, self.name)
                failed = self.ledger.failures()
                for key in wanted:
                    if key in others:
                        passed.append(key)
                    elif key not in failed and not self.ledger.has(key, keep):
                        taken.append(key)
                    if len(taken) == room:
                        break
            self._claimed |= set(taken)
            claims.note(self._writers, self.name, sorted(self._claimed))
        return kept, taken, passed

    def forget_failures(self, keys: Iterable[Key]) -> int:
        """Remove the records of failed runs, so that they are run again; returns how many."""
        with self._locked():
            failed = self.ledger.failures() & set(keys)
            for key in failed:
                self.ledger.failure_path(key).unlink(missing_ok=True)
        return len(failed)

    def note_session(self, provenance: Mapping[str, Any]) -> None:
        """Record who runs what, when and where."""
        moment = datetime.now(UTC).strftime("%Y%m%dT%H%M%S")
        write_json(self.ledger.folder / "sessions" / f"{moment}-{self.name}.json", provenance)

    @contextmanager
    def transaction(self) -> Iterator[Ledger]:
        """Hold the folder during the block; gives the ledger as it is."""
        with self._locked():
            yield self.ledger

    def add(self, rows: pa.Table) -> None:
        """Add rows that are not there yet, as one part; only to be called in a ``transaction``."""
        self._write_part(rows)

    @contextmanager
    def alone(self) -> Iterator[Ledger]:
        """Hold the folder while nobody else is at work on it; gives the ledger as it is.

        Raises:
            StoreError: if another writer is at work.
        """
        with self._locked():
            if claims.taken_by_others(self._writers, self.name) or claims.writers(self._writers) > 1:
                raise StoreError(f"{self.ledger.folder} is in use: a campaign is running in it. Wait for it to end.")
            yield self.ledger

    def replace_all(self, rows: pa.Table) -> None:
        """Put these rows in place of all rows, in one part; only to be called ``alone``.

        Killed in between, the old parts are there too: nothing is lost, and the next time it is done.
        """
        before = list(self.ledger.known)
        self.ledger.known, self.ledger.done = {}, set()
        if len(rows):
            self._write_part(rows, "-merged")
        for name in before:
            (self.ledger.folder / "parts" / name).unlink(missing_ok=True)

    @property
    def _writers(self) -> Path:
        return self.ledger.folder / "writers"

    @contextmanager
    def _locked(self) -> Iterator[None]:
        with lock.held(self.ledger.folder / lock.NAME):
            self.ledger.refresh()
            for name, reason in list(self.ledger.damaged.items()):
                self.set_aside(self.ledger.folder / "parts" / name, reason)
                del self.ledger.damaged[name]
            yield

    def set_aside(self, path: Path, reason: str) -> None:
        """Move a file that cannot be read to ``damaged/`` and note it."""
        place = self.ledger.folder / "damaged" / f"{uuid.uuid4().hex[:6]}-{path.name}"
        try:
            place.parent.mkdir(parents=True, exist_ok=True)
            os.replace(path, place)
        except FileNotFoundError:
            return
        except OSError as error:
            raise unwritable(place, error) from error
        self.notes.append(f"{path} is damaged ({reason}); set aside as {place}, the runs it held are run again")

    def _commit(self, finished: Sequence[Finished]) -> list[Finished]:
        kept = self._checked(finished)
        for run in kept:
            key = (run.identity, run.seed)
            if run.result is None:
                self._write_failure(run)
                continue
            for name, content in run.result.tables.items():
                own = {"identity": run.identity, "seed": str(run.seed)}
                table.write(table.with_metadata(content, own), self.ledger.table_path(name, key))
        fresh = [run for run in kept if run.result is not None and (run.identity, run.seed) not in self.ledger.done]
        if fresh:
            jobs = [self._jobs[run.identity] for run in fresh]
            part = part_of((run, job.configuration.sources, job.cell.factors) for run, job in zip(fresh, jobs))
            self._write_part(part)
            for run in fresh:
                self.ledger.failure_path((run.identity, run.seed)).unlink(missing_ok=True)
        small = [name for name, rows in self.ledger.known.items() if rows < LARGE]
        if len(small) >= SMALL_PARTS or self.ledger.repeated:
            self._merge(small if not self.ledger.repeated else list(self.ledger.known))
        return kept

    def _write_part(self, part: Any, suffix: str = "") -> str:
        name = f"{self.name}-{self._written:06d}{suffix}.parquet"
        write_part(part, self.ledger.folder / "parts" / name)
        self._written += 1
        self.ledger.known[name] = len(part)
        self.ledger.done.update(zip(part["identity"].to_pylist(), part["seed"].to_pylist()))
        return name

    def _merge(self, names: Sequence[str]) -> None:
        """Put parts into one. Killed in between, rows are there twice, read once, and merged next time."""
        folder = self.ledger.folder / "parts"
        _sweep(folder)
        tables = []
        for name in names:
            try:
                tables.append(read_part(folder / name))
            except FileNotFoundError:
                continue
            except DamagedPart as reason:  # since it was read last
                self.set_aside(folder / name, str(reason))
        self._write_part(distinct(joined(tables)), "-merged")
        for name in names:
            (folder / name).unlink(missing_ok=True)
            del self.ledger.known[name]
        self.ledger.repeated = 0

    def _checked(self, finished: Sequence[Finished]) -> list[Finished]:
        """Turn runs into failures that contradict the rows stored or whose columns have reserved names."""
        known = {(run.identity, run.seed) for run in finished} & self.ledger.done
        stored = _by_key(self.ledger.rows(), known) if known else {}
        kept = []
        for run in finished:
            reason = ""
            if run.result is not None:
                before = stored.get((run.identity, run.seed))
                reserved = sorted(OWN.keys() & run.result.row.keys())
                if reserved:
                    reason = f"its row has a column {reserved[0]!r}, a name that the ledger needs for itself"
                elif before is not None and not table.same(run.result.row, before):
                    reason = "it was run again and gave another row than the one stored: it does not repeat"
            kept.append(run._replace(result=None, failure=reason, ending=Ending.FAILED) if reason else run)
        return kept

    def _write_failure(self, run: Finished) -> None:
        content = {
            "identity": run.identity,
            "seed": run.seed,
            "factors": dict(self._jobs[run.identity].cell.factors),
            "ending": str(run.ending),
            "failure": run.failure.rstrip(),
            "wall_seconds": run.seconds,
            "worker": str(run.worker),
        }
        write_json(self.ledger.failure_path((run.identity, run.seed)), content)

    def _write_manifest(self, manifest: Mapping[str, Any]) -> None:
        path, wanted = self.ledger.folder / MANIFEST, {"format": FORMAT, **manifest}
        stored = read_json(path) if path.exists() else wanted
        for key in ("name", "system"):
            if stored.get(key) != wanted.get(key):
                raise StoreError(
                    f"{self.ledger.folder} belongs to another campaign: {key} is {stored.get(key)!r}, "
                    f"not {wanted.get(key)!r}. Choose another folder."
                )
        if stored != wanted or not path.exists():
            write_json(path, wanted)

    def _write_configuration(self, job: Job) -> None:
        path = self.ledger.folder / "configurations" / f"{job.configuration.identity}.json"
        try:
            if path.exists() and read_json(path).get("identity") == job.configuration.identity:
                return
        except StoreError:
            self.set_aside(path, "not readable")
        write_json(path, job.configuration.content())


def _sweep(folder: Path) -> None:
    """Remove what writers that died have left half written; a living write takes seconds."""
    for path in folder.glob(".partial-*"):
        with contextlib.suppress(OSError):
            if time.time() - path.stat().st_mtime > HALF_WRITTEN:
                path.unlink()


def _by_key(rows: Any, keys: set[Key]) -> dict[Key, dict[str, Any]]:
    found = {}
    for index, key in enumerate(zip(rows["identity"].to_pylist(), rows["seed"].to_pylist())):
        if key in keys:
            (row,) = rows.slice(index, 1).to_pylist()
            found[key] = {name: value for name, value in row.items() if name not in OWN}
    return found

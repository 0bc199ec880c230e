"""The store of a campaign: one row a run, for any number of configurations, writers and sittings.

    campaign.json                      format version, name, and the design as it was last run
    configurations/<identity>.json     all parameters of a configuration, its sources, what the design said
    parts/<writer>-<number>.parquet    rows; a run is done when its row is in a part
    failures/<identity>-<seed>.json    traceback of a run that failed
    <table>/<identity>/seed-<seed>.parquet   tables of a run, if the design keeps them
    sessions/<time>-<writer>.json      who ran what, when and where
    writers/                           who is at work now, and on which runs
    damaged/                           files that could not be read, set aside

Parts only come and go whole (``Writer``), so reading needs no lock.
"""

from collections.abc import Iterable
from pathlib import Path
from typing import Any

import pyarrow as pa

from formicarium.campaigns.cells import Key
from formicarium.campaigns.files import StoreError, read_json
from formicarium.campaigns.parts import DamagedPart, distinct, joined, read_part

FORMAT = 1  # of the folder; see campaign.json
MANIFEST = "campaign.json"


class Ledger:
    """What a folder holds, as far as it was read last."""

    def __init__(self, folder: Path):
        """Look at a folder; one that is not there is empty.

        Raises:
            StoreError: if the folder is something else, was made by a newer version or is damaged.
        """
        self.folder = folder
        self.done: set[Key] = set()
        self.known: dict[str, int] = {}  # part -> rows in it
        self.damaged: dict[str, str] = {}  # part -> reason
        self.repeated = 0  # rows that are in more than one part
        self.manifest = self._read_manifest()

    def refresh(self) -> None:
        """Read the parts that came since the last look."""
        while new := [name for name in self._listing() if name not in self.known and name not in self.damaged]:
            for name in new:
                try:
                    table = read_part(self.folder / "parts" / name)
                except FileNotFoundError:
                    continue  # merged into another in the meantime
                except DamagedPart as reason:
                    self.damaged[name] = str(reason)
                    continue
                self.known[name] = len(table)
                before = len(self.done)
                self.done.update(zip(table["identity"].to_pylist(), table["seed"].to_pylist()))
                self.repeated += len(table) - (len(self.done) - before)

    def rows(self, columns: list[str] | None = None) -> pa.Table:
        """Return all rows, every run once, sorted by identity and seed.

        Parts that cannot be read are left out and named in ``damaged``.
        """
        while True:
            tables = []
            try:
                for name in self._listing():
                    try:
                        tables.append(read_part(self.folder / "parts" / name, columns))
                    except DamagedPart as reason:
                        self.damaged[name] = str(reason)
                return distinct(joined(tables))
            except FileNotFoundError:
                continue  # parts were merged meanwhile: look again

    def failures(self) -> set[Key]:
        """Return the runs that have failed and not been forgotten since."""
        found = set()
        for path in _entries(self.folder / "failures", ".json"):
            identity, _, seed = path.stem.rpartition("-")
            if seed.isdecimal():
                found.add((identity, int(seed)))
        return found

    def failure_path(self, key: Key) -> Path:
        """Return where the record of a failed run is."""
        return self.folder / "failures" / f"{key[0]}-{key[1]}.json"

    def failure(self, key: Key) -> dict[str, Any]:
        """Return the record of a failed run; an unreadable one says so itself."""
        try:
            return read_json(self.failure_path(key))
        except StoreError as error:
            return {"ending": "failed", "failure": str(error)}

    def table_path(self, name: str, key: Key) -> Path:
        """Return where the table ``name`` of a run is."""
        return self.folder / name / key[0] / f"seed-{key[1]}.parquet"

    def has(self, key: Key, keep: Iterable[str] = ()) -> bool:
        """Tell whether a run is done and left these tables."""
        return key in self.done and all(self.table_path(name, key).exists() for name in keep)

    def configurations(self) -> dict[str, dict[str, Any]]:
        """Return the readable configurations by identity."""
        found = {}
        for path in _entries(self.folder / "configurations", ".json"):
            try:
                found[path.stem] = read_json(path)
            except StoreError:
                continue  # written anew when it is run again
        return found

    def _listing(self) -> list[str]:
        return sorted(path.name for path in _entries(self.folder / "parts", ".parquet"))

    def _read_manifest(self) -> dict[str, Any] | None:
        path = self.folder / MANIFEST
        if not path.exists():
            if (self.folder / "configuration.json").exists():
                raise StoreError(f"{self.folder} holds the runs of one configuration, made by 'run'. Choose another.")
            return None
        manifest = read_json(path)
        version = manifest.get("format")
        if version != FORMAT:
            newer = isinstance(version, int) and version > FORMAT
            way_out = "update the package" if newer else "it is damaged, move it away"  # older ones: see adoption.py
            raise StoreError(f"{path} has format {version!r}, this version knows {FORMAT}: {way_out}.")
        return manifest


def _entries(folder: Path, suffix: str) -> list[Path]:
    try:
        found = list(folder.iterdir())
    except FileNotFoundError:
        return []
    except OSError as error:
        reason = error.strerror or str(error)
        raise StoreError(f"cannot read {folder}: {reason}. Choose a folder that can be read.") from error
    return [path for path in found if path.suffix == suffix and not path.name.startswith(".")]

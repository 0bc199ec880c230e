"""Results as arrays and tables."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import pyarrow as pa
import pyarrow.compute as pc

from formicarium.campaigns import table
from formicarium.campaigns.files import StoreError, read_json
from formicarium.commands.known import find_system
from formicarium.commands.tables import trial_of
from formicarium.systems.registry import System
from formicarium.trial.record import Trial


class Results(NamedTuple):
    """What runs have left: one row a run, and of a set the trials themselves."""

    folder: Path
    table: pa.Table  # one row a run; times in seconds, null where a target was not reached
    system: System

    @classmethod
    def of_set(cls, folder: Path, system: System, seeds: Sequence[int]) -> "Results":
        """Return the results of some runs of a set."""
        rows = table.read(folder / "runs.parquet")
        wanted = pa.array(list(seeds), rows["seed"].type)
        return cls(folder, rows.filter(pc.is_in(rows["seed"], value_set=wanted)), system)

    @property
    def columns(self) -> Mapping[str, np.ndarray]:
        """Every column as an array (R,), numbers as floats with nan for what is missing, everything else as objects."""
        return {name: _array(self.table[name]) for name in self.table.column_names}

    def trial(self, seed: int) -> Trial:
        """Return one trial of a set: outcome, events, frames if they were kept, scene.

        Raises:
            StoreError: if it is not there.
        """
        rows = {row["seed"]: row for row in self.table.to_pylist()}
        events, frames = (self.folder / kind / f"seed-{seed}.parquet" for kind in ("events", "frames"))
        if seed not in rows or not events.exists():
            raise StoreError(f"{self.folder} holds no trial with seed {seed}")
        kept = table.read(frames) if frames.exists() else None
        return trial_of(rows[seed], table.read(events), kept, self.system.kinds)


def load_results(folder: str | Path, system: str | None = None) -> Results:
    """Return the results in a folder of ``formicarium run`` or ``formicarium campaign collect``.

    Args:
        folder: of the results.
        system: name of the system, if it is not found by the one that the folder says ("module:object").

    Raises:
        UserError: if the system is not found.
        StoreError: if there are none, or a file is damaged.
    """
    place = Path(folder)
    if not (place / "runs.parquet").exists():
        wanted = "formicarium campaign collect DESIGN" if (place / "parts").exists() else "formicarium run"
        raise StoreError(f"{place} has no runs.parquet: name a folder of results ({wanted} makes it)")
    return Results(place, table.read(place / "runs.parquet"), find_system(system or _name(place)))


def _name(folder: Path) -> str:
    """Return the name of the system that a folder is of."""
    for file in ("configuration.json", "campaign.json"):
        if (folder / file).exists():
            return str(read_json(folder / file)["system"])
    raise StoreError(f"{folder} does not say of which system it is: configuration.json is missing")


def _array(column: Any) -> np.ndarray:
    if pa.types.is_boolean(column.type) or not (pa.types.is_integer(column.type) or pa.types.is_floating(column.type)):
        return np.array(column.to_pylist(), object)
    return np.array([np.nan if value is None else value for value in column.to_pylist()], float)

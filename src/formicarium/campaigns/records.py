"""The JSON records beside the rows of a ledger: what it is, which configurations it holds, which runs failed."""

from collections.abc import Mapping
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

from formicarium.campaigns.cells import Job
from formicarium.campaigns.damaged import set_aside
from formicarium.campaigns.files import StoreError, read_json, write_json
from formicarium.campaigns.ledger import FORMAT, MANIFEST
from formicarium.campaigns.result import Finished


def write_manifest(folder: Path, manifest: Mapping[str, Any]) -> None:
    """Note what the folder is, with the design as it is now.

    Raises:
        StoreError: if it belongs to another campaign, or cannot be written.
    """
    path, wanted = folder / MANIFEST, {"format": FORMAT, **manifest}
    stored = read_json(path) if path.exists() else None
    for key in ("name", "system"):
        if stored is not None and stored.get(key) != wanted.get(key):
            raise StoreError(
                f"{folder} belongs to another campaign: {key} is {stored.get(key)!r}, not {wanted.get(key)!r}. "
                "Choose another folder."
            )
    if stored != wanted:
        write_json(path, wanted)


def write_configuration(folder: Path, job: Job) -> list[str]:
    """Note the parameters of a cell and what the design said of it, once; returns what a person should know."""
    path, notes = folder / "configurations" / f"{job.configuration.identity}.json", []
    try:
        if path.exists() and read_json(path).get("identity") == job.configuration.identity:
            return []
    except StoreError:
        notes.append(set_aside(folder, path, "not readable", "it is written anew"))
    write_json(path, {**job.configuration.content(), "said": dict(job.cell.said)})
    return notes


def write_failure(path: Path, run: Finished, factors: Mapping[str, Any]) -> None:
    """Note a run that failed, with its traceback."""
    content = {
        "identity": run.identity,
        "seed": run.seed,
        "factors": dict(factors),
        "ending": str(run.ending),
        "failure": run.failure.rstrip(),
        "wall_seconds": run.seconds,
        "worker": str(run.worker),
    }
    write_json(path, content)


def write_session(folder: Path, writer: str, provenance: Mapping[str, Any]) -> None:
    """Note who runs what, when and where."""
    moment = datetime.now(UTC).strftime("%Y%m%dT%H%M%S")
    write_json(folder / "sessions" / f"{moment}-{writer}.json", provenance)

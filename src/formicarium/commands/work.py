"""One run of a system as campaigns know it: seed in, row and tables out."""

from collections.abc import Mapping
from functools import partial
from pathlib import Path
from typing import Any

from pydantic import BaseModel
from pydantic_core import from_json, to_json

from formicarium import __version__
from formicarium.campaigns.configuration import Configuration
from formicarium.campaigns.errors import Futile
from formicarium.campaigns.result import Function, Result, Watch
from formicarium.commands.sources import sources_of
from formicarium.commands.tables import result_of
from formicarium.systems.registry import System, resolve
from formicarium.trial.record import Trial

FRAMES_EVERY = 2.0  # seconds between two frames, if a campaign keeps them
RECORDED_EVERY = 0.5  # seconds between two frames of a recording


def run_trial(
    system: str, parameters: bytes, seed: int, frames_every: float | None, watch: Watch | None = None
) -> Trial:
    """Run one trial of a system known by name, with parameters as JSON; importable by worker processes."""
    found = resolve(system)
    return found.run(found.parameters.model_validate_json(parameters), seed, frames_every=frames_every, watch=watch)


class ChangedSources(Futile):
    """A worker found other sources than those that the identity of the results stands for."""


def function_of(
    name: str, parameters: BaseModel, frames_every: Mapping[int, float], sources: str, recordings: Path | None = None
) -> Function:
    """Return the function that a set repeats.

    Args:
        name: of the system, as ``resolve`` takes it.
        parameters: of all runs.
        frames_every: seed -> seconds between two frames; no frames for other seeds.
        sources: hash of the sources that results are kept under; a worker that imports others refuses to run.
        recordings: folder in which every run is recorded, None for no recordings.
    """
    return partial(_perform, name, as_json(parameters), dict(frames_every), sources, recordings=recordings)


def row_function(name: str, parameters: BaseModel, sources: str, keep: tuple[str, ...] = ()) -> Function:
    """Return the function that a cell of a campaign repeats: it gives the row, and only the tables in ``keep``."""
    return partial(_perform_kept, name, as_json(parameters), sources, keep)


def _perform_kept(
    system: str, parameters: bytes, sources: str, keep: tuple[str, ...], seed: int, watch: Watch | None
) -> Result:
    every = {seed: FRAMES_EVERY} if "frames" in keep else {}
    result = _perform(system, parameters, every, sources, seed, watch)
    return result._replace(tables={name: result.tables[name] for name in keep})


def _perform(
    system: str,
    parameters: bytes,
    frames_every: Mapping[int, float],
    sources: str,
    seed: int,
    watch: Watch | None,
    recordings: Path | None = None,
) -> Result:
    if sources_of(resolve(system)) != sources:
        raise ChangedSources("the sources were edited while the set ran; run the same command again")
    every = frames_every.get(seed)
    if recordings is not None:
        recorded = record_run(system, parameters, seed, recordings, watch)
        if every is None:
            return result_of(recorded, resolve(system).kinds, None)
    return result_of(run_trial(system, parameters, seed, every, watch), resolve(system).kinds, every)


def recording_of(folder: Path, seed: int) -> Path:
    """Return where the recording of a run is kept."""
    return folder / f"seed-{seed}.recording"


def record_run(system: str, parameters: bytes, seed: int, folder: Path, watch: Watch | None) -> Trial:
    """Run a trial and record it."""
    from formicarium.views.recording.recorded import record_trial

    found = resolve(system)
    given = found.parameters.model_validate_json(parameters)
    head = {**configuration_of(found, given).content(), "name": system, "seed": seed, "kinds": list(found.kinds)}
    return record_trial(found, given, seed, recording_of(folder, seed), head, RECORDED_EVERY, watch)


def as_json(parameters: BaseModel) -> bytes:
    """Write parameters as JSON that reads back as the same parameters, infinities included."""
    return to_json(parameters.model_dump(), inf_nan_mode="constants")


def configuration_of(system: System, parameters: BaseModel) -> Configuration:
    """Return what decides the results of a system with these parameters."""
    plain: Any = from_json(as_json(parameters))
    return Configuration(system.name, plain, sources_of(system), __version__)

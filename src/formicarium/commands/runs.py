"""A run as a person names it: a recording, or a folder of results."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from pydantic import ValidationError

from formicarium.campaigns import table
from formicarium.campaigns.files import StoreError, read_json
from formicarium.commands.errors import UserError
from formicarium.commands.fields import in_words
from formicarium.commands.known import find_system
from formicarium.commands.tables import trial_of
from formicarium.commands.work import configuration_of
from formicarium.systems.registry import System
from formicarium.trial.record import Frames, Scene
from formicarium.trial.watching import Intervention
from formicarium.views.recording.log import read_recording

RECORDINGS = "recordings"


class Run(NamedTuple):
    """A stored run: what is needed to simulate it again, and what was kept of it."""

    path: Path  # of the recording, or of the folder
    system: System
    parameters: Any
    seed: int
    interventions: tuple[Intervention, ...]
    scene: Scene
    frames: Frames | None
    events: np.ndarray
    checks: Mapping[int, bytes]  # digests by cycle, empty for a run that was not recorded
    outcome: Mapping[str, Any] | None  # None if the run was left before its end
    end: int  # last cycle that is known
    same_sources: bool  # whether simulating again means something

    @property
    def title(self) -> str:
        """Name for people."""
        return f"{self.system.name}, seed {self.seed}"


def find_run(place: str, seed: int | None) -> Run:
    """Return the run at ``place``.

    Raises:
        UserError: if there is none, or several and no seed is given.
        StoreError: if a file is damaged.
    """
    path = Path(place)
    if path.is_file():
        return recorded_run(path)
    if not path.is_dir():
        raise UserError(f"there is no run {place}: name a recording, or a folder that formicarium run has made")
    found = recordings_in(path)
    if seed is not None:
        found = [file for file in found if file.stem == f"seed-{seed}"]
    stored = read_seeds(path) if seed is None else [number for number in read_seeds(path) if number == seed]
    if len(found) == 1 and (seed is not None or len(stored) < 2):
        return recorded_run(found[0])
    if not found and len(stored) == 1:
        return stored_run(path, stored[0])
    if not found and not stored:
        raise UserError(f"{place} holds no run{'' if seed is None else f' with seed {seed}'}")
    names = ", ".join([file.name for file in found[:8]] or [f"seed {number}" for number in stored[:8]])
    raise UserError(f"{place} holds several runs: say which with --seed, or name the file ({names})")


def recordings_in(folder: Path) -> list[Path]:
    """Return the recordings of a folder, sorted by name."""
    return sorted([*folder.glob("*.recording"), *(folder / RECORDINGS).glob("*.recording")])


def read_seeds(folder: Path) -> list[int]:
    """Return the seeds of the runs in a folder of results."""
    path = folder / "runs.parquet"
    return [int(seed) for seed in table.read(path)["seed"].to_pylist()] if path.exists() else []


def recorded_run(path: Path) -> Run:
    """Return the run of a recording."""
    recording = read_recording(path)
    if not recording.head.get("name"):
        raise UserError(f"{path} does not say of which system it is")
    system, parameters, same = _known(path, str(recording.head["name"]), recording.head)
    return Run(
        path, system, parameters, int(recording.head["seed"]), recording.interventions, recording.scene,
        recording.frames, recording.events, recording.checks, recording.outcome, recording.end, same,
    )  # fmt: skip


def stored_run(folder: Path, seed: int) -> Run:
    """Return a run of a folder of results."""
    content = read_json(folder / "configuration.json")
    system, parameters, same = _known(folder, str(content["system"]), content)
    rows = {row["seed"]: row for row in table.read(folder / "runs.parquet").to_pylist()}
    events = folder / "events" / f"seed-{seed}.parquet"
    frames = folder / "frames" / f"seed-{seed}.parquet"
    if not events.exists():
        raise StoreError(f"{events} is missing")
    trial = trial_of(rows[seed], table.read(events), table.read(frames) if frames.exists() else None, system.kinds)
    end = int(trial.frames.cycle[-1]) if trial.frames is not None else 0
    outcome = {name: value for name, value in rows[seed].items() if name != "seed"}
    return Run(
        folder, system, parameters, seed, (), trial.scene, trial.frames, trial.events, {}, outcome, end, same
    )  # fmt: skip


def _known(path: Path, name: str, content: Mapping[str, Any]) -> tuple[System, Any, bool]:
    """Return system and parameters, and whether the sources are those that made the run."""
    system = find_system(name)
    try:
        parameters = system.parameters.model_validate(content["parameters"])
    except ValidationError as error:
        raise UserError(
            f"{path} was made by another version of {name}, whose parameters this one does not know: {in_words(error)}"
        ) from error
    return system, parameters, configuration_of(system, parameters).sources == content["sources"]

"""A trial as Parquet tables and back: what the folder of results holds of it."""

import json
from collections.abc import Mapping
from typing import Any

import numpy as np
import pyarrow as pa

from formicarium.campaigns.result import Result
from formicarium.campaigns.table import metadata_of, with_metadata
from formicarium.trial.record import EVENT, Frames, Scene, Trial
from formicarium.views.scenes import scene_content, scene_from

EVERY = "every_s"  # metadata of the frames: seconds between two
LISTS = tuple(name for name in Frames._fields if name not in ("cycle", "identity"))  # a value a robot or device


def result_of(trial: Trial, kinds: tuple[str, ...], frames_every: float | None) -> Result:
    """Take a trial apart into its outcome row, a table of events and one of frames."""
    tables = {"events": _events_table(trial.events, kinds, trial.scene)}
    if trial.frames is not None:
        tables["frames"] = with_metadata(_frames_table(trial.frames), {EVERY: str(frames_every)})
    return Result(dict(trial.outcome), tables)


def trial_of(row: Mapping[str, Any], events: pa.Table, frames: pa.Table | None, kinds: tuple[str, ...]) -> Trial:
    """Put a trial together again from its row and tables."""
    outcome = {name: value for name, value in row.items() if name != "seed"}
    scene = scene_from(json.loads(metadata_of(events.schema)["scene"]))
    return Trial(outcome, events_of(events, kinds), None if frames is None else _frames(frames), scene)


def _events_table(events: np.ndarray, kinds: tuple[str, ...], scene: Scene) -> pa.Table:
    columns: dict[str, Any] = {"seconds": events["cycle"] * scene.cycle_time}
    columns.update({name: pa.array(events[name]) for name in EVENT.names or ()})
    columns["kind"] = pa.DictionaryArray.from_arrays(pa.array(events["kind"], pa.int32()), pa.array(kinds))
    return with_metadata(pa.table(columns), {"scene": json.dumps(scene_content(scene))})


def events_of(table: pa.Table, kinds: tuple[str, ...]) -> np.ndarray:
    """Return the events of a table that ``result_of`` made."""
    number = {name: index for index, name in enumerate(kinds)}
    events = np.zeros(len(table), EVENT)
    for name in EVENT.names or ():
        column = table[name].to_pylist() if name == "kind" else table[name].to_numpy()
        events[name] = [number[kind] for kind in column] if name == "kind" else column
    return events


def _frames_table(frames: Frames) -> pa.Table:
    """One row a frame; what belongs to robots or devices is a list in their order."""
    lists = {name: _lists(getattr(frames, name)) for name in LISTS if getattr(frames, name) is not None}
    identity = {"identity_of_robots": json.dumps(frames.identity.tolist())}
    return with_metadata(pa.table({"cycle": frames.cycle, **lists}), identity)


def _lists(values: np.ndarray) -> pa.Array:
    offsets = np.arange(len(values) + 1, dtype=np.int32) * values.shape[1]
    return pa.ListArray.from_arrays(offsets, pa.array(values.ravel()))


def _frames(table: pa.Table) -> Frames:
    identity = np.array(json.loads(metadata_of(table.schema)["identity_of_robots"]), np.int64)
    count = len(table)

    def matrix(name: str) -> np.ndarray:
        values = table[name].combine_chunks().flatten().to_numpy()
        return values.reshape(count, len(values) // max(count, 1))

    lists = {name: matrix(name) for name in LISTS if name in table.column_names}
    return Frames(cycle=table["cycle"].to_numpy(), identity=identity, **lists)

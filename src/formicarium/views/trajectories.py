"""Trajectories and events as plain tables, for any reader."""

import numpy as np
import pyarrow as pa

from formicarium.trial.record import Frames, Scene


def trajectory_table(scene: Scene, frames: Frames) -> pa.Table:
    """Return one row a frame and robot: seconds, robot, x, y (metres), heading (radians), role, carried."""
    count, robots = frames.x.shape
    roles = pa.DictionaryArray.from_arrays(pa.array(frames.role.ravel(), pa.int32()), pa.array(scene.roles))
    return pa.table({
        "cycle": np.repeat(frames.cycle, robots),
        "seconds": np.repeat(np.round(frames.cycle * scene.cycle_time, 6), robots),
        "robot": np.tile(frames.identity, count),
        "x": frames.x.ravel(),
        "y": frames.y.ravel(),
        "heading": frames.heading.ravel(),
        "role": roles.cast(pa.string()),
        "carried": frames.carried.ravel(),
    })  # fmt: skip


def event_table(scene: Scene, events: np.ndarray, kinds: tuple[str, ...], sentences: list[str]) -> pa.Table:
    """Return one row an event: seconds, kind by name, robot, subject, value, detail and a sentence."""
    columns = {name: np.ascontiguousarray(events[name]) for name in ("robot", "subject", "value", "detail")}
    return pa.table({
        "cycle": np.ascontiguousarray(events["cycle"]),
        "seconds": np.round((events["cycle"] + 1) * scene.cycle_time, 6),
        "kind": [kinds[int(kind)] for kind in events["kind"]],
        **columns,
        "sentence": sentences,
    })  # fmt: skip

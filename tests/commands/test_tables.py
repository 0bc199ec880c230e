"""A trial survives being taken apart into tables."""

import numpy as np

import random_walk
from formicarium.campaigns import table
from formicarium.commands.tables import result_of, trial_of


def test_a_trial_comes_back_from_its_files(tmp_path):
    trial = random_walk.run(random_walk.configure(), 5, frames_every=2.0)
    result = result_of(trial, random_walk.KINDS, 2.0)
    for name, content in result.tables.items():
        table.write(content, tmp_path / name)
    events, frames = table.read(tmp_path / "events"), table.read(tmp_path / "frames")
    back = trial_of({"seed": 5, **result.row}, events, frames, random_walk.KINDS)
    assert back.outcome == trial.outcome
    assert np.array_equal(back.events, trial.events)
    for name, values in trial.frames._asdict().items():
        assert np.array_equal(getattr(back.frames, name), values), name
        assert getattr(getattr(back.frames, name), "dtype", None) == getattr(values, "dtype", None), name
    assert back.scene.roles == trial.scene.roles
    for mine, theirs in zip(back.scene.polygons, trial.scene.polygons, strict=True):
        assert mine.colour == theirs.colour
        assert np.array_equal(mine.points, theirs.points)


def test_kinds_are_names_and_times_are_seconds():
    trial = random_walk.run(random_walk.configure(), 5)
    events = result_of(trial, random_walk.KINDS, None).tables["events"]
    assert set(events["kind"].to_pylist()) == set(random_walk.KINDS)
    assert np.allclose(events["seconds"].to_numpy(), trial.events["cycle"] * 0.1)


def test_a_trial_without_frames_events_or_devices_survives(tmp_path):
    trial = random_walk.run(random_walk.configure(), 5, frames_every=50.0)
    trial = trial._replace(events=trial.events[:0], frames=trial.frames._replace(lit=trial.frames.lit[:, :0]))
    result = result_of(trial, random_walk.KINDS, 50.0)
    for name, content in result.tables.items():
        table.write(content, tmp_path / name)
    events, frames = table.read(tmp_path / "events"), table.read(tmp_path / "frames")
    back = trial_of(result.row, events, frames, random_walk.KINDS)
    assert back.frames.lit.shape == trial.frames.lit.shape
    assert len(back.events) == 0

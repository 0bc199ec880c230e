"""What programs call: it is small, light, and does what its words say."""

import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import formicarium
from formicarium.campaigns.files import StoreError
from formicarium.commands.errors import UserError

WALK = "random_walk:RANDOM_WALK"


def test_every_name_is_there_has_words_and_types():
    assert len(formicarium.__all__) == 10 and sorted(formicarium.__all__) == list(formicarium.__all__)
    for name in formicarium.__all__:
        found = getattr(formicarium, name)
        assert found.__doc__ and name in dir(formicarium)
        if not isinstance(found, type):
            assert found.__annotations__.get("return") is not None
    with pytest.raises(AttributeError, match="run_trial"):
        formicarium.run_trail  # noqa: B018


def test_importing_it_imports_nothing_heavy():
    program = "import sys, formicarium; print({'numba', 'numpy', 'pydantic', 'pyarrow'} & set(sys.modules))"
    done = subprocess.run(
        [sys.executable, "-X", "importtime", "-c", program], capture_output=True, text=True, check=True
    )
    assert done.stdout.strip() == "set()"
    micro = int(next(line for line in done.stderr.splitlines() if line.endswith(" formicarium")).split("|")[1])
    assert micro < 500_000


def test_a_trial_and_its_parameters():
    chosen = formicarium.parameters(WALK, robots=7, changes={"dwell_time": 3.0, "trial.duration": 100.0})
    trial = formicarium.run_trial(WALK, 4, parameters=chosen, frames_every=1.0)
    assert isinstance(trial, formicarium.Trial) and trial.outcome["robots"] == 7
    assert trial.frames.x.shape == (101, 7) and trial.outcome["duration_s"] == 100.0
    with pytest.raises(UserError, match="dwell_tim"):
        formicarium.parameters(WALK, changes={"dwell_tim": 3.0})
    with pytest.raises(UserError, match="unknown system"):
        formicarium.run_trial("mark-i33")


def test_a_set_is_kept_loaded_and_drawn(tmp_path):
    done = formicarium.run_set(WALK, range(3, 6), out=tmp_path / "set", workers=1, frames_every=50.0)
    assert done.columns["seed"].tolist() == [3, 4, 5] and done.columns["time_10_s"].dtype == float
    more = formicarium.run_set(WALK, [3, 9], out=tmp_path / "set", workers=1)
    assert more.columns["seed"].tolist() == [3, 9]
    loaded = formicarium.load_results(tmp_path / "set", WALK)
    assert loaded.columns["seed"].tolist() == [3, 4, 5, 9]
    trial = loaded.trial(4)
    again = formicarium.run_trial(WALK, 4, frames_every=50.0)
    assert trial.events.tobytes() == again.events.tobytes() and np.array_equal(trial.frames.x, again.frames.x)
    picture = formicarium.plot_run_times(loaded, tmp_path / "all.png", title="walks")
    assert picture.stat().st_size > 10_000
    own = formicarium.plot_run_times({"mine": ([3.0, None], [9.0, 9.0])}, tmp_path / "own.svg")
    assert own.read_text().startswith("<?xml")
    with pytest.raises(StoreError, match="no trial with seed 77"):
        loaded.trial(77)
    with pytest.raises(StoreError, match=r"no runs\.parquet"):
        formicarium.load_results(tmp_path)


def test_a_campaign_gives_one_tidy_table(tmp_path):
    design = {"name": "walks", "system": WALK, "replicates": 2, "factors": {"robots": [5, 9]}}
    done = formicarium.run_campaign(design, out=tmp_path / "walks", workers=1)
    assert done.columns["robots"].tolist() == [5, 5, 9, 9] and done.columns["replicate"].tolist() == [0, 1, 0, 1]


def test_a_run_that_fails_says_so_and_the_others_are_kept(tmp_path):
    chosen = formicarium.parameters(WALK, changes={"failing_seed": 2})
    with pytest.raises(RuntimeError, match=r"(?s)1 of 2 runs failed; seed 2:.*fails on purpose"):
        formicarium.run_set(WALK, [1, 2], parameters=chosen, out=tmp_path / "set", workers=1)
    assert formicarium.load_results(tmp_path / "set", WALK).columns["seed"].tolist() == [1]


def test_it_is_typed():
    assert (Path(formicarium.__file__).parent / "py.typed").exists()

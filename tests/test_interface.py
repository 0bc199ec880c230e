"""What programs call: it is small, light, and does what its words say."""

import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import formicarium
from formicarium.campaigns.files import StoreError
from formicarium.commands.errors import UserError
from formicarium.scheduling import InstanceError, read_instance

WALK = "random_walk:RANDOM_WALK"


def test_every_name_is_there_has_words_and_types():
    assert len(formicarium.__all__) == 13 and sorted(formicarium.__all__) == list(formicarium.__all__)
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


def test_tasks_are_scheduled_and_the_schedule_is_proven_best(tmp_path):
    pytest.importorskip("highspy")
    (tmp_path / "tasks.csv").write_text("name,x,y,robots\nwell,3,1,2\nmill,-2,4,1\n", encoding="utf-8")
    answer = formicarium.schedule(tmp_path / "tasks.csv", robots=12)
    assert answer.proven and answer.bound <= answer.value and answer.schedule.slots[0].duration == 1.0
    same = {
        "teams": [{"robots": 12}],
        "tasks": [dict(name="well", x=3.0, y=1.0, robots=2), dict(name="mill", x=-2.0, y=4.0)],
    }
    assert formicarium.schedule(same, time_limit=60).value == answer.value
    assert formicarium.schedule(tmp_path / "tasks.csv", robots=np.int64(12)).value == answer.value
    for wrong in ({"robots": True}, {"time_limit": True}, {"time_limit": float("nan")}):
        with pytest.raises(UserError, match=f"{next(iter(wrong))} = "):
            formicarium.schedule(same, **wrong)
    instance = read_instance(tmp_path / "tasks.csv", 12)
    assert formicarium.schedule(instance, objective="time").value == answer.schedule.time
    with pytest.raises(InstanceError, match="--robots"):
        formicarium.schedule(tmp_path / "tasks.csv")
    with pytest.raises(UserError, match="objective = 'speed': must be one of time, travel"):
        formicarium.schedule(instance, objective="speed")
    with pytest.raises(UserError, match="time_limit = 0: must be seconds above 0"):
        formicarium.schedule(instance, time_limit=0)
    with pytest.raises(UserError, match="robots = 12: an Instance has its teams"):
        formicarium.schedule(instance, robots=12)


def test_a_schedule_without_its_solver_says_what_to_type(monkeypatch):
    monkeypatch.setattr("formicarium.commands.extras.find_spec", lambda name: None)
    with pytest.raises(UserError, match=r"formicarium\.schedule needs highspy.*formicarium\[scheduling\]"):
        formicarium.schedule("tasks.csv", robots=12)


def test_how_connected_a_graph_and_a_swarm_are():
    ring = np.roll(np.eye(6, dtype=int), 1, axis=1) + np.roll(np.eye(6, dtype=int), -1, axis=1)
    found = formicarium.connectivity_of(ring)
    assert found.lambda2 == pytest.approx(2 - 2 * np.cos(2 * np.pi / 6)) and found.mu2 == pytest.approx(
        found.lambda2 / 2
    )
    assert (found.diameter, found.vertex_connectivity, found.parts.tolist()) == (3, 2, [0] * 6)
    assert found.estimates is None
    angles = 2 * np.pi * np.arange(6) / 6
    hexagon = np.stack([np.cos(angles), np.sin(angles)], axis=1)  # sides of 1 m
    placed = formicarium.connectivity_of(hexagon, reach=1.01, method="PI1", iterations=1500, seed=4)
    assert np.array_equal(placed.adjacency, ring.astype(bool))
    assert placed.estimates.values.shape == (1500, 6)
    assert np.abs(placed.estimates.values[-1] / found.lambda2 - 1.0).max() < 0.05
    apart = formicarium.connectivity_of(hexagon, reach=0.5)
    assert apart.lambda2 == 0.0 and apart.parts.tolist() == [0, 1, 2, 3, 4, 5] and apart.diameter == -1


@pytest.mark.parametrize(
    ("given", "options", "words"),
    [
        (np.zeros((3, 4)), {}, "square and not empty, this one is 3 x 4"),
        ([[0, 2], [2, 0]], {}, r"entry \(0, 1\) = 2: must be 0 or 1"),
        ([[0.0, 0.0]], {"reach": -1.0}, "reach = -1.0: must be a distance in metres above 0"),
        ([[0.0, float("nan")]], {"reach": 1.0}, "position 0 is .* must be finite"),
        ([0.0, 1.0], {"reach": 1.0}, r"positions of shape \(2,\): must be \(K, 2\) or \(K, 3\)"),
        ([[0, 1], [1, 0]], {"method": "PI3"}, "method = 'PI3': must be one of PI1, PI2, Wave"),
        ([[0, 1], [1, 0]], {"method": "PI1", "drop": 2.0}, "drop = 2.0: must be a probability"),
        ([[0, 1], [1, 0]], {"method": "PI1", "iterations": 0}, "iterations = 0: must be at least 1"),
        ([[0, 0], [0, 0]], {"method": "PI1"}, "is in parts, so there is nothing"),
    ],
)
def test_what_is_no_graph_is_told(given, options, words):
    with pytest.raises((UserError, ValueError), match=words):
        formicarium.connectivity_of(given, **options)


def test_names_do_not_depend_on_what_was_imported_before():
    pair = "formicarium.connectivity_of([[0, 1], [1, 0]]).lambda2"
    program = f"import formicarium.connectivity.exact, formicarium; print({pair})"
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    assert float(done.stdout) == pytest.approx(2.0)


def test_it_is_typed():
    assert (Path(formicarium.__file__).parent / "py.typed").exists()

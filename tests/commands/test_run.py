"""``formicarium run`` on a system without a simulator: what it leaves, what it says, what it refuses."""

import json
import subprocess
import sys

import pyarrow.parquet as pq
import pytest

from formicarium.commands import session
from formicarium.commands.main import exit_code

WALK = "random_walk:RANDOM_WALK"


@pytest.fixture(autouse=True)
def elsewhere(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("COLUMNS", "160")
    return tmp_path


def run(*arguments):
    return exit_code(["run", WALK, *map(str, arguments)])


def names(folder):
    return {str(path.relative_to(folder)) for path in folder.rglob("*") if path.is_file()}


def test_a_single_run_leaves_tables_pictures_and_its_configuration(tmp_path, capsys):
    assert run("--seed", 3, "--out", "here") == 0
    assert names(tmp_path / "here") == {
        *(".lock", "configuration.json", "provenance.json", "runs.parquet", "timings.parquet"),
        *("events/seed-3.parquet", "frames/seed-3.parquet", "frame-end-seed-3.png", "timeline-seed-3.png"),
    }
    said = capsys.readouterr().out
    assert "1 of 1 run done (seed 3)" in said
    assert "10 sequences" in said
    assert "here/timeline-seed-3.png" in said


def test_the_folder_is_named_after_what_was_asked_for(tmp_path):
    assert run("--robots", 5, "--set", "dwell_time=4") == 0
    (folder,) = (tmp_path / "formicarium-results").iterdir()
    configuration = json.loads((folder / "configuration.json").read_text())
    assert folder.name == f"random-walk-{configuration['identity'][:8]}"
    assert configuration["parameters"]["swarm"]["robots"] == 5
    assert configuration["parameters"]["booth"]["dwell_time"] == 4.0
    assert json.loads((folder / "provenance.json").read_text())["sessions"][0]["packages"]["numpy"]


def test_a_set_is_summed_up(tmp_path, capsys):
    assert run("--runs", 12, "--out", "here", "--workers", 1) == 0
    said = capsys.readouterr().out
    assert "12 of 12 runs done (seeds 1 to 12)" in said
    assert "95 % interval" in said
    assert "260 s" in said  # published median of 5 sequences
    table = pq.read_table(tmp_path / "here" / "runs.parquet")
    assert table["seed"].to_pylist() == list(range(1, 13))
    unfinished = sum(cause is not None for cause in table["cause"].to_pylist())
    assert unfinished and f"{unfinished} of 12: too slow" in said
    assert (tmp_path / "here" / "runtimes.png").exists()
    assert not (tmp_path / "here" / "frames").exists()


def test_the_same_command_loads(tmp_path, capsys):
    run("--runs", 3, "--out", "here", "--workers", 1)
    before = (tmp_path / "here" / "runs.parquet").stat().st_mtime_ns
    assert run("--runs", 3, "--out", "here", "--workers", 1) == 0
    assert "3 of them loaded" in capsys.readouterr().out
    assert (tmp_path / "here" / "runs.parquet").stat().st_mtime_ns == before
    assert len(json.loads((tmp_path / "here" / "provenance.json").read_text())["sessions"]) == 1


def test_a_set_takes_in_a_single_run_and_its_frames(tmp_path):
    run("--runs", 2, "--out", "here", "--workers", 1)
    rows = pq.read_table(tmp_path / "here" / "runs.parquet").to_pylist()
    assert run("--seed", 2, "--out", "here", "--frames", 5) == 0
    assert pq.read_table(tmp_path / "here" / "runs.parquet").to_pylist() == rows
    frames = pq.read_table(tmp_path / "here" / "frames" / "seed-2.parquet")
    assert frames["cycle"].to_pylist()[:3] == [0, 50, 100]
    assert run("--seed", 2, "--out", "here", "--frames", 10) == 0
    frames = pq.read_table(tmp_path / "here" / "frames" / "seed-2.parquet")
    assert frames["cycle"].to_pylist()[:3] == [0, 100, 200]


def test_movies_of_all_runs_or_of_the_first(tmp_path, monkeypatch):
    short = ("--set", "duration=20", "--workers", 1, "--movie", "--frames", 1)
    assert run("--runs", 2, "--out", "few", *short) == 0
    assert len(list((tmp_path / "few").glob("movie-seed-*"))) == 2
    monkeypatch.setattr(session, "MOVIES", 1)
    assert run("--runs", 2, "--out", "many", *short[:-2]) == 0
    assert [path.stem for path in (tmp_path / "many").glob("movie-*")] == ["movie-seed-1"]


@pytest.mark.parametrize("workers", [1, 2])
def test_a_failing_run_is_told_and_the_others_are_kept(tmp_path, capsys, workers):
    assert run("--runs", 4, "--set", "failing_seed=2", "--out", "here", "--workers", workers) == 1
    said = capsys.readouterr()
    assert "seed 2 failed" in said.err
    assert "RuntimeError: this seed fails on purpose" in said.err
    assert "3 of 4 runs done (seeds 1 to 4, 1 failed)" in said.out
    assert pq.read_table(tmp_path / "here" / "runs.parquet")["seed"].to_pylist() == [1, 3, 4]


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["run", "random_wak"], ["unknown system 'random_wak'", "registered systems"]),
        (["run", "mark-13"], ["unknown system 'mark-13'", "Did you mean mark-i3 or"]),
        (["run", "random_walk:NOTHING"], ["no system", "NOTHING"]),
        (["run", "no_such_module:NOTHING"], ["no system", "no_such_module"]),
        (["run", "random_walk:configure"], ["no system but a function"]),
        (["run", WALK, "--robots", "0"], ["--robots 0", "greater than or equal to 1"]),
        (["run", WALK, "--robots", "300"], ["--robots 300", "less than or equal to 200"]),
        (["run", WALK, "--robots", "many"], ["many", "--help"]),
        (["run", WALK, "--setting", "9"], ["--setting 9", "0, 1, 2, 3, 4"]),
        (["run", WALK, "--set", "dwel=4"], ["--set dwel", "Did you mean", "dwell_time"]),
        (["run", WALK, "--set", "dwell_time=99"], ["--set booth.dwell_time=99", "0 to 60 s"]),
        (["run", WALK, "--runs", "0"], ["--runs 0", "at least 1"]),
        (["run", WALK, "--workers", "-1"], ["--workers -1", "at least 1"]),
        (["run", WALK, "--seed", "-1"], ["--seed -1", "from 0"]),
        (["run", WALK, "--frames", "0"], ["--frames 0", "above 0"]),
        (["run", WALK, "--frames", "nan"], ["--frames nan", "above 0"]),
        (["run", WALK, "--mvie"], ["--mvie", "--movie", "formicarium run --help"]),
        (["run", WALK, "--out", "/dev/null/x"], ["/dev/null", "Choose another folder"]),
        (["run"], ["SYSTEM", "formicarium run --help"]),
        (["rum"], ["rum", "run"]),
        (["describe", "nothing"], ["unknown system 'nothing'"]),
    ],
)
def test_bad_input_is_one_message_with_the_way_out(tmp_path, capsys, arguments, words):
    assert exit_code(arguments) == 2
    said = capsys.readouterr()
    for word in words:
        assert word in said.err
    assert said.err.startswith("formicarium: ")
    assert "Traceback" not in said.err
    assert not said.out
    assert not list(tmp_path.rglob("*.parquet"))


def test_a_file_in_place_of_the_folder_is_refused_and_kept(tmp_path, capsys):
    (tmp_path / "mine.txt").write_text("precious")
    assert run("--out", "mine.txt") == 2
    assert "cannot write mine.txt" in capsys.readouterr().err
    assert (tmp_path / "mine.txt").read_text() == "precious"


def test_a_damaged_results_file_is_refused_and_kept(tmp_path, capsys):
    run("--runs", 3, "--out", "here", "--workers", 1)
    path = tmp_path / "here" / "runs.parquet"
    path.write_bytes(path.read_bytes()[:100])
    assert run("--runs", 5, "--out", "here", "--workers", 1) == 2
    said = capsys.readouterr().err
    assert "here/runs.parquet is damaged" in said
    assert "Move it away" in said
    assert path.stat().st_size == 100
    path.rename(tmp_path / "away")
    assert run("--runs", 5, "--out", "here", "--workers", 1) == 0


def test_another_configuration_in_the_folder_is_refused(capsys):
    run("--out", "here")
    assert run("--out", "here", "--set", "dwell_time=4") == 2
    assert "booth.dwell_time = 8.0, now 4.0" in capsys.readouterr().err


def test_a_defect_leaves_its_traceback_in_a_file(tmp_path, capsys, monkeypatch):
    monkeypatch.setattr(session, "print_summary", None)
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    assert run() == 1
    said = capsys.readouterr().err
    assert "unexpected TypeError" in said
    (file,) = tmp_path.glob("formicarium-*.txt")
    assert str(file) in said
    assert "Traceback" in file.read_text()


def test_describe_and_systems_list_what_there_is(capsys):
    assert exit_code(["describe", WALK]) == 0
    said = capsys.readouterr().out
    for word in ("booth.dwell_time", "8.0", "0 to 60", "of a task (invented)", "m/s"):
        assert word in said


@pytest.mark.parametrize(
    "arguments",
    [
        ["--help"],
        ["run", "--help"],
        ["describe", "--help"],
        ["campaign", "--help"],
        ["campaign", "run", "--help"],
        ["--version"],
    ],
)
def test_help_is_answered_without_importing_anything_heavy(arguments):
    code = (
        "import sys; from formicarium.commands.main import exit_code; "
        f"assert exit_code({arguments!r}) == 0; "
        "heavy = {'numba', 'numpy', 'matplotlib', 'scipy', 'pyarrow', 'pydantic'} & sys.modules.keys(); "
        "assert not heavy, heavy"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    assert "formicarium" in done.stdout or "0." in done.stdout

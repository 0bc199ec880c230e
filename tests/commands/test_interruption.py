"""Real processes, interrupted and killed: what was done stays, the same command continues, each run once."""

import io
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pyarrow.parquet as pq
import pytest

RUNS = 12
TESTS = Path(__file__).parents[1]
pytestmark = pytest.mark.skipif(os.name != "posix", reason="signals of POSIX systems")


def command(folder, *more, pause=0.3):
    arguments = [
        "run",
        "random_walk:RANDOM_WALK",
        "--runs",
        RUNS,
        "--out",
        folder,
        "--set",
        f"pause={pause}",
        *more,
    ]
    return [sys.executable, "-m", "formicarium.commands.main", *map(str, arguments)]


def start(folder, *more, **options):
    path = os.pathsep.join([str(TESTS), os.environ.get("PYTHONPATH", "")])
    return subprocess.Popen(
        command(folder, *more, **options), env={**os.environ, "PYTHONPATH": path}, text=True,
        stdout=subprocess.PIPE, stderr=subprocess.PIPE, start_new_session=True,
    )  # fmt: skip


def seeds_in(folder):
    path = folder / "runs.parquet"
    return pq.read_table(io.BytesIO(path.read_bytes()))["seed"].to_pylist() if path.exists() else []


def wait_for_rows(folder, count, process):
    until = time.monotonic() + 60
    while len(seeds_in(folder)) < count:
        assert process.poll() is None, process.communicate()
        assert time.monotonic() < until
        time.sleep(0.02)


def finish(process):
    said = process.communicate(timeout=120)
    return process.returncode, *said


def group_is_gone(process):
    until = time.monotonic() + 10
    while time.monotonic() < until:
        try:
            os.killpg(process.pid, 0)
        except ProcessLookupError:
            return True
        time.sleep(0.05)
    return False


def row_columns(folder):
    return pq.read_table(folder / "runs.parquet").to_pylist()


@pytest.fixture(scope="module")
def undisturbed(tmp_path_factory):
    folder = tmp_path_factory.mktemp("undisturbed") / "set"
    assert finish(start(folder, "--workers", 2))[0] == 0
    return folder


@pytest.mark.parametrize("workers", [1, 2])
def test_ctrl_c_keeps_what_is_done_and_the_same_command_continues(tmp_path, undisturbed, workers):
    folder = tmp_path / "set"
    process = start(folder, "--workers", workers)
    wait_for_rows(folder, 3, process)
    os.killpg(process.pid, signal.SIGINT)  # as a terminal does: to the command and all its workers
    code, _, said = finish(process)
    done = seeds_in(folder)
    assert code == 130
    assert f"interrupted: {len(done)} of {RUNS} runs are done" in said
    assert "same command continues" in said
    assert "Traceback" not in said
    assert 3 <= len(done) < RUNS
    assert group_is_gone(process)
    code, out, _ = finish(start(folder, "--workers", workers))
    assert code == 0
    assert f"{len(done)} of them loaded" in out
    assert row_columns(folder) == row_columns(undisturbed)


def test_kill_9_loses_only_what_was_in_flight(tmp_path, undisturbed):
    folder = tmp_path / "set"
    for wanted in (2, 5):
        process = start(folder, "--workers", 2)
        wait_for_rows(folder, wanted, process)
        process.kill()
        process.wait()
        assert group_is_gone(process), "workers outlived their parent"
        assert len(seeds_in(folder)) >= wanted
    assert finish(start(folder, "--workers", 2))[0] == 0
    assert seeds_in(folder) == list(range(1, RUNS + 1))
    for path in sorted(undisturbed.rglob("*.parquet")):
        if path.name != "timings.parquet":
            assert (folder / path.relative_to(undisturbed)).read_bytes() == path.read_bytes(), path.name
    assert not list(folder.rglob(".partial*"))


def test_a_second_command_on_the_same_folder_is_refused(tmp_path):
    folder = tmp_path / "set"
    process = start(folder, "--workers", 2)
    wait_for_rows(folder, 1, process)
    code, _, said = finish(start(folder))
    assert code == 2
    assert "is in use" in said
    assert finish(process)[0] == 0
    assert seeds_in(folder) == list(range(1, RUNS + 1))


def test_a_worker_that_is_killed_costs_one_run(tmp_path):
    code, out, said = finish(start(tmp_path / "set", "--workers", 2, "--set", "dying_seed=5", pause=0))
    assert code == 1
    assert "seed 5 failed" in said
    assert "exit code -9" in said
    assert f"{RUNS - 1} of {RUNS} runs done" in out

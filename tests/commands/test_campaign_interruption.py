"""A campaign as a real process: watched from another terminal, ended by Ctrl-C or by a batch system, gone on with."""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from formicarium.campaigns.ledger import Ledger
from formicarium.commands.main import exit_code

TESTS = Path(__file__).parents[1]
DESIGN = """
name = "walk"
system = "random_walk:RANDOM_WALK"
first_seed = 1
replicates = 4
set = { pause = 2.0 }
[factors]
robots = [5, 9]
"""
pytestmark = pytest.mark.skipif(os.name != "posix", reason="signals of POSIX systems")


@pytest.fixture(autouse=True)
def design(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "study.toml").write_text(DESIGN)


def start(*more):
    path = os.pathsep.join([str(TESTS), os.environ.get("PYTHONPATH", "")])
    words = ["campaign", "run", "study.toml", "--out", "here", "--workers", "2", *more]
    return subprocess.Popen(
        [sys.executable, "-m", "formicarium.commands.main", *words],
        env={**os.environ, "PYTHONPATH": path}, text=True,
        stdout=subprocess.PIPE, stderr=subprocess.PIPE, start_new_session=True,
    )  # fmt: skip


def done(folder):
    ledger = Ledger(folder)
    ledger.refresh()
    return len(ledger.done)


def wait_for_rows(folder, count, process):
    until = time.monotonic() + 60
    while done(folder) < count:
        assert process.poll() is None, process.communicate()
        assert time.monotonic() < until
        time.sleep(0.05)


@pytest.mark.parametrize(
    ("ending", "more"),
    [
        ("SIGINT", ()),
        pytest.param("SIGTERM", (), marks=pytest.mark.long),
        pytest.param("SIGINT", ("--dask", "local"), marks=pytest.mark.long),
    ],
)
def test_an_ended_campaign_says_what_is_done_and_goes_on(tmp_path, capsys, ending, more):
    process = start(*more)
    wait_for_rows(tmp_path / "here", 2, process)
    assert exit_code(["campaign", "status", "study.toml", "--out", "here"]) == 1
    assert "missing; 1 at work on it now" in capsys.readouterr().out
    if ending == "SIGINT":
        os.killpg(process.pid, signal.SIGINT)  # as a terminal does: to the command and all its workers
    else:
        process.terminate()
    _, said = process.communicate(timeout=60)
    before = done(tmp_path / "here")
    assert process.returncode == 130
    assert f"interrupted: {before} of 8 runs are done and kept in here. The same command continues." in said
    assert "Traceback" not in said
    assert not list((tmp_path / "here" / "writers").iterdir())
    until = time.monotonic() + 10
    with pytest.raises(ProcessLookupError):
        while time.monotonic() < until:
            os.killpg(process.pid, 0)
            time.sleep(0.05)
    out, said = start().communicate(timeout=60)
    assert f"8 of 8 runs done, {before} of them loaded" in out, said

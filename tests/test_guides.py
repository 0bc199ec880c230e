"""The guides are executed: files are written, commands typed, Python run, up to the cluster's door."""

import os
import re
import shlex
import socket
import subprocess
from pathlib import Path

import pyarrow.parquet as pq
import pytest

from formicarium.commands.campaign import study
from formicarium.commands.main import exit_code
from hardware.emulated import EmulatedEPuck2, OnTcp

ROOT = Path(__file__).parents[1]
BLOCK = re.compile(r"^<!-- (?P<kind>[^>]+?) -->\n```\w*\n(?P<text>.*?)^```$", re.MULTILINE | re.DOTALL)
SHORT = ["--set", "time_cap=20"]  # simulated seconds
CHANGING = {"plan", "run", "status", "collect", "clean", "pack", "adopt"}  # verbs that take --set


def typed(line):
    words = shlex.split(line)
    assert words[0] == "formicarium"
    if words[1] == "run":
        words += [*SHORT, "--workers", "1"]
    elif words[1] == "campaign" and words[2] in CHANGING:
        words += SHORT
    return words[1:]


def submitted(script):
    """Do what Slurm would do with an array of tasks: all at once."""
    last = int(re.search(r"^#SBATCH --array=0-(\d+)$", Path(script).read_text(), re.MULTILINE)[1])
    environments = [{**os.environ, "SLURM_ARRAY_TASK_ID": str(task)} for task in range(last + 1)]
    tasks = [subprocess.Popen(["bash", script], env=environment) for environment in environments]
    assert [task.wait(timeout=120) for task in tasks] == [0] * len(tasks)


def execute(kind, text, codes=None):
    if kind.startswith("file: "):
        Path(kind.removeprefix("file: ")).write_text(text)
    elif kind == "commands":
        for line in text.splitlines():
            assert exit_code(typed(line)) == (codes or {}).get(line.split()[1], 0), line
    elif kind == "python":
        exec(compile(text, "guide.md", "exec"), {})
    elif kind == "sbatch":
        submitted(shlex.split(text)[1])
    else:
        assert kind == "at the cluster"


def follow(guide, codes=None):
    """Do all that a guide says, in its order; ``codes`` as of ``execute``."""
    text = (ROOT / "docs" / "guides" / f"{guide}.md").read_text(encoding="utf-8")
    blocks = BLOCK.findall(text)
    assert len(blocks) == text.count("```") // 2
    for kind, content in blocks:
        execute(kind, content, codes)


@pytest.mark.long
def test_the_guide_to_campaigns_is_true(tmp_path, monkeypatch):
    pytest.importorskip("distributed")
    monkeypatch.chdir(tmp_path)
    short, original = study.Overrides(settings=(SHORT[1],)), study.open_study
    monkeypatch.setattr(study, "open_study", lambda path, out, given=short: original(path, out, given))
    follow("campaigns")
    assert exit_code(["campaign", "plan", "settings.toml", *SHORT]) == 0
    assert exit_code(["campaign", "run", "study.toml", "--workers", "1", "--out", "alone", *SHORT]) == 0
    names = ("alone", "formicarium-results/how-many", "on-dask", "on-slurm")
    for name in names:
        assert exit_code(["campaign", "collect", "study.toml", "--out", name, *SHORT]) == 0
    assert pq.read_table("alone/runs.parquet").num_rows == 8
    assert len({Path(name, "runs.parquet").read_bytes() for name in names}) == 1  # one process, two, Dask, a job array


def test_the_guide_to_watching_is_true(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    shown = []
    for place in ("showing", "replaying"):
        monkeypatch.setattr(f"formicarium.commands.{place}.show", lambda session, *_: shown.append(session) or 0)
    follow("watching", {"diff": 1})
    assert len(shown) == 2
    names = {file.name for file in tmp_path.iterdir()}
    assert names >= {"seven.mp4", "seven.svg", "seven.html", "seed-7.mcap", "trajectories-seed-7.csv"}


def test_the_guide_to_connectivity_is_true(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    follow("connectivity")
    results = tmp_path / "formicarium-results"
    assert (results / "connectivity-swarm" / "errors.csv").exists()
    assert (results / "connectivity-seven" / "lambda2.png").exists()


def test_the_guide_to_learning_is_true(tmp_path, monkeypatch):
    pytest.importorskip("pettingzoo")
    monkeypatch.chdir(tmp_path)
    follow("learning")


def test_the_guide_to_a_real_robot_is_true_of_an_emulated_one(monkeypatch):
    robot = EmulatedEPuck2()
    robot.proximity[0] = 4095
    end, connect = OnTcp(robot), socket.create_connection

    def redirected(place, **options):
        assert place == ("192.168.1.20", 1000)
        return connect(("127.0.0.1", end.port), **options)

    monkeypatch.setattr("formicarium.hardware.lines.socket.create_connection", redirected)
    follow("real_robot")
    end.close()
    turned_left, stopped = robot.heard[-2], robot.heard[-1]
    assert turned_left[3] > turned_left[1] and turned_left[6] == 100 and stopped == bytes(19)


def test_the_guide_to_scheduling_is_true(tmp_path, monkeypatch):
    pytest.importorskip("highspy")
    monkeypatch.chdir(tmp_path)
    follow("scheduling")
    assert {file.name for file in (tmp_path / "rescue").iterdir()} == {"schedule.json", "map.png", "gantt.png"}


def test_the_guide_to_missions_is_true(tmp_path, monkeypatch):
    pytest.importorskip("highspy")
    monkeypatch.chdir(tmp_path)
    follow("mission")
    for name in ("garden.toml", "street.csv"):  # those of the results page
        published = ROOT / "src" / "formicarium" / "systems" / "coverage" / "published" / "maps" / name
        assert (tmp_path / name).read_text() == published.read_text()

"""A system that no viewer has heard of shows through Frame, Inspection and Intervention alone."""

import shutil
from pathlib import Path

import pyarrow.parquet as pq
import pytest

from formicarium.commands.main import exit_code
from formicarium.views.recording.log import read_recording
from views.conftest import placed, until

TESTS = Path(__file__).parents[1]
NAME = "fireflies:FIREFLIES"


@pytest.fixture
def folder(tmp_path, monkeypatch):
    shutil.copy(TESTS / "fireflies.py", tmp_path)
    monkeypatch.chdir(tmp_path)
    return tmp_path


def test_an_unknown_system_is_watched_touched_recorded_and_replayed(folder, opened, serving):
    with serving("watch", NAME, "--seed", "3", "--paused", "--out", "rec", folder=folder) as address:
        page = opened(address)
        page.evaluate("watching.ask({do: 'seek', cycle: 300})")
        until(page, "watching.now.frame.cycle === 300")
        page.mouse.click(*placed(page, 2))
        until(page, "watching.now.inspection && watching.now.inspection.identity === 3")
        assert page.evaluate("summary.value") == "a firefly" and "phase" in page.inner_text("#inside")
        assert "firefly 1 flashes" in page.inner_text("#events")
        assert page.locator("[data-layer=packets]").is_hidden()  # these have no radio
        page.click("#kill")
        page.click("#booths button")
        until(page, "watching.now.status.interventions.length === 2")
        page.click("#move button")
        until(page, "!notice.hidden")
        assert page.inner_text("#notice") == "fireflies cannot be caught"
        page.evaluate("watching.ask({do: 'seek', cycle: 400})")
        until(page, "watching.now.frame.cycle === 400")
        assert page.evaluate("[watching.now.frame.role[2], watching.now.frame.lit[0]]") == [2, 0]
        assert page.inner_text("#legend").split() == ["D", "6", "dark", "F", "1", "flashing", "G", "1", "gone"]
    recording = read_recording(folder / "rec" / "seed-3.recording")
    assert [deed.deed for deed in recording.interventions] == ["kill", "block"]
    assert exit_code(["replay", "rec", "--check"]) == 0


def test_an_unknown_system_goes_into_movies_pictures_pages_and_tables(folder, capsys):
    assert exit_code(["run", NAME, "--seed", "4", "--record", "--workers", "1", "--out", "out"]) == 0
    assert exit_code(["run", NAME, "--seed", "5", "--record", "--workers", "1", "--out", "out"]) == 0
    assert exit_code(["replay", "out", "--check"]) == 0
    for name in ("a.png", "a.svg", "a.html", "a.gif"):
        assert exit_code(["movie", "out", "--seed", "4", "--out", name, "--every", "20"]) == 0
    for to in ("parquet", "csv", "mcap"):
        assert exit_code(["export", "out", "--seed", "4", "--to", to]) == 0
    recording = read_recording(folder / "out" / "recordings" / "seed-4.recording")
    assert pq.read_table("trajectories-seed-4.parquet").num_rows == recording.frames.x.size == 401 * 8
    capsys.readouterr()
    assert exit_code(["diff", "out", "out", "--seed-a", "4", "--seed-b", "5"]) == 1
    assert "cycle 0 (0:00), robot" in capsys.readouterr().out

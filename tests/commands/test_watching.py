"""watch, replay, diff, movie and export as they are typed."""

import json
import re
import shutil
import socket
import struct
import subprocess
import sysconfig
from pathlib import Path

import numpy as np
import pyarrow.csv
import pyarrow.parquet as pq
import pytest
from mcap.reader import make_reader

from formicarium.commands import extras
from formicarium.commands.main import exit_code
from formicarium.commands.replaying import session_of
from formicarium.commands.runs import recorded_run
from formicarium.systems.registry import resolve
from formicarium.views.live.session import Session
from formicarium.views.notebook import Replay
from formicarium.views.parting import first_state_apart
from formicarium.views.recording.blocks import read_blocks
from formicarium.views.recording.log import read_recording
from formicarium.views.recording.recorder import Recorder

SHORT = ["--set", "time_cap=90", "--workers", "1"]


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    place = tmp_path_factory.mktemp("stored")
    assert exit_code(["run", "mark-i3", "--runs", "3", "--seed", "5", "--record", "--out", str(place), *SHORT]) == 0
    return place


def recording(folder, seed):
    return str(folder / "recordings" / f"seed-{seed}.recording")


def test_stored_runs_verify(folder, capsys):
    assert exit_code(["replay", str(folder), "--check"]) == 0
    assert capsys.readouterr().out.count(": verified: 900 cycles") == 3


def test_a_run_that_was_not_recorded_is_verified_by_its_events_and_outcome(tmp_path, capsys):
    assert exit_code(["run", "mark-i3", "--runs", "2", "--out", str(tmp_path), *SHORT]) == 0
    assert exit_code(["replay", str(tmp_path), "--seed", "2", "--check"]) == 0
    assert "no digests" in capsys.readouterr().out
    assert exit_code(["replay", str(tmp_path), "--check"]) == 2
    assert "several runs: say which with --seed" in capsys.readouterr().err


def test_a_flipped_byte_is_reported(folder, tmp_path, capsys):
    content = bytearray(Path(recording(folder, 5)).read_bytes())
    content[len(content) // 2] ^= 8
    (tmp_path / "a.recording").write_bytes(content)
    assert exit_code(["replay", str(tmp_path / "a.recording"), "--check"]) == 1
    assert "is damaged: block" in capsys.readouterr().out


@pytest.mark.parametrize("share", [0.3, 0.62, 0.97])
def test_a_recording_that_was_cut_off_is_good_up_to_there(folder, tmp_path, capsys, share):
    parameters = resolve("mark-i3").configure()
    session = Session(resolve("mark-i3"), parameters, 2)
    path = tmp_path / "whole.recording"
    head = json.loads(next(read_blocks(Path(recording(folder, 5)))).content)
    head = {**head, "parameters": parameters.model_dump(mode="json"), "seed": 2}
    session.record(Recorder(path, head, session.scene, session.state, 5))
    session.advance(4321)
    session.stop()
    content = path.read_bytes()
    cut = tmp_path / "cut.recording"
    cut.write_bytes(content[: int(share * len(content))])
    assert exit_code(["replay", str(path), "--check"]) == exit_code(["replay", str(cut), "--check"]) == 0
    assert re.findall(r"verified: (\d+) cycles", capsys.readouterr().out)[0] == "4321"


def test_a_forged_digest_is_reported(folder, tmp_path, capsys, monkeypatch):
    found = read_recording(folder / "recordings" / "seed-5.recording")
    last = max(found.checks)
    forged = found._replace(checks={**found.checks, last: b"otherwise"[:8]})
    monkeypatch.setattr("formicarium.commands.runs.read_recording", lambda path: forged)
    assert exit_code(["replay", recording(folder, 5), "--check"]) == 1
    assert f"differs from the recording at 1:30 (cycle {last})" in capsys.readouterr().out


def test_other_sources_are_said_and_the_recorded_frames_played(folder, capsys, monkeypatch):
    found = read_recording(folder / "recordings" / "seed-5.recording")
    other = found._replace(head={**found.head, "sources": "0" * 16})
    monkeypatch.setattr("formicarium.commands.runs.read_recording", lambda path: other)
    played = []
    monkeypatch.setattr("formicarium.commands.replaying.show", lambda session, *rest: played.append(session) or 0)
    assert exit_code(["replay", recording(folder, 5)]) == 0
    assert "sources that decide results have changed" in capsys.readouterr().err
    session = played[0]
    session.seek(400)
    k = found.frames.cycle.tolist().index(400)
    assert np.array_equal(session.frame().x[0], found.frames.x[k]) and not session.touchable
    assert exit_code(["replay", recording(folder, 5), "--check"]) == 1
    assert "not verified" in capsys.readouterr().out


def test_the_same_runs_do_not_differ(folder, capsys):
    assert exit_code(["diff", recording(folder, 5), recording(folder, 5)]) == 0
    assert "the runs are the same" in capsys.readouterr().out


def test_where_two_runs_part_is_named(folder, tmp_path, capsys):
    other = tmp_path / "other"
    words = ["run", "mark-i3", "--seed", "5", "--record", "--set", "booth.task_time=9", "--out", str(other), *SHORT]
    assert exit_code(words) == 0
    capsys.readouterr()
    assert exit_code(["diff", recording(folder, 5), str(other)]) == 1
    text = capsys.readouterr().out
    assert "booth.task_time: 7.0 against 9.0" in text
    assert "the runs part at cycle" in text and "field booth_table.task_time: 7.0 against 9.0" in text
    assert exit_code(["diff", str(folder), str(folder), "--seed-a", "5", "--seed-b", "6"]) == 1
    text = capsys.readouterr().out
    assert "seed: 5 against 6" in text and "cycle 0 (0:00), robot" in text and "bodies.x" in text


def test_a_robot_killed_in_one_run_is_where_the_runs_part(folder, tmp_path, capsys):
    run = recorded_run(folder / "recordings" / "seed-5.recording")
    one, other = session_of(run), session_of(run)
    other.advance(333)
    identity = int(other.identity[6])
    other.intervene("kill", identity)
    again = session_of(run._replace(interventions=tuple(other.interventions)))
    parting = first_state_apart(one, again, 900)
    assert (parting.cycle, parting.robot, parting.field) == (333, identity, "robots.dies_at")


@pytest.mark.parametrize("suffix", [".mp4", ".webm", ".gif", ".png", ".svg", ".html"])
def test_a_movie_of_every_kind(folder, tmp_path, suffix):
    out = tmp_path / f"a{suffix}"
    assert exit_code(["movie", recording(folder, 5), "--out", str(out), "--every", "15"]) == 0
    starts = {
        ".mp4": b"ftyp", ".webm": b"\x1a\x45\xdf\xa3", ".gif": b"GIF89a", ".png": b"\x89PNG", ".svg": b"<?xml",
        ".html": b"<!doctype html>",
    }  # fmt: skip
    assert starts[suffix] in out.read_bytes()[:16]
    assert [file.name for file in tmp_path.iterdir()] == [out.name]


def test_a_snapshot_shows_its_moment(folder, tmp_path):
    for at in ("0", "60"):
        assert exit_code(["movie", recording(folder, 5), "--out", str(tmp_path / f"{at}.png"), "--at", at]) == 0
    assert (tmp_path / "0.png").read_bytes() != (tmp_path / "60.png").read_bytes()


@pytest.mark.parametrize("to", ["csv", "parquet"])
def test_trajectories_and_events_come_out_as_tables(folder, tmp_path, to):
    assert exit_code(["export", recording(folder, 5), "--to", to, "--out", str(tmp_path)]) == 0
    read = pq.read_table if to == "parquet" else pyarrow.csv.read_csv
    found = read_recording(folder / "recordings" / "seed-5.recording")
    table = read(tmp_path / f"trajectories-seed-5.{to}")
    assert table.num_rows == found.frames.x.size
    assert np.abs(table["x"].to_numpy() - found.frames.x.ravel()).max() < 1e-6
    assert table["robot"].to_pylist()[:20] == found.frames.identity.tolist()
    events = read(tmp_path / f"events-seed-5.{to}")
    assert events["cycle"].to_pylist() == found.events["cycle"].tolist() and all(events["sentence"].to_pylist())


def test_an_mcap_file_holds_poses_points_scene_numbers_and_events(folder, tmp_path):
    assert exit_code(["export", recording(folder, 5), "--to", "mcap", "--out", str(tmp_path)]) == 0
    found = read_recording(folder / "recordings" / "seed-5.recording")
    with open(tmp_path / "seed-5.mcap", "rb") as file:
        reader = make_reader(file)
        summary = reader.get_summary()
        kinds = {channel.topic: summary.schemas[channel.schema_id].name for channel in summary.channels.values()}
        counts = {summary.channels[k].topic: n for k, n in summary.statistics.channel_message_counts.items()}
        points = [message for _, _, message in reader.iter_messages(topics=["/robots/points"])]
    assert kinds["/robots/poses"] == "foxglove.PosesInFrame" and kinds["/robots/points"] == "foxglove.PointCloud"
    assert kinds["/scene"] == "foxglove.SceneUpdate" and counts["/scene"] == 1
    frames = len(found.frames.cycle)
    assert counts["/robots/poses"] == counts["/robots/points"] == counts["/metrics"] == frames
    assert counts["/events"] == len(found.events)
    k = 37
    assert points[k].log_time == round(found.frames.cycle[k] * 0.1 * 1e9)
    wanted = struct.pack("<ff", found.frames.x[k, 4], found.frames.y[k, 4])
    assert wanted in points[k].data


@pytest.mark.long
@pytest.mark.parametrize("system", ["mark-i3", "partitioning"])
def test_rerun_opens_the_mcap_file(tmp_path, system):
    run = ["run", system, "--seed", "5", "--record", "--set", "time_cap=120", "--out", str(tmp_path / "run")]
    assert exit_code([*run, "--workers", "1"]) == 0
    assert exit_code(["export", str(tmp_path / "run"), "--to", "mcap", "--out", str(tmp_path)]) == 0
    rrd, rerun = tmp_path / "a.rrd", shutil.which("rerun", path=sysconfig.get_path("scripts"))
    assert rerun, 'this test needs Rerun: python -m pip install -e ".[rerun]"'
    subprocess.run([rerun, "mcap", "convert", str(tmp_path / "seed-5.mcap"), "-o", str(rrd)], check=True)
    printed = subprocess.run([rerun, "rrd", "print", "-vv", str(rrd)], check=True, capture_output=True, text=True)
    shown = printed.stdout
    assert "/robots/poses" in shown and "InstancePoses3D" in shown
    assert "/robots/points" in shown and "Points3D" in shown


def test_a_notebook_shows_the_replay(folder):
    text = Replay(recording(folder, 5))._repr_html_()
    assert text.startswith("<iframe") and "srcdoc=" in text and "importmap" in text and "<script" not in text


def test_a_missing_extra_says_what_to_type(folder, monkeypatch, capsys):
    monkeypatch.setattr(extras, "find_spec", lambda name: None)
    for words, extra in (
        (["watch", "mark-i3"], "watch"),
        (["replay", recording(folder, 5)], "watch"),
        (["movie", recording(folder, 5), "--out", "a.webm"], "movie"),
        (["export", recording(folder, 5), "--to", "mcap"], "mcap"),
    ):
        assert exit_code(words) == 2
        assert f'python -m pip install "formicarium[{extra}]"' in capsys.readouterr().err


def test_a_taken_port_is_said(tmp_path, capsys):
    with socket.create_server(("127.0.0.1", 0)) as taken:
        port = taken.getsockname()[1]
        words = ["watch", "mark-i3", "--port", str(port), "--no-browser", "--out", str(tmp_path)]
        assert exit_code(words) == 2
    assert f"port {port} of 127.0.0.1 is taken" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["replay", "nowhere"], "there is no run nowhere"),
        (["movie", "X", "--out", "a.avi"], "the suffix must be one of"),
        (["movie", "X", "--out", "a.mp4", "--at", "3"], "--at goes with a snapshot"),
        (["movie", "X", "--every", "0"], "--every 0: must be a time"),
        (["watch", "mark-i3", "--speed", "-1"], "--speed -1"),
        (["watch", "mark-i3", "--port", "70000"], "--port 70000"),
        (["watch", "mark-i5"], "unknown system"),
        (["watch", "random_walk:RANDOM_WALK"], "cannot be watched"),
        (["run", "random_walk:RANDOM_WALK", "--record"], "does not say how it is shown"),
    ],
)
def test_what_cannot_be_done_is_said(words, said, capsys, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr("formicarium.commands.showing.show", lambda *_: 0)  # or what is served would never end
    assert exit_code(words) == 2
    assert said in capsys.readouterr().err


def test_no_page_needs_no_extra(folder, monkeypatch):
    monkeypatch.setattr(extras, "find_spec", lambda name: None)
    assert exit_code(["replay", recording(folder, 5), "--check"]) == 0

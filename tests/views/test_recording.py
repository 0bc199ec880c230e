"""Recordings: small, whole or reported, and what they say is what happened."""

import json
import subprocess
import sys
import zlib
from pathlib import Path

import numpy as np
import pytest

from formicarium.systems.registry import resolve
from formicarium.trial.record import EVENT, Frames
from formicarium.views.live.checking import Checks
from formicarium.views.live.session import Session
from formicarium.views.recording.blocks import BACK, EVENTS, FRAMES, HEADER, BlockWriter, Damaged, read_blocks
from formicarium.views.recording.columns import HEADING, PLACE, packed, unpacked
from formicarium.views.recording.log import read_recording
from formicarium.views.recording.recorded import record_trial
from formicarium.views.recording.recorder import Recorder

SYSTEM = resolve("mark-i3")


def short(seconds=300.0):
    parameters = SYSTEM.configure()
    return parameters.model_copy(update={"swarm": parameters.swarm.model_copy(update={"time_cap": seconds})})


@pytest.fixture(scope="module")
def recorded(tmp_path_factory):
    path = tmp_path_factory.mktemp("recorded") / "seed-3.recording"
    trial = record_trial(SYSTEM, short(), 3, path, {"name": "mark-i3", "seed": 3}, 0.5)
    return path, trial


def test_a_recorded_trial_is_the_unrecorded_trial(recorded):
    alone = SYSTEM.run(short(), 3, frames_every=0.5)
    path, trial = recorded
    recording = read_recording(path)
    assert trial.events.tobytes() == recording.events.tobytes() == alone.events.tobytes()
    assert dict(trial.outcome) == dict(alone.outcome) == dict(recording.outcome)
    assert recording.frames.cycle.tolist() == alone.frames.cycle.tolist()
    for name in ("x", "y"):
        assert np.abs(getattr(recording.frames, name) - getattr(alone.frames, name)).max() <= 0.51 * PLACE
    turn = recording.frames.heading - alone.frames.heading
    assert np.abs(turn).max() <= 0.51 * HEADING + 1e-5  # whole turns included
    for name in ("role", "carried", "lit", "identity"):
        assert np.array_equal(getattr(recording.frames, name), getattr(alone.frames, name)), name


def test_twenty_robots_at_two_frames_a_second_take_less_than_two_megabytes_an_hour(recorded):
    path, _ = recorded
    hours = read_recording(path).end * 0.1 / 3600
    assert path.stat().st_size / hours < 2e6


def test_any_flipped_byte_is_found(recorded, tmp_path):
    whole = recorded[0].read_bytes()
    draws = np.random.default_rng(1)
    places = {0, 5, len(whole) - 1, len(whole) - 9, *range(24, 60), *draws.integers(0, len(whole), 150).tolist()}
    copy = tmp_path / "flipped.recording"
    for place in sorted(places):
        flipped = bytearray(whole)
        flipped[place] ^= 1 << int(draws.integers(8))
        copy.write_bytes(flipped)
        with pytest.raises(Damaged, match=r"flipped\.recording is (damaged|no recording)"):
            list(read_blocks(copy))


def test_what_was_written_before_a_kill_is_good(recorded, tmp_path):
    whole = recorded[0].read_bytes()
    copy = tmp_path / "cut.recording"
    copy.write_bytes(whole[: 2 * len(whole) // 3])
    cut, full = read_recording(copy), read_recording(recorded[0])
    assert cut.outcome is None and 0 < cut.end < full.end
    count = len(cut.frames.cycle)
    assert np.array_equal(cut.frames.x, full.frames.x[:count])
    assert cut.checks.items() <= full.checks.items() and len(cut.checks) > 1


def frames_of(count, robots, jump=0.0):
    draws = np.random.default_rng(2)
    walk = draws.normal(0, 0.01, (3, count, robots)).cumsum(axis=1).astype("f4")
    walk[0, count // 2 :] += jump
    small = [draws.integers(0, 5, (count, robots)).astype("i1") for _ in range(3)]
    joined = draws.integers(-1, robots, (count, robots)).astype("i2")
    lit = draws.integers(0, 2, (count, 3)).astype("i1")
    return Frames(40 + 5 * np.arange(count), *walk, *small[:2], lit, np.arange(1, robots + 1), small[2], joined)


@pytest.mark.parametrize("jump", [0.0, 7.5])
@pytest.mark.parametrize("count", [1, 2, 120])
def test_frames_come_back(count, jump):
    frames = frames_of(count, 7, jump)
    back = unpacked(packed(frames, 5), frames.identity)
    for name in Frames._fields:
        gap = np.abs(getattr(back, name).astype(float) - getattr(frames, name)).max()
        assert gap <= {"x": 0.6 * PLACE, "y": 0.6 * PLACE, "heading": 0.6 * HEADING}.get(name, 0.0), name


def test_what_was_taken_back_is_not_read(tmp_path):
    writer = BlockWriter(tmp_path / "a.recording")
    polygons = [[[[0, 0], [1, 0], [1, 1]], "wall"]] + 3 * [[[[0, 0], [1, 0], [1, 1]], "red"]]
    scene = {"polygons": polygons, "radius": 0.1, "roles": ["a"], "cycle_time": 0.1}
    writer.write(HEADER, json.dumps({"identity": list(range(1, 8)), "scene": scene}).encode())
    events = np.zeros(4, EVENT)
    events["cycle"] = [40, 99, 100, 200]
    writer.write(EVENTS, zlib.compress(events.tobytes()))
    writer.write(FRAMES, b"\x00" * 16 + packed(frames_of(60, 7), 5))
    writer.write(BACK, b"100")
    writer.close()
    recording = read_recording(tmp_path / "a.recording")
    assert recording.frames.cycle.tolist() == list(range(40, 101, 5))
    assert recording.events["cycle"].tolist() == [40, 99]


def test_an_intervention_in_the_past_is_recorded_as_it_went(tmp_path):
    path = tmp_path / "touched.recording"
    session = Session(SYSTEM, short(), 8)
    session.record(Recorder(path, {"name": "mark-i3", "seed": 8}, session.scene, session.state, 5))
    session.advance(1500)
    session.seek(433)
    session.intervene("kill", int(session.identity[2]))
    session.intervene("block", 0)
    session.advance(300)
    session.intervene("unblock", 0)
    session.advance(10_000)
    recording = read_recording(path)
    assert recording.frames.cycle.tolist() == list(range(0, session.last_cycle + 1, 5))
    assert [deed.deed for deed in recording.interventions] == ["kill", "block", "unblock"]
    again = Session(SYSTEM, short(), 8, recording.interventions, Checks(recording.checks))
    again.advance(10_000)
    assert again.checks.differs is None and again.checks.agreed == again.checks.last == session.last_cycle
    assert again.events.tobytes() == recording.events.tobytes() == session.events.tobytes()
    assert dict(again.outcome()) == dict(recording.outcome)


@pytest.mark.long
@pytest.mark.skipif(not Path("/proc/self/status").exists(), reason="counts memory as Linux does")
def test_28_hours_stay_small_in_memory(tmp_path):
    """100,000 s at two frames a second, in a process of its own: less than 500 MB."""
    program = """
import sys
from pathlib import Path
from formicarium.systems.registry import resolve
from formicarium.views.recording.recorded import record_trial
from formicarium.views.live.session import Session
from formicarium.views.recording.recorder import Recorder
system = resolve("mark-i3")
p = system.configure()
p = p.model_copy(update={"swarm": p.swarm.model_copy(update={"time_cap": 100_000.0, "sequences": 100_000})})
session = Session(system, p, 1)
session.record(Recorder(Path(sys.argv[1]), {}, session.scene, session.state, 5))
while not session.finished:
    session.advance(1000)
    session.frame()
peak = next(line for line in Path("/proc/self/status").read_text().splitlines() if line.startswith("VmHWM"))
print(session.cycle, int(peak.split()[1]) / 1024)
"""
    path = tmp_path / "long.recording"
    done = subprocess.run([sys.executable, "-c", program, str(path)], capture_output=True, text=True, check=True)
    cycle, megabytes = map(float, done.stdout.split())
    print(f"{cycle:.0f} cycles, {megabytes:.0f} MB of memory, {path.stat().st_size / 1e6:.1f} MB recorded")
    assert cycle == 1_000_000 and megabytes < 500
    assert path.stat().st_size / (cycle / 36_000) < 2e6

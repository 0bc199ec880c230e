"""Reading a recording: what was recorded, without what was taken back."""

import json
import zlib
from collections.abc import Mapping
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from formicarium.trial.record import EVENT, Frames, Scene
from formicarium.trial.watching import Intervention
from formicarium.views.recording.blocks import (
    BACK,
    DEED,
    END,
    EVENTS,
    FRAMES,
    HEADER,
    Damaged,
    read_blocks,
)
from formicarium.views.recording.columns import unpacked
from formicarium.views.recording.recorder import CHECK, UNCHECKED
from formicarium.views.scenes import scene_from


class Recording(NamedTuple):
    """What a file holds."""

    path: Path
    head: Mapping[str, Any]  # system, parameters, seed, sources, version, identity of the configuration, every
    scene: Scene
    frames: Frames
    events: np.ndarray  # EVENT
    interventions: tuple[Intervention, ...]
    checks: Mapping[int, bytes]  # cycle -> digest of the state
    outcome: Mapping[str, Any] | None  # None if the recording was cut off or the trial not finished
    end: int  # last cycle that was recorded


def read_recording(path: Path) -> Recording:
    """Read a recording.

    Raises:
        Damaged: if the file is not what was written.
        StoreError: if it cannot be read.
    """
    blocks = read_blocks(path)
    first = next(blocks, None)
    if first is None or first.kind != HEADER:
        raise Damaged(f"{path} is empty: its recorder was stopped before it began")
    head = json.loads(first.content)
    identity = np.array(head["identity"], "i8")
    strips: list[Frames] = []
    events: list[np.ndarray] = []
    deeds: list[Intervention] = []
    checks: dict[int, bytes] = {}
    outcome, end = None, 0
    for block in blocks:
        if block.kind == FRAMES:
            cycle, check = CHECK.unpack_from(block.content)
            if cycle != UNCHECKED:
                checks[cycle] = check
            strips.append(unpacked(block.content[CHECK.size :], identity))
        elif block.kind == EVENTS:
            events.append(np.frombuffer(zlib.decompress(block.content), EVENT))
        elif block.kind == DEED:
            deeds.append(Intervention(*json.loads(block.content)))
        elif block.kind == BACK:
            to = json.loads(block.content)
            strips = [kept for strip in strips if len((kept := _until(strip, to)).cycle)]
            events = [chunk[chunk["cycle"] < to] for chunk in events]
            deeds = [deed for deed in deeds if deed.cycle <= to]
            checks = {cycle: check for cycle, check in checks.items() if cycle <= to}
        elif block.kind == END:
            ending = json.loads(block.content)
            outcome, end = ending["outcome"], ending["cycle"]
    frames = joined_frames(strips, identity, head)
    end = max(end, int(frames.cycle[-1]) if len(frames.cycle) else 0)
    log = np.concatenate(events) if events else np.zeros(0, EVENT)
    return Recording(path, head, scene_from(head["scene"]), frames, log, tuple(deeds), checks, outcome, end)


def _until(frames: Frames, cycle: int) -> Frames:
    return sliced(frames, frames.cycle <= cycle)


def sliced(frames: Frames, chosen: Any) -> Frames:
    """Return some of the frames."""
    return Frames(*[
        values if values is None or name == "identity" else values[chosen] for name, values in frames._asdict().items()
    ])  # fmt: skip


def joined_frames(strips: list[Frames], identity: np.ndarray, head: Mapping[str, Any]) -> Frames:
    """Return strips of frames as one."""
    if not strips:
        places, small = np.zeros((0, len(identity)), "f4"), np.zeros((0, len(identity)), "i1")
        lit = np.zeros((0, len(scene_from(head["scene"]).devices)), "i1")
        return Frames(np.zeros(0, "i8"), places, places, places, small, small, lit, identity, small, small.astype("i2"))
    columns = {
        name: identity if name == "identity" else np.concatenate([getattr(strip, name) for strip in strips])
        for name in Frames._fields
    }
    return Frames(**columns)

"""Writing the recording of a trial while it runs: frames, events, interventions, digests, the outcome.

A frame costs a few copies of memory; a minute of frames is packed and written at once, so memory stays small
however long the trial is.
"""

import json
import struct
import zlib
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from formicarium.trial.record import Frames, Scene
from formicarium.trial.showing import part_of
from formicarium.trial.watching import Intervention, Watching
from formicarium.views.recording.blocks import BACK, DEED, END, EVENTS, FRAMES, HEADER, BlockWriter
from formicarium.views.recording.columns import packed
from formicarium.views.recording.digest import digest
from formicarium.views.scenes import scene_content

FRAMES_A_BLOCK = 120
CHECK = struct.Struct("<q8s")  # cycle and digest of the state
MOST_BYTES = 32_000_000  # of frames that wait to be packed


class Reel:
    """A strip of memory for so many moments of some parts of a state."""

    def __init__(self, state: Any, parts: tuple[str, ...]):
        """Set memory aside."""
        live = {name: np.asarray(part_of(state, name)) for name in parts}
        size = sum(array.nbytes for array in live.values())
        self.length = int(np.clip(MOST_BYTES // size, 2, FRAMES_A_BLOCK))
        self._strips = {name: np.zeros((self.length, *array.shape), array.dtype) for name, array in live.items()}
        # Bytes are copied, not fields: a record array is copied field by field otherwise.
        self._pairs = [(self._strips[name].view("u1"), array.view("u1")) for name, array in live.items()]
        self._cycles = np.zeros(self.length, "i8")
        self.count = 0

    def take(self, cycle: int) -> None:
        """Take one moment."""
        for strip, live in self._pairs:
            strip[self.count] = live
        self._cycles[self.count] = cycle
        self.count += 1

    def cut(self) -> dict[str, Any]:
        """Return the moments taken and begin anew; they are overwritten by the next."""
        taken, self.count = self.count, 0
        return {"cycle": self._cycles[:taken], **{name: strip[:taken] for name, strip in self._strips.items()}}


class Recorder:
    """Writes one recording."""

    def __init__(
        self, path: Path, content: Mapping[str, Any], watching: Watching, scene: Scene, state: Any, every: int
    ):
        """Begin a file.

        Args:
            path: of the file, which must not exist.
            content: what the trial is: system, parameters, seed, sources, version, kinds.
            watching: how the system is shown.
            scene: what does not move.
            state: of the trial, before its first cycle.
            every: cycles between two frames.

        Raises:
            StoreError: if it cannot be written.
        """
        self.every = every
        self._state, self._watching = state, watching
        self._reel = Reel(state, watching.parts)
        self._writer = BlockWriter(path)
        identity = sorted(int(robot) for robot in state.robots["identity"])
        last = int(state.clock["last_cycle"][0])
        head = {**content, "scene": scene_content(scene), "every": every, "last_cycle": last, "identity": identity}
        self._writer.write(HEADER, json.dumps(head).encode())

    def take(self, cycle: int) -> None:
        """Take a frame of the state as it is."""
        self._reel.take(cycle)
        if self._reel.count == self._reel.length:
            self.flush(cycle)

    def flush(self, cycle: int) -> None:
        """Write the frames taken so far and the digest of the state, which is at ``cycle``."""
        if self._reel.count:
            frames: Frames = self._watching.frames(self._reel.cut())
            content = CHECK.pack(cycle, digest(self._state)) + packed(frames, self.every)
            self._writer.write(FRAMES, content)

    def note(self, events: np.ndarray) -> None:
        """Write events."""
        if len(events):
            self._writer.write(EVENTS, zlib.compress(events.tobytes()))

    def deed(self, intervention: Intervention) -> None:
        """Write an intervention."""
        self._writer.write(DEED, json.dumps(intervention).encode())

    def back(self, cycle: int) -> None:
        """Note that the trial goes on from an earlier cycle: what came after it is no more."""
        self._reel.cut()
        self._writer.write(BACK, json.dumps(cycle).encode())

    def close(self, cycle: int, outcome: Mapping[str, Any] | None) -> None:
        """Write what is left and end the file; without an outcome the trial was not finished."""
        self.flush(cycle)
        if outcome is not None:
            self._writer.write(END, json.dumps({"cycle": cycle, "outcome": dict(outcome)}).encode())
        self._writer.close()

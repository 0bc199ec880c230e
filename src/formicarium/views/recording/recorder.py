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

from formicarium.trial.film import SHOT, frames_of, make_film
from formicarium.trial.record import Scene
from formicarium.trial.watching import Intervention
from formicarium.views.recording.blocks import BACK, DEED, END, EVENTS, FRAMES, HEADER, BlockWriter
from formicarium.views.recording.columns import packed
from formicarium.views.recording.digest import digest
from formicarium.views.scenes import scene_content

FRAMES_A_BLOCK = 120
CHECK = struct.Struct("<q8s")  # cycle and digest of the state
UNCHECKED = -1  # in place of a cycle
MOST_BYTES = 32_000_000  # of frames that wait to be packed


class Recorder:
    """Writes one recording."""

    def __init__(self, path: Path, content: Mapping[str, Any], scene: Scene, state: Any, every: int):
        """Begin a file.

        Args:
            path: of the file, which must not exist.
            content: what the trial is: system, parameters, seed, sources, version, kinds.
            scene: what does not move.
            state: of the trial, before its first cycle.
            every: cycles between two frames.

        Raises:
            StoreError: if it cannot be written.
        """
        self.every = every
        self._state = state
        self._identity = np.array(state.robots["identity"])
        robots = len(self._identity)
        length = int(np.clip(MOST_BYTES // (SHOT.itemsize * robots), 2, FRAMES_A_BLOCK))
        self.film = make_film(length, robots, scene)
        self._writer = BlockWriter(path)
        identity = sorted(int(robot) for robot in state.robots["identity"])
        last = int(state.clock["last_cycle"][0])
        head = {**content, "scene": scene_content(scene), "every": every, "last_cycle": last, "identity": identity}
        self._writer.write(HEADER, json.dumps(head).encode())

    def flush(self, cycle: int, check: bool = True) -> None:
        """Write the frames taken so far; with the digest of the state if it is at ``cycle`` and untouched there."""
        if self.film.taken[0]:
            frames = frames_of(self.film, self._identity)
            self.film.taken[0] = 0
            found = CHECK.pack(cycle, digest(self._state)) if check else CHECK.pack(UNCHECKED, b"")
            self._writer.write(FRAMES, found + packed(frames, self.every))

    @property
    def full(self) -> bool:
        """Whether it is time to flush."""
        return bool(self.film.taken[0] == len(self.film.cycle))

    def note(self, events: np.ndarray) -> None:
        """Write events."""
        if len(events):
            self._writer.write(EVENTS, zlib.compress(events.tobytes()))

    def deed(self, intervention: Intervention) -> None:
        """Write an intervention."""
        self._writer.write(DEED, json.dumps(intervention).encode())

    def back(self, cycle: int) -> None:
        """Note that the trial goes on from an earlier cycle: what came after it is no more."""
        self.flush(cycle, check=False)
        self._writer.write(BACK, json.dumps(cycle).encode())

    def close(self, cycle: int, outcome: Mapping[str, Any] | None, check: bool = True) -> None:
        """Write what is left and end the file; without an outcome the trial was not finished."""
        self.flush(cycle, check)
        row = None if outcome is None else dict(outcome)
        self._writer.write(END, json.dumps({"cycle": cycle, "outcome": row}).encode())
        self._writer.close()

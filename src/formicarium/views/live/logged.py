"""Frames of a log played like a session, where the trial itself cannot be simulated again."""

from typing import Any

import numpy as np

from formicarium.trial.record import Frames, Scene
from formicarium.trial.watching import Impossible, Inspection, Intervention
from formicarium.views.recording.log import sliced


class LoggedFrames:
    """What was recorded, and no more."""

    touchable = False
    blockable = False
    radio = False  # packets are not recorded
    turns = 0
    ended = True

    def __init__(self, scene: Scene, frames: Frames, events: np.ndarray, interventions: tuple[Intervention, ...]):
        """Show frames from the first on; there must be one."""
        self.scene, self.interventions = scene, interventions
        self.logs = [events]
        self.identity = frames.identity
        none = np.full(frames.x.shape, -1, "i2")
        self._frames = frames._replace(
            colour=np.zeros(frames.x.shape, "i1") if frames.colour is None else frames.colour,
            joined=none if frames.joined is None else frames.joined,
        )
        self.cycle = int(frames.cycle[0])
        self.last_cycle = self.frontier = int(frames.cycle[-1])

    @property
    def finished(self) -> bool:
        """Whether there is no later frame."""
        return self.cycle >= self.last_cycle

    def advance(self, cycles: int) -> None:
        """Go so many cycles on."""
        self.cycle = min(self.cycle + cycles, self.last_cycle)

    def turn_to(self, cycle: int) -> None:
        """Go to a cycle."""
        self.cycle = int(np.clip(cycle, self._frames.cycle[0], self.last_cycle))

    seek = turn_to

    def frame(self) -> Frames:
        """Return the last frame at or before now."""
        place = int(np.searchsorted(self._frames.cycle, self.cycle, side="right")) - 1
        return sliced(self._frames, slice(place, place + 1))

    def packets(self) -> np.ndarray:
        """Return nothing: packets are not recorded."""
        return np.zeros((0, 2), "u2")

    def inspect(self, identity: int) -> Inspection | None:
        """Return nothing: what is in a robot is not recorded."""
        return None

    def intervene(self, *_: Any) -> None:
        """Refuse."""
        raise Impossible("these are recorded frames: nothing can be changed")

    def stop(self) -> None:
        """Do nothing."""

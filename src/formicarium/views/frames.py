"""One frame of a trial as a picture."""

from pathlib import Path

from formicarium.trial.record import Frames, Scene
from formicarium.views.figure import save
from formicarium.views.overhead import Overhead


def draw_frame(scene: Scene, frames: Frames, path: Path, index: int = -1, title: str = "") -> Path:
    """Draw the arena from above at frame ``index`` (the last one by default) and return the path.

    Raises:
        StoreError: if the file cannot be written.
    """
    picture = Overhead(scene, title)
    picture.show(frames, index)
    return save(picture.figure, path)

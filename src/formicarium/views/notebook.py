"""A stored run in a notebook: the page inside the cell, without a server.

from formicarium.views.notebook import Replay
Replay("formicarium-results/mark-i3-1a2b3c4d/recordings/seed-7.recording")
"""

from contextlib import suppress
from html import escape
from pathlib import Path

from formicarium.systems.registry import resolve
from formicarium.views.recording.log import read_recording
from formicarium.views.sentences import lines, teller
from formicarium.views.single_file import single_file


class Replay:
    """A recording that shows itself."""

    def __init__(self, path: str | Path, height: int = 640):
        """Read a recording; ``height`` of the cell in pixels.

        Raises:
            StoreError: if it cannot be read.
        """
        self.recording = read_recording(Path(path))
        self.height = height

    def page(self) -> str:
        """Return the page as one HTML file."""
        recording, kinds = self.recording, self.recording.head["kinds"]
        system = None
        with suppress(LookupError, ImportError):  # a system that is not here any more still has its frames
            system = resolve(str(recording.head["name"]))
        events = lines(recording.events, kinds, teller(system, kinds))
        title = f"{recording.head['system']}, seed {recording.head['seed']}"
        return single_file(recording.scene, recording.frames, events, recording.interventions, title)

    def _repr_html_(self) -> str:
        style = f"width:100%;height:{self.height}px;border:0"
        return f'<iframe style="{style}" sandbox="allow-scripts" srcdoc="{escape(self.page())}"></iframe>'

"""A run as one HTML file that needs no server and no network: the page with its modules and the frames inside."""

import base64
import json
import zlib
from html import escape
from pathlib import Path

import numpy as np

from formicarium.campaigns.files import write_text
from formicarium.trial.record import Frames, Scene
from formicarium.trial.watching import Intervention
from formicarium.views.live.wire import look_of
from formicarium.views.page import text_of
from formicarium.views.recording.columns import HEADING, PLACE
from formicarium.views.recording.log import sliced

MOST_FRAMES = 12_000  # more are thinned out
MODULES = ("arena.js", "film.js", "live.js", "panels.js")


def write_single_file(
    path: Path,
    scene: Scene,
    frames: Frames,
    events: list[tuple[int, str, int, str]],
    interventions: tuple[Intervention, ...],
    title: str,
) -> Path:
    """Write the file.

    Args:
        path: of the file.
        scene: what does not move.
        frames: what does, at equal distances in time.
        events: (cycle, kind, robot, sentence).
        interventions: what people did.
        title: of the page.

    Raises:
        StoreError: if it cannot be written.
    """
    write_text(path, single_file(scene, frames, events, interventions, title))
    return path


def single_file(
    scene: Scene,
    frames: Frames,
    events: list[tuple[int, str, int, str]],
    interventions: tuple[Intervention, ...],
    title: str,
) -> str:
    """Return the text of the file; arguments as for ``write_single_file``."""
    frames = sliced(frames, slice(None, None, -(-len(frames.cycle) // MOST_FRAMES)))
    hello = {
        "title": title,
        **look_of(scene),
        "identity": frames.identity.tolist(),
        "kinds": sorted({kind for _, kind, _, _ in events}),
        "last_cycle": int(frames.cycle[-1]),
        "touchable": False,
    }
    content = {"hello": hello, "film": film(frames, interventions), "events": events, "note": "recorded frames"}
    text = text_of("index.html").replace("{{title}}", escape(title))
    text = text.replace('<link rel="stylesheet" href="/page/style.css">', f"<style>\n{text_of('style.css')}</style>")
    # Inside a file there are no places that modules could be named by: the map gives each name its text.
    main = text_of("main.js").replace('from "./', 'from "formicarium/')
    modules = {
        f"formicarium/{name}": f"data:text/javascript;base64,{_base64(text_of(name).encode())}" for name in MODULES
    }
    data = json.dumps(content).replace("</", "<\\/")  # no text of ours may end the script early
    inside = (
        f'<script type="importmap">{json.dumps({"imports": modules})}</script>\n'
        f'<script id="film" type="application/json">{data}</script>\n'
        f'<script type="module">\n{main}</script>'
    )
    return text.replace('<script type="module" src="/page/main.js"></script>', inside)


def film(frames: Frames, interventions: tuple[Intervention, ...]) -> dict:
    """Return frames as the page's film.js reads them: differences in time, zlib, base64."""
    count, robots = frames.x.shape
    none = np.full((count, robots), -1, "<i2")
    columns = [
        np.rint(frames.x / PLACE).astype("<i4"),
        np.rint(frames.y / PLACE).astype("<i4"),
        np.rint(frames.heading / HEADING).astype("<i4"),
        none if frames.joined is None else frames.joined.astype("<i2"),
        frames.role,
        frames.carried,
        frames.lit,
    ]
    steps = [np.diff(column, axis=0, prepend=np.zeros((1, column.shape[1]), column.dtype)) for column in columns]
    first, every = int(frames.cycle[0]), int(frames.cycle[1] - frames.cycle[0]) if count > 1 else 1
    return {
        "first": first,
        "every": every,
        "frames": count,
        "robots": robots,
        "devices": frames.lit.shape[1],
        "place": PLACE,
        "turn": HEADING,
        "data": _base64(zlib.compress(b"".join(step.tobytes() for step in steps), 9)),
        "interventions": [list(deed) for deed in interventions],
    }


def _base64(content: bytes) -> str:
    return base64.b64encode(content).decode()

"""Letters and numbers as outlines in metres, so that many are drawn at once and grow with the arena."""

import functools

import numpy as np
from matplotlib.font_manager import FontProperties
from matplotlib.path import Path
from matplotlib.textpath import TextPath

NOTHING = Path(np.zeros((1, 2)))


@functools.cache
def glyph(text: str, height: float) -> Path:
    """Return the outline of a text, centred on the origin; ``height`` is that of a capital letter, metres."""
    if not text:
        return NOTHING
    font = FontProperties(family="DejaVu Sans", weight="bold")
    capital = TextPath((0, 0), "H", size=100, prop=font).get_extents()
    outline = TextPath((0, 0), text, size=100, prop=font)
    extent = outline.get_extents()
    middle = [(extent.x0 + extent.x1) / 2, (extent.y0 + extent.y1) / 2]
    return Path((outline.vertices - middle) * (height / capital.height), outline.codes)

"""A report as its parts; ``views.pages`` writes it as Markdown and as one HTML file."""

from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple


class Heading(NamedTuple):
    """A title of a part."""

    text: str
    level: int = 2  # 1: of the whole


class Text(NamedTuple):
    """A paragraph."""

    text: str


class Grid(NamedTuple):
    """A table of texts."""

    heads: Sequence[str]
    rows: Sequence[Sequence[str]]


class Picture(NamedTuple):
    """A figure."""

    path: Path
    caption: str


Block = Heading | Text | Grid | Picture

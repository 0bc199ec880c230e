"""A report as Markdown, with its figures beside it, and as one HTML file that holds everything."""

import base64
from collections.abc import Sequence
from html import escape
from pathlib import Path

from formicarium.campaigns.files import write_text
from formicarium.studies.document import Block, Grid, Heading, Picture, Text

STYLE = """
body { font: 15px/1.5 system-ui, sans-serif; color: #22262b; max-width: 1200px; margin: 2em auto; padding: 0 1em }
table { border-collapse: collapse; margin: 1em 0; font-size: 13.5px }
th, td { border-bottom: 1px solid #e3e1dc; padding: .3em .8em .3em 0; text-align: left; vertical-align: top }
th { border-bottom: 2px solid #7a828c }
img { max-width: 100% } figure { margin: 2em 0 } figcaption { color: #7a828c }
.compatible, .passed { color: #2b7a3f } .better { color: #2364c8 } .worse, .FAILED { color: #c22a22; font-weight: bold }
"""


def write_markdown(blocks: Sequence[Block], path: Path) -> Path:
    """Write a report as Markdown and return the path; pictures are linked relative to it."""
    write_text(path, "\n\n".join(_markdown(block, path.parent) for block in blocks) + "\n")
    return path


def write_html(blocks: Sequence[Block], path: Path) -> Path:
    """Write a report as one HTML file, pictures inside, and return the path."""
    title = escape(next((block.text for block in blocks if isinstance(block, Heading)), ""))
    body = "\n".join(_html(block) for block in blocks)
    head = f'<!doctype html>\n<html lang="en"><head><meta charset="utf-8"><title>{title}</title>'
    write_text(path, f"{head}<style>{STYLE}</style></head>\n<body>\n{body}\n</body></html>\n")
    return path


def _markdown(block: Block, folder: Path) -> str:
    match block:
        case Heading(text, level):
            return f"{'#' * level} {text}"
        case Text(text):
            return text
        case Grid(heads, rows):
            lines = [heads, ["---"] * len(heads), *rows]
            return "\n".join(f"| {' | '.join(cell.replace('|', '/') for cell in line)} |" for line in lines)
        case Picture(path, caption):
            return f"![{caption}]({path.relative_to(folder).as_posix()})"


def _html(block: Block) -> str:
    match block:
        case Heading(text, level):
            return f"<h{level}>{escape(text)}</h{level}>"
        case Text(text):
            return f"<p>{escape(text)}</p>"
        case Grid(heads, rows):
            top = "".join(f"<th>{escape(head)}</th>" for head in heads)
            lines = "\n".join(f"<tr>{''.join(map(_cell, row))}</tr>" for row in rows)
            return f"<table>\n<tr>{top}</tr>\n{lines}\n</table>"
        case Picture(path, caption):
            data = base64.b64encode(path.read_bytes()).decode()
            image = f'<img alt="{escape(caption)}" src="data:image/png;base64,{data}">'
            return f"<figure>{image}<figcaption>{escape(caption)}</figcaption></figure>"


def _cell(text: str) -> str:
    kind = f' class="{text}"' if text in ("compatible", "better", "worse", "passed", "FAILED") else ""
    return f"<td{kind}>{escape(text)}</td>"

"""Put what a study's command has written into a page: python docs/fill.py PAGE REPORT.

Both hold blocks that begin with ``<!-- block: NAME -->`` and end with ``<!-- end of block -->``. Every block of the
page is replaced by the report's of that name; a block that the report lacks is an error, and nothing is written then.
"""

import re
import sys
from pathlib import Path

BLOCK = re.compile(r"<!-- block: (?P<name>[^>]+) -->\n(?P<text>.*?)<!-- end of block -->", re.DOTALL)


def filled(page: str, report: str) -> str:
    """Return the page with the report's blocks.

    Raises:
        KeyError: if the report lacks one.
    """
    blocks = {found["name"]: found.group() for found in BLOCK.finditer(report)}
    return BLOCK.sub(lambda found: blocks[found["name"]], page)


if __name__ == "__main__":
    place, source = map(Path, sys.argv[1:3])
    try:
        text = filled(place.read_text(encoding="utf-8"), source.read_text(encoding="utf-8"))
    except KeyError as lacking:
        sys.exit(f"{source} has no block {lacking}: let the study write all of it (--figure all)")
    place.write_text(text, encoding="utf-8")

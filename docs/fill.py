"""Put what a study's command has written into a page: python docs/fill.py PAGE REPORT...

All hold blocks that begin with ``<!-- block: NAME -->`` and end with ``<!-- end of block -->``. A block of the page is
replaced by that of the same name in one of the reports; what no report has stays as it is, and is named.
"""

import re
import sys
from collections.abc import Sequence
from pathlib import Path

BLOCK = re.compile(r"<!-- block: (?P<name>[^>]+) -->\n(?P<text>.*?)<!-- end of block -->", re.DOTALL)


def filled(page: str, reports: Sequence[str]) -> tuple[str, list[str]]:
    """Return the page with the reports' blocks, and the names of those that no report has."""
    blocks = {found["name"]: found.group() for report in reports for found in BLOCK.finditer(report)}
    kept = [found["name"] for found in BLOCK.finditer(page) if found["name"] not in blocks]
    return BLOCK.sub(lambda found: blocks.get(found["name"], found.group()), page), kept


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    place, *sources = map(Path, sys.argv[1:])
    text, kept = filled(place.read_text(encoding="utf-8"), [path.read_text(encoding="utf-8") for path in sources])
    place.write_text(text, encoding="utf-8")
    print(f"{place}: {'no block' if not kept else ', '.join(kept)} kept as it was")

"""Files that are of no use: unreadable ones are set aside, half-written ones without an owner are removed."""

import contextlib
import os
import time
import uuid
from pathlib import Path

from formicarium.campaigns.files import unwritable

HALF_WRITTEN = 600.0  # seconds after which a temporary file has no owner any more; a living write takes seconds
PLACES = (".", "parts", "failures", "configurations", "sessions")


def set_aside(folder: Path, path: Path, reason: str, consequence: str) -> str:
    """Move a file that cannot be read to ``damaged/``; returns what a person should know.

    Raises:
        StoreError: if it cannot be moved.
    """
    place = folder / "damaged" / f"{uuid.uuid4().hex[:6]}-{path.name}"
    try:
        place.parent.mkdir(parents=True, exist_ok=True)
        os.replace(path, place)
    except FileNotFoundError:
        return f"{path} was damaged ({reason}) and is gone; {consequence}"
    except OSError as error:
        raise unwritable(place, error) from error
    return f"{path} is damaged ({reason}); set aside as {place}, {consequence}"


def sweep(folder: Path) -> None:
    """Remove what writers that died have left half written."""
    for name in PLACES:
        for path in (folder / name).glob(".partial-*"):
            with contextlib.suppress(OSError):
                if time.time() - path.stat().st_mtime > HALF_WRITTEN:
                    path.unlink()

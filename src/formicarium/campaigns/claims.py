"""Who is at work on which runs: coordinators of one folder share the work and take over from dead ones.

A writer holds the lock of ``writers/<name>.lock`` as long as it lives and notes the runs it has taken in
``writers/<name>.json``. All functions are called under the lock of the folder.
"""

import contextlib
import json
import time
from collections.abc import Iterable
from pathlib import Path
from typing import IO

from formicarium.campaigns import lock
from formicarium.campaigns.cells import Key
from formicarium.campaigns.files import unwritable


def register(folder: Path, name: str) -> IO[str]:
    """Announce a writer; it is alive until the file that is returned is closed."""
    while (file := lock.try_acquire(folder / f"{name}.lock")) is None:
        time.sleep(0.01)  # somebody is just counting the writers
    return file


def note(folder: Path, name: str, runs: Iterable[Key]) -> None:
    """Note the runs that a writer has taken; torn only if it dies, and then nobody reads it."""
    path = folder / f"{name}.json"
    try:
        path.write_text(json.dumps([list(key) for key in runs]), encoding="utf-8")
    except OSError as error:
        raise unwritable(path, error) from error


def taken_by_others(folder: Path, name: str) -> set[Key]:
    """Return the runs that other living writers have taken; traces of dead writers are removed."""
    taken: set[Key] = set()
    for path in folder.glob("*.lock"):
        if path.stem == name:
            continue
        notes = path.with_suffix(".json")
        file = lock.try_acquire(path)
        if file is not None:
            notes.unlink(missing_ok=True)
            path.unlink(missing_ok=True)
            file.close()
        else:
            with contextlib.suppress(FileNotFoundError, ValueError):  # it has not taken any yet
                taken.update((identity, seed) for identity, seed in json.loads(notes.read_text(encoding="utf-8")))
    return taken


def writers(folder: Path) -> int:
    """Return how many writers are alive, without touching anything."""
    return sum(lock.is_held(path) for path in folder.glob("*.lock"))


def withdraw(folder: Path, name: str, file: IO[str]) -> None:
    """Take a writer off the list."""
    for suffix in (".json", ".lock"):
        (folder / f"{name}{suffix}").unlink(missing_ok=True)
    file.close()

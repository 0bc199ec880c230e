"""One writer a folder: a lock that the operating system releases when its holder ends, however it ends."""

import os
import sys
from pathlib import Path
from typing import IO

from formicarium.campaigns.files import StoreError, unwritable

NAME = ".lock"


def acquire(folder: Path) -> IO[str]:
    """Lock a folder for writing and return the open lock file; closing it releases the lock.

    Raises:
        StoreError: if another process holds the lock, or the folder cannot be written.
    """
    path = folder / NAME
    try:
        folder.mkdir(parents=True, exist_ok=True)
        file = path.open("a+", encoding="utf-8")
    except OSError as error:
        raise unwritable(folder, error) from error
    try:
        _lock(file)
    except OSError as error:
        file.close()
        raise StoreError(
            f"{folder} is in use: another process is writing to it. Wait for it to end, or choose another folder."
        ) from error
    return file


if sys.platform == "win32":
    import msvcrt

    def _lock(file: IO[str]) -> None:
        os.lseek(file.fileno(), 0, os.SEEK_SET)
        msvcrt.locking(file.fileno(), msvcrt.LK_NBLCK, 1)
else:
    import fcntl

    def _lock(file: IO[str]) -> None:
        fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)

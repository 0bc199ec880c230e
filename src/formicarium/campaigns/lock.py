"""Locks that the operating system releases when their holder ends, however it ends."""

import os
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import IO

from formicarium.campaigns.files import StoreError, unwritable

NAME = ".lock"


def acquire(folder: Path) -> IO[str]:
    """Lock a folder for writing and return the open lock file; closing it releases the lock.

    Raises:
        StoreError: if another process holds the lock, or the folder cannot be written.
    """
    file = try_acquire(folder / NAME)
    if file is None:
        raise StoreError(
            f"{folder} is in use: another process is writing to it. Wait for it to end, or choose another folder."
        )
    return file


def try_acquire(path: Path) -> IO[str] | None:
    """Lock a file, made if it is not there, and return it open; None if another process holds the lock.

    Raises:
        StoreError: if the file cannot be written.
    """
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        file = path.open("a+", encoding="utf-8")
    except OSError as error:
        raise unwritable(path.parent, error) from error
    try:
        _lock(file, wait=False)
    except OSError:
        file.close()
        return None
    return file


def is_held(path: Path) -> bool:
    """Tell whether a process holds the lock of a file; needs no right to write."""
    try:
        with path.open(encoding="utf-8") as file:
            _lock(file, wait=False, shared=True)
    except FileNotFoundError:
        return False
    except OSError:
        return True
    return False


@contextmanager
def held(path: Path) -> Iterator[None]:
    """Hold the lock of a file during the block; wait for it as long as it takes.

    Raises:
        StoreError: if the file cannot be written, or its file system has no locks.
    """
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        file = path.open("a+", encoding="utf-8")
    except OSError as error:
        raise unwritable(path.parent, error) from error
    with file:
        try:
            _lock(file, wait=True)
        except OSError as error:
            raise StoreError(
                f"cannot lock {path}: {error.strerror or error}. The file system of this folder must have locks."
            ) from error
        yield


if sys.platform == "win32":
    import msvcrt

    def _lock(file: IO[str], wait: bool, shared: bool = False) -> None:
        while True:
            os.lseek(file.fileno(), 0, os.SEEK_SET)
            try:
                msvcrt.locking(file.fileno(), msvcrt.LK_NBLCK, 1)
                return
            except OSError:
                if not wait:
                    raise
                time.sleep(0.02)
else:
    import fcntl

    def _lock(file: IO[str], wait: bool, shared: bool = False) -> None:
        fcntl.flock(file, (fcntl.LOCK_SH if shared else fcntl.LOCK_EX) | (0 if wait else fcntl.LOCK_NB))

"""Whole files or none: everything kept is written to a temporary name, flushed to disk and renamed."""

import json
import os
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any


class StoreError(Exception):
    """A file or folder of results cannot be used; the message names it, what is wrong, and the way out."""


def partial_name(path: Path) -> Path:
    """Return the temporary name beside ``path``; it keeps the suffix, from which writers guess the format."""
    return path.with_name(f".partial-{path.name}")


@contextmanager
def replacing(path: Path) -> Iterator[Path]:
    """Give a temporary path to write to; on success it becomes ``path`` in one step, on failure it is gone.

    Raises:
        StoreError: if the place cannot be written to (no folder, no right, disk full).
    """
    temporary = partial_name(path)
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        try:
            yield temporary
            with temporary.open("rb+") as file:
                os.fsync(file.fileno())
            os.replace(temporary, path)
        finally:
            temporary.unlink(missing_ok=True)
        _flush_folder(path.parent)
    except OSError as error:
        raise unwritable(path, error) from error


def make_folder(path: Path) -> None:
    """Make a folder, or find that it is there.

    Raises:
        StoreError: if it cannot be made or written to.
    """
    try:
        path.mkdir(parents=True, exist_ok=True)
        partial_name(path / "writable").touch()
        partial_name(path / "writable").unlink()
    except OSError as error:
        raise unwritable(path, error) from error


def unwritable(path: Path, error: OSError) -> StoreError:
    """Say that ``path`` cannot be written, and why."""
    reason = error.strerror or str(error)
    return StoreError(
        f"cannot write {path}: {reason}. Choose another folder, or make room and rights for this one; "
        "what was already written there is untouched."
    )


def _flush_folder(folder: Path) -> None:
    # A rename is safe against power loss only when the folder is on disk too. Windows cannot open folders.
    if os.name == "posix":
        descriptor = os.open(folder, os.O_RDONLY)
        try:
            os.fsync(descriptor)
        finally:
            os.close(descriptor)


def write_text(path: Path, text: str) -> None:
    """Write a text file whole."""
    with replacing(path) as temporary:
        temporary.write_text(text, encoding="utf-8", newline="\n")


def write_json(path: Path, content: Mapping[str, Any]) -> None:
    """Write a JSON file whole: keys sorted, two spaces, so that equal content is equal bytes."""
    write_text(path, json.dumps(content, indent=2, sort_keys=True, ensure_ascii=False) + "\n")


def read_json(path: Path) -> dict[str, Any]:
    """Read a JSON object.

    Raises:
        StoreError: if the file is not a JSON object.
    """
    try:
        content = json.loads(path.read_text(encoding="utf-8"))
        if not isinstance(content, dict):
            raise ValueError("not an object")
    except (ValueError, OSError) as error:
        raise StoreError(
            f"{path} is damaged ({error}). Move it away or choose another folder, then run the same command again."
        ) from error
    return content

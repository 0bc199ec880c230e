"""The porch: the one file that knows Numba.

Every function of the simulation is plain Python under the decorator ``compiled``. With the environment
variable ``FORMICARIUM_INTERPRETED=1`` the decorator leaves the functions as they are, so that the same code
can be stepped through in a debugger, and tests can hold the two against each other bit for bit.

Numba's disk cache does not notice an edit in a *called* function of another file and would silently run the
old code. So the cache lives in a folder named after a hash of all sources that can be called, and an edit to
any of them is an empty cache.
"""

import functools
import hashlib
import os
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numba
from platformdirs import user_cache_dir

INTERPRETED = os.environ.get("FORMICARIUM_INTERPRETED", "") not in ("", "0")

PACKAGE = Path(__file__).parent

# The rooms whose code decides results. Views, commands, campaigns and statistics only look at results.
DECIDING = (
    *("compiled.py", "streams.py", "tables.py", "angles.py"),
    *("physics", "robots", "devices", "control", "observers", "trial", "systems"),
)
# Rooms with compiled code that no trial depends on: an edit there leaves the identity of trials alone.
APART = ("scheduling",)


def _python_files(place: Path) -> list[Path]:
    return [place] if place.is_file() else sorted(place.rglob("*.py"))


@functools.cache
def source_hash(folder: Path | None = None) -> str:
    """Hash of every source that decides results: the package's own and, if given, a reader's folder.

    Returns 16 hexadecimal digits. Part of a run's identity (law 8 of the house).
    """
    return _hash_of(*(PACKAGE / name for name in DECIDING), *([folder] if folder else []))


@functools.cache
def room_hash(room: str) -> str:
    """Hash of the sources of a room in ``APART``; 16 hexadecimal digits."""
    return _hash_of(*(PACKAGE / name for name in ("compiled.py", "streams.py", room)))


def _hash_of(*places: Path) -> str:
    digest = hashlib.blake2b(digest_size=8)
    for place in places:
        for file in _python_files(place):
            digest.update(file.name.encode())
            digest.update(file.read_bytes())
    return digest.hexdigest()


def cache_folder(function_file: str) -> Path:
    """Where the machine code of a function in this file is kept."""
    folder = Path(function_file).resolve().parent
    if folder.parent == PACKAGE and folder.name in APART:
        sources = room_hash(folder.name)
    else:
        sources = source_hash(None if folder.is_relative_to(PACKAGE) else folder)
    root = os.environ.get("FORMICARIUM_CACHE_DIR") or user_cache_dir("formicarium", appauthor=False)
    return Path(root) / f"numba-{numba.__version__}-{sources}"


def compiled(function: Callable[..., Any]) -> Any:
    """Compile a function to machine code at its first call and keep the code on disk.

    Floating point is strict (no fused or re-ordered arithmetic), so compiled and interpreted runs agree to
    the last bit as long as the function avoids ``math.hypot``. Compiled functions own no memory: they work on
    arrays handed to them and may not make new ones, which saves counting references to every array of a state
    at every call (measured in docs/why.md).
    """
    if INTERPRETED:
        return function
    config: Any = numba.config
    previous = config.CACHE_DIR
    config.CACHE_DIR = str(cache_folder(function.__code__.co_filename))
    try:
        options: dict[str, Any] = {"cache": True, "fastmath": False, "error_model": "numpy", "_nrt": False}
        return numba.njit(**options)(function)
    finally:
        config.CACHE_DIR = previous

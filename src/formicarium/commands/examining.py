"""What ``doctor`` looks at."""

import os
import platform
import shutil
import subprocess
import sys
import time
from collections.abc import Iterator
from importlib.metadata import PackageNotFoundError, version
from importlib.util import find_spec
from pathlib import Path
from typing import NamedTuple

from formicarium import __version__
from formicarium.commands.extras import MODULES
from formicarium.compiled import INTERPRETED, cache_folder

NEEDED = ("numba", "numpy", "scipy", "pydantic", "pyarrow", "matplotlib")
ROOM = 500  # MB of free disk that a cache and a few runs want


class Finding(NamedTuple):
    """One thing that was looked at."""

    what: str
    well: bool
    remedy: str = ""
    optional: bool = False


def examine() -> Iterator[Finding]:
    """Look at one thing after the other."""
    yield Finding(
        f"formicarium {__version__}, Python {platform.python_version()}, {platform.system()} {platform.machine()}, "
        f"{os.cpu_count()} cores",
        sys.version_info >= (3, 11),
        "Python 3.11 or newer is needed",
    )
    for name in NEEDED:
        try:
            yield Finding(f"{name} {version(name)}", True)
        except PackageNotFoundError:
            yield Finding(f"{name} is missing", False, "python -m pip install --force-reinstall formicarium")
    yield Finding(
        "the compiler is on"
        if not INTERPRETED
        else "FORMICARIUM_INTERPRETED is set: everything is a hundred times slower",
        not INTERPRETED,
        "unset FORMICARIUM_INTERPRETED",
    )
    if not INTERPRETED:
        yield from _cache()
        yield _compiles()
    yield _worker()
    for extra, modules in MODULES.items():
        missing = [module for module in modules if find_spec(module) is None]
        remedy = f'python -m pip install "formicarium[{extra}]"'
        yield Finding(f"extra {extra}{' is not installed' if missing else ''}", not missing, remedy, optional=True)
    yield from _systems()


def _cache() -> Iterator[Finding]:
    folder = cache_folder().parent
    try:
        folder.mkdir(parents=True, exist_ok=True)
        probe = folder / f".probe-{os.getpid()}"
        probe.write_bytes(b"x")
        probe.unlink()
        size = sum(file.stat().st_size for file in folder.rglob("*") if file.is_file()) / 1e6
        yield Finding(f"machine code is kept in {folder} ({size:,.0f} MB)", True)
    except OSError as error:
        yield Finding(f"machine code cannot be kept: {error}", False, "set FORMICARIUM_CACHE_DIR to a folder of yours")
        return
    free = shutil.disk_usage(folder).free / 1e6
    yield Finding(f"{free:,.0f} MB free there", free > ROOM, f"make room, or delete {folder}: it fills itself again")


def _compiles() -> Finding:
    from formicarium.angles import wrapped

    began = time.perf_counter()
    try:
        good = abs(wrapped(7.0) - 0.7168146928204138) < 1e-12
    except Exception as error:
        return Finding(f"compiling fails: {error}", False, "python -m pip install --upgrade numba numpy")
    return Finding(f"compiles or loads a function in {time.perf_counter() - began:.2f} s", good, "report this, please")


def _worker() -> Finding:
    done = subprocess.run([sys.executable, "-c", "import formicarium"], capture_output=True, text=True, check=False)
    remedy = f"another process does not find the package: {done.stderr.strip().splitlines()[-1:]}"
    return Finding("other processes find the package", done.returncode == 0, remedy)


def _systems() -> Iterator[Finding]:
    from formicarium.systems.registry import UnknownSystem, names, resolve

    for name in names():
        try:
            resolve(name)
        except UnknownSystem as error:
            yield Finding(f"system {name} cannot be loaded", False, str(error))
    yield Finding(f"{len(names())} systems, results go to {Path('formicarium-results').resolve()}", True)

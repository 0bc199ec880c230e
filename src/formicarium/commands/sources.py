"""The sources that decide the results of a system: those of the package, and those of a reader's own system."""

import functools
import inspect
import sys
from pathlib import Path

from formicarium.compiled import source_hash, system_hash
from formicarium.sources import PACKAGE, hash_of, own_files
from formicarium.systems.registry import System


def sources_of(system: System) -> str:
    """Return the hash of all sources that decide the results of a system: 16 hexadecimal digits."""
    file, package = home_of(system)
    return system_hash(file) if file.is_relative_to(PACKAGE) else _own_hash(file, package)


def home_of(system: System) -> tuple[Path, str | None]:
    """Return the file in which a system is put together, and the name of its package."""
    if system.home is not None:
        module = sys.modules[system.home]
        return Path(str(module.__file__)).resolve(), module.__package__
    run = system.run.func if isinstance(system.run, functools.partial) else inspect.unwrap(system.run)
    return Path(inspect.getfile(run)).resolve(), sys.modules[run.__module__].__package__


@functools.cache
def _own_hash(file: Path, package: str | None) -> str:
    return hash_of(own_files(file, package), source_hash())

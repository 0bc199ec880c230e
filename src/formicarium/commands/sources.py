"""The sources that decide the results of a system: those of the package, and those of a reader's own system."""

import functools
import hashlib
import inspect
import sys
from modulefinder import ModuleFinder
from pathlib import Path

from formicarium.compiled import PACKAGE, source_hash
from formicarium.systems.registry import System


def sources_of(system: System) -> str:
    """Return the hash of all sources that decide the results of a system: 16 hexadecimal digits."""
    if system.home is not None:
        module = sys.modules[system.home]
        return _hash_of(Path(str(module.__file__)).resolve(), module.__package__)
    run = system.run.func if isinstance(system.run, functools.partial) else inspect.unwrap(system.run)
    file = Path(inspect.getfile(run)).resolve()
    return _hash_of(file, sys.modules[run.__module__].__package__)


def _hash_of(file: Path, package: str | None) -> str:
    return source_hash() if file.is_relative_to(PACKAGE) else _own_hash(file, package)


@functools.cache
def _own_hash(file: Path, package: str | None) -> str:
    digest = hashlib.blake2b(source_hash().encode(), digest_size=8)
    for path in own_files(file, package):
        digest.update(path.name.encode())
        digest.update(path.read_bytes())
    return digest.hexdigest()


def own_files(file: Path, package: str | None) -> list[Path]:
    """Return the files that a reader's system is made of.

    Of a package, all its files. Of a single file, that and what it imports from its folder: designs, tests and
    drawings beside it decide nothing.
    """
    if package:
        return sorted(file.parents[package.count(".")].rglob("*.py"))
    finder = ModuleFinder([str(file.parent)])
    finder.run_script(str(file))
    places = (module.__file__ for module in finder.modules.values())  # type: ignore[attr-defined]
    return sorted(Path(place) for place in places if place)

"""Which files a reader's own code is made of: what a function can call, wherever it lies."""

import ast
import functools
import hashlib
import re
import sys
from importlib.metadata import PackageNotFoundError, requires
from importlib.util import find_spec
from pathlib import Path

PACKAGE = Path(__file__).parent
INSTALLED = {"site-packages", "dist-packages"}


@functools.cache
def own_files(file: Path, package: str | None) -> tuple[Path, ...]:
    """Return the files that a reader's module is made of, sorted.

    Of a package, all its files. Of a single file, that file. Of both, what they import from elsewhere, and what that
    imports; but not the standard library, nor this package, nor installed packages that do not build on it.
    Designs, tests and drawings that lie beside a single file decide nothing.

    Args:
        file: of the module.
        package: dotted name of the package that it belongs to, None or empty for none.
    """
    root = file.parents[package.count(".") + 1] if package else file.parent
    waiting = _of_package(file.parents[package.count(".")]) if package else [file]
    found: set[Path] = set()
    while waiting:
        path = waiting.pop()
        if path in found:
            continue
        found.add(path)
        for name in _imported(path):
            waiting += [place for place in _files_of(name, root) if place not in found]
    return tuple(sorted(found))


IMPORTED = re.compile(rb"^\s*(?:from|import) formicarium((?:\.\w+)*)", re.MULTILINE)


def reached(*files: Path) -> tuple[Path, ...]:
    """Return files of the package and all that they import from the package, and what that imports, sorted.

    An import from a whole room takes in all files that lie directly in it.
    """
    waiting, found = list(files), set()
    while waiting:
        path = waiting.pop()
        if path not in found and path.exists():
            found.add(path)
            for name in IMPORTED.findall(path.read_bytes()):
                place = PACKAGE.joinpath(*name.decode().split(".")[1:])
                waiting += place.glob("*.py") if place.is_dir() else [place.with_suffix(".py")]
    return tuple(sorted(found))


def hash_of(files: tuple[Path, ...], before: str = "") -> str:
    """Return a hash of names and contents of files: 16 hexadecimal digits."""
    digest = hashlib.blake2b(before.encode(), digest_size=8)
    for path in files:
        digest.update(path.name.encode())
        digest.update(path.read_bytes())
    return digest.hexdigest()


def _of_package(folder: Path) -> list[Path]:
    return sorted(folder.rglob("*.py"))


def _imported(path: Path) -> set[str]:
    """Return the names of all modules that a file imports by their full name, as "a" or "a.b"."""
    try:
        tree = ast.parse(path.read_bytes())
    except (SyntaxError, ValueError, OSError):
        return set()
    names: set[str] = set()
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            names |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom) and node.module and not node.level:
            names.add(node.module)
    return {name.partition(".")[0] for name in names} - set(sys.stdlib_module_names) - {PACKAGE.name, "__main__"}


@functools.cache
def _files_of(name: str, root: Path) -> tuple[Path, ...]:
    """Return the files of a module or package that code in ``root`` imports by this name."""
    for place in (root / f"{name}.py", root / name):
        if place.is_file():
            return (place,)
        if place.is_dir() and (found := _of_package(place)):
            return tuple(found)
    try:
        found_spec = find_spec(name)
    except (ImportError, ValueError, AttributeError):
        return ()
    if found_spec is None:
        return ()
    folders = [Path(folder) for folder in found_spec.submodule_search_locations or ()]
    places = folders or ([Path(found_spec.origin)] if found_spec.origin and found_spec.has_location else [])
    if any(INSTALLED & set(place.parts) for place in places) and not _builds_on_us(name):
        return ()
    files = [file for place in places for file in (_of_package(place) if place.is_dir() else [place])]
    return tuple(file.resolve() for file in files if file.suffix == ".py")


def _builds_on_us(name: str) -> bool:
    try:
        return any(need.startswith(PACKAGE.name) for need in requires(name) or ())
    except (PackageNotFoundError, ValueError):
        return False

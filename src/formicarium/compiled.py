"""The porch: the one file that knows Numba.

Every function of the simulation is plain Python under the decorator ``compiled``. With the environment
variable ``FORMICARIUM_INTERPRETED=1`` the decorator leaves the functions as they are, so that the same code
can be stepped through in a debugger, and tests can hold the two against each other bit for bit.

Numba's disk cache does not notice an edit in a *called* function of another file and would silently run the
old code. So the cache lives in a folder named after a hash of all sources that can be called, and an edit to
any of them is an empty cache. Machine code that knows a reader's types lies in a folder of the reader's sources, also
that of the package's functions: nobody else has to be able to import them.
"""

import functools
import hashlib
import io
import os
import pickle
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from formicarium.sources import PACKAGE, hash_of, own_files

INTERPRETED = os.environ.get("FORMICARIUM_INTERPRETED", "") not in ("", "0")

if not INTERPRETED:  # a robot of flesh, or a debugger, has no use for a compiler
    import numba
    from numba.core import serialize
    from numba.core.caching import FunctionCache
    from platformdirs import user_cache_dir

# The rooms whose code decides results. Views, commands, campaigns and statistics only look at results.
DECIDING = (
    *("compiled.py", "streams.py", "tables.py", "angles.py", "connectivity", "studies/estimators.py"),
    *("physics", "robots", "devices", "control", "observers", "trial", "systems"),
)
# Rooms with compiled code that no trial depends on: an edit there leaves the identity of trials alone.
APART = ("scheduling",)


def _python_files(place: Path) -> list[Path]:
    return [place] if place.is_file() else sorted(place.rglob("*.py"))


@functools.cache
def source_hash() -> str:
    """Hash of every source of the package that decides results: 16 hexadecimal digits.

    Part of a run's identity (law 8 of the house).
    """
    return _hash_of(*DECIDING)


@functools.cache
def room_hash(room: str) -> str:
    """Hash of the sources of a room in ``APART``: 16 hexadecimal digits."""
    return _hash_of("compiled.py", "streams.py", room)


def _hash_of(*names: str) -> str:
    digest = hashlib.blake2b(digest_size=8)
    for name in names:
        for file in _python_files(PACKAGE / name):
            digest.update(file.name.encode())
            digest.update(file.read_bytes())
    return digest.hexdigest()


def cache_folder(*modules: tuple[str, str | None]) -> Path:
    """Where machine code is kept that knows these modules: (file, its package) of each, the function's own first."""
    own: set[Path] = set()
    package = source_hash()
    for k, (file, name) in enumerate(modules):
        path = Path(file).resolve()
        if not path.is_relative_to(PACKAGE):
            own |= set(own_files(path, name))
        elif k == 0 and path.relative_to(PACKAGE).parts[0] in APART:
            package = room_hash(path.relative_to(PACKAGE).parts[0])
    key = hash_of(tuple(sorted(own)), package) if own else package
    root = os.environ.get("FORMICARIUM_CACHE_DIR") or user_cache_dir("formicarium", appauthor=False)
    return Path(root) / f"numba-{numba.__version__}-{key}"


@contextmanager
def kept_in(folder: Path) -> Iterator[None]:
    """Let Numba keep machine code in a folder."""
    config: Any = numba.config
    previous = config.CACHE_DIR
    config.CACHE_DIR = str(folder)
    try:
        yield
    finally:
        config.CACHE_DIR = previous


class _Named(pickle.Unpickler):
    """Lists the modules that a pickle names."""

    def __init__(self, content: bytes):
        super().__init__(io.BytesIO(content))
        self.modules: set[str] = set()

    def find_class(self, module: str, name: str) -> Any:
        self.modules.add(module)
        return super().find_class(module, name)


LIBRARIES = ("numba", "numpy", "builtins", "copyreg", "_codecs", "collections", PACKAGE.name)


def foreign_modules(signature: Any) -> set[str]:
    """Return the modules of a reader whose types are part of a signature."""
    named = _Named(serialize.dumps(signature))
    named.load()
    foreign = {module for module in named.modules if module.partition(".")[0] not in LIBRARIES}
    return {module for module in foreign if getattr(sys.modules.get(module), "__file__", None)}


class SharedCache:
    """The machine code of one function: a folder for each set of sources that its types come from.

    Numba writes all signatures of a function into one index, and a process that cannot import a module that is named
    there cannot use any of them.
    """

    def __init__(self, function: Callable[..., Any], kind: str):
        self.function, self.kind = function, kind
        self._parts: dict[frozenset[str], Any] = {}
        self._part(frozenset())

    def _part(self, modules: frozenset[str]) -> Any:
        if modules not in self._parts:
            own = (self.function.__code__.co_filename, self.function.__globals__.get("__package__"))
            others = [(str(sys.modules[name].__file__), sys.modules[name].__package__) for name in sorted(modules)]
            with kept_in(cache_folder(own, *others) / self.kind):
                self._parts[modules] = FunctionCache(self.function)
        return self._parts[modules]

    def load_overload(self, signature: Any, context: Any) -> Any:
        """Return the machine code for a signature, None if there is none."""
        return self._part(frozenset(foreign_modules(signature))).load_overload(signature, context)

    def save_overload(self, signature: Any, data: Any) -> None:
        """Keep the machine code for a signature."""
        self._part(frozenset(foreign_modules(signature))).save_overload(signature, data)

    def flush(self) -> None:
        """Forget what is kept."""
        for part in self._parts.values():
            part.flush()

    @property
    def cache_path(self) -> str:
        """Folder of the function's own part."""
        return self._parts[frozenset()].cache_path


class Compiled:
    """A function in machine code, for compiled callers and for Python.

    To be called from Python, machine code needs a wrapper that takes every record and array of a state apart. Numba
    makes two for every function, and they were a third of a cold start. Nearly all functions are called by compiled
    ones alone, so the wrapper is made, with a copy of the function, when Python calls (measured in docs/why.md).
    """

    def __init__(self, function: Callable[..., Any]):
        """Prepare; nothing is compiled before the first call."""
        functools.update_wrapper(self, function)
        self.inner = _njit(function, "inner", no_cpython_wrapper=True)

    def __call__(self, *arguments: Any) -> Any:
        """Run the machine code from Python."""
        return self._outer(*arguments)

    @functools.cached_property
    def _outer(self) -> Any:
        return _njit(self.inner.py_func, "outer")

    @property
    def _numba_type_(self) -> Any:
        """What compiled callers take this object for."""
        return self.inner._numba_type_


def _njit(function: Callable[..., Any], kind: str, **more: bool) -> Any:
    options: dict[str, Any] = {"fastmath": False, "error_model": "numpy", "_nrt": False}
    options |= {"no_cfunc_wrapper": True, **more}
    dispatcher = numba.njit(**options)(function)
    if Path(function.__code__.co_filename).is_file():
        dispatcher._cache = SharedCache(function, kind)
    return dispatcher


def compiled(function: Callable[..., Any]) -> Any:
    """Compile a function to machine code at its first call and keep the code on disk.

    Floating point is strict (no fused or re-ordered arithmetic), so compiled and interpreted runs agree to
    the last bit as long as the function avoids ``math.hypot``. Compiled functions own no memory: they work on
    arrays handed to them and may not make new ones, which saves counting references to every array of a state
    at every call (measured in docs/why.md). Code that is typed into a session has no file and is not kept.
    """
    return function if INTERPRETED else Compiled(function)

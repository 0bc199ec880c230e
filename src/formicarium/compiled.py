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
import io
import os
import pickle
import subprocess
import sys
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, suppress
from importlib import import_module
from multiprocessing import parent_process
from pathlib import Path
from typing import Any

from formicarium.sources import PACKAGE, hash_of, own_files, reached

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
    """Hash of every source of the package that decides results: 16 hexadecimal digits."""
    return hash_of(tuple(_sources(*DECIDING)))


@functools.cache
def system_hash(file: Path) -> str:
    """Hash of every source that decides the results of one of the package's systems: 16 hexadecimal digits.

    Part of a run's identity (law 8 of the house). Those are the deciding sources that its file reaches by imports, and
    what injects failures into any system.

    Args:
        file: in which the system is put together.
    """
    used = set(reached(file, PACKAGE / "systems" / "failing.py"))
    return hash_of(tuple(source for source in _sources(*DECIDING) if source in used))


@functools.cache
def room_hash(room: str) -> str:
    """Hash of the sources of a room in ``APART``: 16 hexadecimal digits."""
    return hash_of(tuple(_sources("compiled.py", "streams.py", room)))


def _sources(*names: str) -> list[Path]:
    return [file for name in names for file in _python_files(PACKAGE / name)]


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

    def is_empty(self) -> bool:
        """Tell whether no machine code of the function is kept that knows the package's types alone."""
        own = self._parts[frozenset()]
        return not (Path(own.cache_path) / f"{own._impl.filename_base}.nbi").exists()

    def flush(self) -> None:
        """Forget what is kept."""
        for part in self._parts.values():
            part.flush()

    @property
    def cache_path(self) -> str:
        """Folder of the function's own part."""
        return self._parts[frozenset()].cache_path


# Names of arguments that are made of many arrays, which are handed over one by one.
LARGE = ("state", "world", "solver")


class Compiled:
    """A function in machine code, for compiled callers and for Python.

    To be called from Python, machine code needs a wrapper that takes every record and array of a state apart. Numba
    makes two for every function, and they were a third of a cold start. Nearly all functions are called by compiled
    ones alone, so the wrapper is made, with a copy of the function, when Python calls (measured in docs/why.md).
    """

    def __init__(self, function: Callable[..., Any]):
        """Prepare; nothing is compiled before the first call."""
        functools.update_wrapper(self, function)
        takes_large = function.__code__.co_varnames[:1] in [(name,) for name in LARGE]
        self.inner = _njit(function, "inner", no_cpython_wrapper=True, forceinline=takes_large)

    def __call__(self, *arguments: Any) -> Any:
        """Run the machine code from Python."""
        return self._outer(*arguments)

    def is_new(self) -> bool:
        """Tell whether calling the function from Python means that it has to be compiled."""
        return isinstance(self._outer._cache, SharedCache) and self._outer._cache.is_empty()

    @functools.cached_property
    def _outer(self) -> Any:
        return _njit(self.inner.py_func, "outer")

    @property
    def _numba_type_(self) -> Any:
        """What compiled callers take this object for."""
        return self.inner._numba_type_


def _njit(function: Callable[..., Any], kind: str, **more: bool) -> Any:
    file = Path(function.__code__.co_filename)
    own = not file.is_relative_to(PACKAGE)
    options: dict[str, Any] = {"fastmath": False, "_nrt": False, "no_cfunc_wrapper": True, **more}
    options |= {"error_model": "python", "boundscheck": True} if own else {"error_model": "numpy"}
    dispatcher = numba.njit(**options)(function)
    if file.is_file():
        dispatcher._cache = SharedCache(function, kind)
    return dispatcher


Call = tuple[Any, tuple[Any, ...]]  # a function of the package and the arguments of a call of it


@contextmanager
def compiled_beside(caller: Any, calls: Sequence[Call]) -> Iterator[None]:
    """Let a process beside this one compile functions while this one compiles their caller, if its machine code is new.

    A cold start takes two thirds of the time on two cores (measured in docs/why.md). Both processes write to the same
    folder; what the helper is not done with when the caller comes to it, the caller compiles.

    Args:
        caller: compiled in the body of the ``with`` statement.
        calls: what the helper compiles, in its order; arguments of the types that the caller hands over.
    """
    if INTERPRETED or parent_process() is not None or not isinstance(caller, Compiled) or not caller.is_new():
        yield
        return
    work = [(function.__module__, function.__qualname__, tuple(map(numba.typeof, given))) for function, given in calls]
    program = "import sys; from formicarium.compiled import compile_named; compile_named(sys.stdin.buffer.read())"
    quiet = subprocess.DEVNULL
    helper = subprocess.Popen([sys.executable, "-c", program], stdin=subprocess.PIPE, stdout=quiet, stderr=quiet)
    try:
        with suppress(OSError), helper.stdin as pipe:  # type: ignore[union-attr]
            pipe.write(serialize.dumps(work))
        yield
    finally:
        helper.kill()
        helper.wait()


def compile_named(message: bytes) -> None:
    """Compile functions for the types in a pickle that ``compiled_beside`` wrote."""
    for module, name, types in pickle.loads(message):
        getattr(import_module(module), name).inner.compile(types)


def compiled(function: Callable[..., Any]) -> Any:
    """Compile a function to machine code at its first call and keep the code on disk.

    Floating point is strict (no fused or re-ordered arithmetic), so compiled and interpreted runs agree to
    the last bit as long as the function avoids ``math.hypot``. Compiled functions own no memory: they work on
    arrays handed to them and may not make new ones, which saves counting references to every array of a state
    at every call (measured in docs/why.md). A function whose first argument is a ``state``, a ``world`` or a
    ``solver`` becomes part of the code of its callers: those are many arrays, and slow to hand over. A reader's
    functions are checked: as in plain Python, an index beyond an array and a division by zero are errors. Code that
    is typed into a session has no file and is not kept.
    """
    return function if INTERPRETED else Compiled(function)

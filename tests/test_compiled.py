"""The porch: old machine code never runs for new sources, and everything can run without a compiler."""

import os
import shutil
import subprocess
import sys

import pytest

from formicarium import compiled, sources
from formicarium.angles import wrapped
from formicarium.compiled import APART, DECIDING, cache_folder
from formicarium.sources import PACKAGE, own_files

PROGRAM = "import sys; sys.path.insert(0, sys.argv[1]); import caller; print(caller.call(1.0))"


def python(program, *arguments, cache, **environment):
    done = subprocess.run(
        [sys.executable, "-c", program, *map(str, arguments)], capture_output=True, text=True, check=False,
        env=os.environ | {"FORMICARIUM_CACHE_DIR": str(cache), "FORMICARIUM_INTERPRETED": ""} | environment,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    return done.stdout.strip()


@pytest.fixture
def reader(tmp_path):
    """A reader's own folder: one compiled function that calls one of another file."""
    folder = tmp_path / "own"
    folder.mkdir()
    (folder / "called.py").write_text(
        "from formicarium.compiled import compiled\n\n\n@compiled\ndef called(x):\n    return x + 1.0\n"
    )
    (folder / "caller.py").write_text(
        "from called import called\nfrom formicarium.compiled import compiled\n\n\n"
        "@compiled\ndef call(x):\n    return called(x)\n"
    )
    return folder


def machine_code(cache):
    return {str(file.relative_to(cache)) for file in cache.rglob("*.nbc")}


def test_machine_code_is_kept_and_used_again(reader, tmp_path):
    cache = tmp_path / "cache"
    assert python(PROGRAM, reader, cache=cache) == "2.0"
    kept = machine_code(cache)
    assert len(kept) == 2
    assert python(PROGRAM, reader, cache=cache) == "2.0"
    assert machine_code(cache) == kept


def test_an_edit_of_a_called_function_in_another_file_is_noticed(reader, tmp_path):
    assert python(PROGRAM, reader, cache=tmp_path / "cache") == "2.0"
    called = reader / "called.py"
    called.write_text(called.read_text().replace("1.0", "2.0"))
    assert python(PROGRAM, reader, cache=tmp_path / "cache") == "3.0"


def test_interpreted_functions_are_plain_functions_and_leave_no_machine_code(reader, tmp_path):
    program = PROGRAM + "; print(type(caller.call).__name__)"
    told = python(program, reader, cache=tmp_path / "cache", FORMICARIUM_INTERPRETED="1")
    assert told.split() == ["2.0", "function"]
    assert machine_code(tmp_path) == set()


def test_the_hash_knows_every_source_that_is_compiled():
    places = [PACKAGE / name for name in (*DECIDING, *APART)]
    assert all(place.exists() for place in places)
    for file in PACKAGE.rglob("*.py"):
        if "@compiled" in file.read_text() and PACKAGE / "commands" / "layout" not in file.parents:
            assert any(file == place or place in file.parents for place in places), file


def test_the_folder_changes_with_a_readers_sources_and_only_then(tmp_path):
    def folder(name="a.py"):
        own_files.cache_clear()
        return cache_folder((str(tmp_path / name), ""))

    (tmp_path / "a.py").write_text("import b\n")
    (tmp_path / "b.py").write_text("x = 1\n")
    first = folder()
    assert folder() == first and first.name.startswith("numba-")
    (tmp_path / "drawing.py").write_text("import a\n")
    assert folder() == first
    (tmp_path / "b.py").write_text("x = 2\n")
    second = folder()
    (tmp_path / "a.py").rename(tmp_path / "c.py")
    assert len({first, second, folder("c.py")}) == 3


def test_a_readers_machine_code_is_kept_apart_from_the_packages(tmp_path):
    (tmp_path / "own.py").write_text("")
    own, package = (
        cache_folder((str(tmp_path / "own.py"), "")),
        cache_folder((str(PACKAGE / "angles.py"), "formicarium")),
    )
    assert own != package
    assert cache_folder((str(PACKAGE / "physics" / "step.py"), "formicarium.physics")) == package


EDITED = (
    "swarm/inner/called.py",
    "swarm/beside.py",
    "swarm/numbers.py",
    "elsewhere.py",
    "library/deep/inside.py",
)
ONE = "from formicarium.compiled import compiled\n\n\n@compiled\ndef {name}():\n    return 1.0\n"


def test_no_edit_of_any_file_of_a_reader_is_masked(tmp_path):
    """Called functions and numbers: in the same folder, above it, in a file and in a package elsewhere."""
    own = tmp_path / "own"
    for folder in ("swarm/inner", "library/deep"):
        (own / folder).mkdir(parents=True)
        for part in (own / folder, (own / folder).parent):
            (part / "__init__.py").touch()
    (own / "swarm/inner/called.py").write_text(ONE.format(name="called"))
    (own / "swarm/beside.py").write_text(ONE.format(name="beside"))
    (own / "swarm/numbers.py").write_text("NUMBER = 1.0\n")
    (own / "elsewhere.py").write_text(ONE.format(name="elsewhere"))
    (own / "library/deep/inside.py").write_text(ONE.format(name="inside"))
    (own / "swarm/inner/caller.py").write_text(
        "from elsewhere import elsewhere\nfrom formicarium.compiled import compiled\n"
        "from library.deep.inside import inside\nfrom swarm.beside import beside\n"
        "from swarm.inner.called import called\nfrom ..numbers import NUMBER\n\n\n"
        "@compiled\ndef call():\n    return called() + beside() + NUMBER + elsewhere() + inside()\n"
    )
    program = "import sys; sys.path.insert(0, sys.argv[1]); from swarm.inner import caller; print(caller.call())"
    place = {"cache": tmp_path / "cache", "PYTHONDONTWRITEBYTECODE": "1"}  # Python's own cache trusts dates
    assert python(program, own, **place) == "5.0"
    kept = machine_code(tmp_path / "cache")
    assert python(program, own, **place) == "5.0" and machine_code(tmp_path / "cache") == kept
    for count, edited in enumerate(EDITED, 1):
        file = own / edited
        times = file.stat()
        file.write_text(file.read_text().replace("1.0", "8.0"))
        os.utime(file, ns=(times.st_atime_ns, times.st_mtime_ns))  # a copy or an archive may bring an old date
        assert python(program, own, **place) == str(5.0 + 7.0 * count), edited


def test_compiled_arithmetic_is_strict():
    options = getattr(getattr(wrapped, "inner", None), "targetoptions", None)
    if options is None:
        pytest.skip("running interpreted")
    assert not options["fastmath"] and options["error_model"] == "numpy"


STRANGE_STATE = """
import sys
sys.path.insert(0, sys.argv[1])
import numpy as np
from formicarium.trial.phases import speaks
from strange import State
print(speaks(State(np.zeros(12, np.int64))))
"""

OURS = """
import numpy as np
from formicarium.physics.records import records
from formicarium.robots.records import COMMAND
from formicarium.trial.phases import speaks
print(speaks(records(COMMAND, 1)[0]))
"""


def test_a_readers_state_does_not_spoil_the_packages_machine_code_for_others(tmp_path):
    """A reader's system hands its own NamedTuple to the package's phases; then somebody else, without it, runs."""
    own = tmp_path / "own"
    own.mkdir()
    (own / "strange.py").write_text(
        "from typing import NamedTuple\nimport numpy as np\n\n\nclass State(NamedTuple):\n    enabled: np.ndarray\n"
    )
    assert python(STRANGE_STATE, own, cache=tmp_path / "cache") == "0"
    assert python(OURS, cache=tmp_path / "cache") == "0"


BESIDE = """
import subprocess, sys, time
from pathlib import Path
sys.path.insert(0, sys.argv[1])
import caller
from formicarium.angles import wrapped
from formicarium.compiled import compiled_beside

if sys.argv[3] == "no helper":
    subprocess.Popen = None
with compiled_beside(caller.call, [(wrapped, (1.0,))]):
    patience = time.monotonic() + 60.0 * (sys.argv[3] == "helper")
    while not (found := list(Path(sys.argv[2]).rglob("angles.wrapped*.nbi"))) and time.monotonic() < patience:
        time.sleep(0.05)
    print(len(found), caller.call(1.0))
"""


def test_a_cold_start_compiles_in_two_processes_and_a_warm_one_in_none(reader, tmp_path):
    cache = tmp_path / "cache"
    assert python(BESIDE, reader, cache, "helper", cache=cache) == "1 2.0"
    assert python(BESIDE, reader, cache, "no helper", cache=cache) == "1 2.0"


def test_a_helper_that_cannot_be_of_help_changes_nothing(reader, tmp_path):
    cache = tmp_path / "cache"
    program = BESIDE.replace("wrapped, (1.0,)", 'wrapped, ("a word",)')  # no machine code for words
    assert python(program, reader, cache, "failing helper", cache=cache) == "0 2.0"


def test_an_edit_outdates_the_runs_of_those_systems_that_it_can_change(tmp_path, monkeypatch):
    package = tmp_path / "formicarium"
    shutil.copytree(PACKAGE, package, ignore=shutil.ignore_patterns("__pycache__"))
    for module in (compiled, sources):
        monkeypatch.setattr(module, "PACKAGE", package)
    homes = [package / "systems" / name / "study.py" for name in ("sequencing", "partitioning", "coverage")]

    def kept(*place):
        """Tell whose runs outlive an edit."""
        before = [compiled.system_hash.__wrapped__(home) for home in homes]
        path = package.joinpath(*place)
        path.write_text(path.read_text() + "\n# another thought\n")
        return [old == compiled.system_hash.__wrapped__(home) for old, home in zip(before, homes)]

    assert kept("systems", "partitioning", "behaviour.py") == [True, False, True]
    assert kept("robots", "footbot.py") == [True, True, False]
    assert kept("devices", "depot.py") == [True, False, True]
    assert kept("trial", "situated.py") == [True, True, False]
    assert kept("physics", "grid.py") == kept("trial", "simulate.py") == kept("systems", "failing.py") == [False] * 3
    assert kept("views", "frames.py") == kept("systems", "own.py") == [True] * 3

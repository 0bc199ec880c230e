"""The porch: old machine code never runs for new sources, and everything can run without a compiler."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

from formicarium.angles import wrapped
from formicarium.compiled import APART, DECIDING, PACKAGE, cache_folder, source_hash

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
        if "@compiled" in file.read_text():
            assert any(file == place or place in file.parents for place in places), file


def test_the_hash_changes_with_a_readers_sources_and_only_then(tmp_path):
    def hashed():
        source_hash.cache_clear()
        return source_hash(tmp_path)

    (tmp_path / "a.py").write_text("x = 1\n")
    first = hashed()
    assert hashed() == first and len(first) == 16
    (tmp_path / "notes.txt").write_text("nothing to do with it")
    assert hashed() == first
    (tmp_path / "a.py").write_text("x = 2\n")
    second = hashed()
    (tmp_path / "a.py").rename(tmp_path / "b.py")
    assert len({first, second, hashed()}) == 3


def test_a_readers_machine_code_is_kept_apart_from_the_packages(tmp_path):
    (tmp_path / "own.py").write_text("")
    own, package = cache_folder(str(tmp_path / "own.py")), cache_folder(str(PACKAGE / "angles.py"))
    assert own != package
    assert cache_folder(str(PACKAGE / "physics" / "step.py")) == package
    assert Path(package).name.startswith("numba-")


def test_compiled_arithmetic_is_strict():
    options = getattr(wrapped, "targetoptions", None)
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


@pytest.mark.xfail(
    strict=True, reason="numba unpickles the signatures of all its callers, also of modules that are gone"
)
def test_a_readers_state_does_not_spoil_the_packages_machine_code_for_others(tmp_path):
    """A reader's system hands its own NamedTuple to the package's phases; then somebody else, without it, runs."""
    own = tmp_path / "own"
    own.mkdir()
    (own / "strange.py").write_text(
        "from typing import NamedTuple\nimport numpy as np\n\n\nclass State(NamedTuple):\n    enabled: np.ndarray\n"
    )
    assert python(STRANGE_STATE, own, cache=tmp_path / "cache") == "0"
    assert python(OURS, cache=tmp_path / "cache") == "0"

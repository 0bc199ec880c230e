"""Tables come back as they were written, in the same bytes, and a flipped bit is noticed."""

import subprocess
import sys
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from formicarium.campaigns import table
from formicarium.campaigns.files import StoreError

VALUES = st.fixed_dictionaries(
    {
        "count": st.integers(-(2**62), 2**62) | st.none(),
        "time": st.floats(allow_nan=False) | st.none(),
        "name": st.text() | st.none(),
        "done": st.booleans(),
    }
)


@given(st.lists(VALUES, min_size=1, max_size=5))
def test_rows_survive_and_repeat_their_bytes(tmp_path_factory, rows):
    folder = tmp_path_factory.mktemp("table")
    written = table.with_metadata(table.from_rows(rows), {"system": "counting"})
    table.write(written, folder / "one.parquet")
    back = table.read(folder / "one.parquet")
    assert back.to_pylist() == rows
    assert table.metadata_of(back.schema)["system"] == "counting"
    table.write(table.with_metadata(table.from_rows(back.to_pylist()), {"system": "counting"}), folder / "two.parquet")
    assert (folder / "one.parquet").read_bytes() == (folder / "two.parquet").read_bytes()


def test_whole_numbers_among_fractions_become_fractions():
    assert table.from_rows([{"a": 1}, {"a": 2.5}, {"a": None}])["a"].to_pylist() == [1.0, 2.5, None]


@pytest.mark.parametrize("place", ["cut", "empty", "flipped"])
def test_a_damaged_table_is_named(tmp_path, place):
    path = tmp_path / "runs.parquet"
    table.write(table.from_rows([{"seed": k, "time": k / 7} for k in range(1000)]), path)
    content = bytearray(path.read_bytes())
    if place == "flipped":
        content[len(content) // 3] ^= 0x10
    path.write_bytes({"cut": content[: len(content) // 2], "empty": b"", "flipped": content}[place])
    with pytest.raises(StoreError, match=r"runs\.parquet is damaged .*Move it away"):
        table.read(path)


@pytest.mark.skipif(not Path("/proc/self/task").exists(), reason="counts threads as Linux lists them")
def test_reading_starts_no_threads(tmp_path):
    """Threads of Arrow abort the interpreter at its exit, now and then (apache/arrow issue 34314)."""
    path = tmp_path / "runs.parquet"
    table.write(table.from_rows([{"seed": k, "time": k / 7, "name": str(k)} for k in range(1000)]), path)
    code = (
        "import os, sys; from pathlib import Path; from formicarium.campaigns import parts, table; "
        "before = len(os.listdir('/proc/self/task')); table.read(Path(sys.argv[1])); "
        "sys.exit(len(os.listdir('/proc/self/task')) - before)"
    )
    assert subprocess.run([sys.executable, "-c", code, str(path)], check=False).returncode == 0

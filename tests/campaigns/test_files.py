"""A file is whole or absent, and a place that cannot be written is named."""

import pytest

from formicarium.campaigns import claims, lock
from formicarium.campaigns.files import StoreError, read_json, replacing, write_json


def test_a_failed_write_leaves_the_old_file_and_nothing_else(tmp_path):
    path = tmp_path / "kept.txt"
    path.write_text("old")
    with pytest.raises(ZeroDivisionError), replacing(path) as temporary:
        temporary.write_text("half of the n")
        raise ZeroDivisionError
    assert [file.name for file in tmp_path.iterdir()] == ["kept.txt"]
    assert path.read_text() == "old"


def test_a_place_below_a_file_cannot_be_written(tmp_path):
    (tmp_path / "file").write_text("")
    with pytest.raises(StoreError, match=r"cannot write .*file/inner\.json.*Choose another folder"):
        write_json(tmp_path / "file" / "inner.json", {})


def test_equal_content_is_equal_bytes(tmp_path):
    write_json(tmp_path / "one.json", {"b": 1, "a": {"d": 2.5, "c": None}})
    write_json(tmp_path / "two.json", {"a": {"c": None, "d": 2.5}, "b": 1})
    assert (tmp_path / "one.json").read_bytes() == (tmp_path / "two.json").read_bytes()


@pytest.mark.parametrize("text", ["", "{", "[1]", "\x00\x01"])
def test_a_damaged_json_file_is_named(tmp_path, text):
    path = tmp_path / "configuration.json"
    path.write_text(text)
    with pytest.raises(StoreError, match=r"configuration\.json is damaged"):
        read_json(path)


def test_counting_who_is_at_work_touches_nothing(tmp_path):
    with claims.register(tmp_path, "alive"):
        (tmp_path / "dead.lock").touch(mode=0o444)
        before = {path: path.stat().st_mtime_ns for path in tmp_path.iterdir()}
        assert claims.writers(tmp_path) == 1
        assert {path: path.stat().st_mtime_ns for path in tmp_path.iterdir()} == before
    assert claims.writers(tmp_path) == 0
    assert not lock.is_held(tmp_path / "gone.lock")
    assert not (tmp_path / "gone.lock").exists()

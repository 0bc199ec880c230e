"""A design is checked before anything starts; what is wrong is named with file, key and value."""

import numpy as np
import pytest

from formicarium.campaigns.cells import cells_of
from formicarium.campaigns.design import make_design
from formicarium.campaigns.design_file import read_content
from formicarium.campaigns.errors import DesignError
from formicarium.campaigns.seeds import derived_seeds

PLAIN = {"name": "study", "system": "walk", "replicates": 3}


def cells(**more):
    return cells_of(make_design({**PLAIN, **more}))


def test_factors_are_crossed_the_last_one_fastest():
    found = [cell.factors for cell in cells(factors={"a": [1, 2], "b": ["x", "y", "z"]})]
    assert found[:4] == [{"a": 1, "b": "x"}, {"a": 1, "b": "y"}, {"a": 1, "b": "z"}, {"a": 2, "b": "x"}]
    assert len(found) == 6


def test_rows_vary_together_and_are_crossed_with_factors():
    rows = [{"setting": 0, "robots": 16}, {"setting": 1, "robots": 20}]
    assert [cell.factors for cell in cells(rows=rows)] == rows
    assert [cell.factors["c"] for cell in cells(rows=rows, factors={"c": [True, False]})] == [True, False, True, False]


def test_without_factors_there_is_one_cell():
    (cell,) = cells()
    assert cell.factors == {}
    assert len(cell.seeds) == 3


def test_derived_seeds_depend_on_study_cell_and_replicate_only():
    before = {str(cell.factors): cell.seeds for cell in cells(factors={"a": [1, 2]})}
    assert len({seed for seeds in before.values() for seed in seeds}) == 6
    after = {str(cell.factors): cell.seeds for cell in cells(factors={"a": [0, 2, 1]}, replicates=5)}
    for factors, seeds in before.items():
        assert after[factors][:3] == seeds
    assert cells(name="other")[0].seeds != cells()[0].seeds
    assert derived_seeds("study", {"a": 1}, 3) == derived_seeds("study", {"a": 1.0}, 3)
    assert derived_seeds("study", {"a": 1, "b": 2}, 3) == derived_seeds("study", {"b": 2, "a": 1}, 3)


def test_a_derived_seed_never_changes():
    """Seeds are part of published results; this one was computed once."""
    assert derived_seeds("study", {"a": 1}, 1) == (927883948533941,)


def test_a_first_seed_counts_on_and_a_row_may_have_its_own():
    assert cells(first_seed=60001)[0].seeds == (60001, 60002, 60003)
    found = cells(rows=[{"robots": 4, "first_seed": 100}, {"robots": 5, "first_seed": 200}])
    assert [cell.seeds[0] for cell in found] == [100, 200]
    assert [cell.factors for cell in found] == [{"robots": 4}, {"robots": 5}]


def test_listed_seeds_are_used_as_they_are():
    assert cells_of(make_design({"name": "s", "system": "w", "seeds": [9, 4, 7]}))[0].seeds == (9, 4, 7)


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"replicates": 0}, ["replicates = 0", "greater than or equal to 1"]),
        ({"replicates": -3}, ["replicates = -3"]),
        ({"replicates": "ten"}, ['replicates = "ten"', "valid integer"]),
        ({"replicates": 2.5}, ["replicates = 2.5"]),
        ({"replicates": True}, ["replicates = true"]),
        ({"replicates": None}, ["replicates", "missing"]),
        ({"name": ""}, ['name = ""']),
        ({"name": "a/b"}, ['name = "a/b"']),
        ({"replicate": 3}, ["replicate: no such key", "Did you mean replicates"]),
        ({"seeds": [1, 2, 1]}, ["'seeds' lists 1 more than once"]),
        ({"seeds": []}, ["seeds = []"]),
        ({"seeds": [1]}, ["'replicates' is 3", "lists 1"]),
        ({"seeds": [1, 2, -1]}, ["seeds[2] = -1"]),
        ({"seeds": [1, 2, 3], "first_seed": 1}, ["exclude each other"]),
        ({"first_seed": 2**63 - 2}, ["first_seed", "above 2^63"]),
        ({"factors": {"a": []}}, ["factors.a = []"]),
        ({"factors": {"a": 3}}, ["factors.a = 3: must be a list"]),
        ({"factors": 3}, ["factors = 3: must be a table"]),
        ({"factors": {"a": [{"b": 1}]}}, ["factors.a[0]", "must be a number, a text"]),
        ({"factors": {"a": [float("nan")]}}, ["factors.a[0] = NaN"]),
        ({"rows": []}, ["'rows' is an empty table"]),
        ({"rows": [{"a": 1}, {"a": 1, "b": 2}]}, ["rows[1] alone has 'b'"]),
        ({"rows": [{"a": 1, "b": 2}, {"a": 1}]}, ["rows[1] has no 'b'"]),
        ({"rows": [{"a": 1}], "factors": {"a": [2]}}, ["'a' is in 'factors' and in 'rows'"]),
        ({"rows": [{"a": 1, "first_seed": "x"}]}, ["rows[0].first_seed = 'x'"]),
        ({"set": {"a": 1}, "factors": {"a": [2]}}, ["'a' is in 'factors' and in 'set'"]),
        ({"set": {"a": 1}, "rows": [{"a": 2}]}, ["'a' is in 'rows' and in 'set'"]),
        ({"time_limit": 0}, ["time_limit = 0"]),
    ],
)
def test_what_is_wrong_is_named(change, words):
    with pytest.raises(DesignError) as caught:
        make_design({**PLAIN, **change}, "study.toml")
    for word in words:
        assert word in str(caught.value)
    assert str(caught.value).startswith("study.toml: ")


def test_too_many_runs_are_refused():
    with pytest.raises(DesignError, match="at most 1,000,000"):
        cells(factors={"a": list(range(5000)), "b": list(range(5000))})


TEXTS = {
    "toml": 'name = "study"\nsystem = "walk"\nreplicates = 2\n[factors]\nrobots = [4, 5]\n[[rows]]\nspeed = 0.5\n',
    "yaml": "name: study\nsystem: walk\nreplicates: 2\nfactors:\n  robots: [4, 5]\nrows:\n  - speed: 0.5\n",
    "py": "DESIGN = dict(name='study', system='walk', replicates=2, factors={'robots': [4, 5]}, rows=[{'speed': .5}])",
}


def test_all_kinds_of_files_say_the_same(tmp_path):
    for kind, text in TEXTS.items():
        (tmp_path / f"study.{kind}").write_text(text)
    found = [read_content(tmp_path / f"study.{kind}") for kind in TEXTS]
    assert found[0] == found[1] == found[2]


def test_python_may_say_ranges_tuples_and_arrays():
    found = cells(seeds=range(1, 4), factors={"a": np.linspace(1, 2, 3), "b": (np.int64(4), np.bool_(True))})
    assert [cell.factors for cell in found[:3]] == [{"a": 1.0, "b": 4}, {"a": 1.0, "b": True}, {"a": 1.5, "b": 4}]
    assert {type(cell.factors["b"]) for cell in found} == {int, bool}
    assert found[0].seeds == (1, 2, 3)


@pytest.mark.parametrize(
    ("name", "text", "words"),
    [
        ("a.toml", "name = ", "a.toml: is not valid TOML"),
        ("a.yaml", "name: [", "a.yaml: is not valid YAML"),
        ("a.yaml", "- 1", "a.yaml: must hold keys"),
        ("a.yaml", "factors: {robots: [4], robots: [5]}", "'robots' is there more than once"),
        ("a.yaml", "name: a\nsystem: walk\nname: b", "'name' is there more than once"),
        ("a.toml", "name = 'a'\nname = 'b'", "a.toml: is not valid TOML"),
        ("a.py", "1 / 0", "a.py: ZeroDivisionError"),
        ("a.py", "raise SystemExit(0)", "a.py: SystemExit"),
        ("a.py", "X = 1", "a.py: sets no DESIGN"),
        ("a.json", "{}", "a.json: a design is a file that ends in .toml, .yaml, .yml, .py"),
    ],
)
def test_a_file_that_cannot_be_read_is_named(tmp_path, name, text, words):
    (tmp_path / name).write_text(text)
    with pytest.raises(DesignError, match=words):
        read_content(tmp_path / name)
    with pytest.raises(DesignError, match="there is no such file"):
        read_content(tmp_path / "nowhere.toml")

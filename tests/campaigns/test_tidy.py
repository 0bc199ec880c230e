"""The tidy table: factors beside results, whatever they are called."""

from functools import partial

from counted_campaign import campaign
from formicarium.campaigns.cells import Job, cells_of
from formicarium.campaigns.configuration import Configuration
from formicarium.campaigns.design import make_design
from formicarium.campaigns.here import Here
from formicarium.campaigns.result import Result


def give(row, seed, watch):
    return Result(row, {})


def table_of(folder, factors, row_of):
    design = make_design({"name": "counted", "system": "squares", "seeds": [1], "factors": factors})
    jobs = [
        Job(cell, Configuration("squares", dict(cell.factors), "", ""), partial(give, row_of(cell.factors)))
        for cell in cells_of(design)
    ]
    return campaign(folder, Here(), jobs)[1]


def test_a_factor_that_is_a_result_too_is_one_column(tmp_path):
    found = table_of(tmp_path, {"count": [2, 4]}, lambda factors: {"count": factors["count"], "time": 1.0})
    assert found.column_names == ["cell", "count", "replicate", "seed", "time", "identity", "sources"]


def test_a_factor_that_differs_from_the_result_of_its_name_is_told_apart(tmp_path):
    found = table_of(tmp_path, {"count": [2, 4]}, lambda factors: {"count": 7})
    assert found["factor.count"].to_pylist() == [2, 4]
    assert found["count"].to_pylist() == [7, 7]


def test_names_that_the_table_needs_are_told_apart(tmp_path):
    found = table_of(tmp_path, {"seed": [5], "cell": [6]}, lambda factors: {"cell": 8, "replicate": 9})
    row = found.to_pylist()[0]
    assert (row["cell"], row["replicate"], row["seed"]) == (0, 0, 1)
    assert (row["factor.seed"], row["factor.cell"], row["result.cell"], row["result.replicate"]) == (5, 6, 8, 9)


def test_whole_numbers_fractions_texts_and_lists_are_factors(tmp_path):
    found = table_of(tmp_path, {"a": [1, 2.5], "b": ["x", "y"], "c": [[1, 2]], "d": [True]}, lambda factors: {"v": 1})
    assert found["a"].to_pylist() == [1.0, 1.0, 2.5, 2.5]
    assert found["b"].to_pylist() == ["x", "y", "x", "y"]
    assert found["c"].to_pylist() == ["[1, 2]"] * 4
    assert found["d"].to_pylist() == [True] * 4


def test_columns_that_are_always_empty_stay(tmp_path):
    found = table_of(tmp_path, {"a": [1, 2]}, lambda factors: {"never": None, "v": 1})
    assert found["never"].to_pylist() == [None, None]

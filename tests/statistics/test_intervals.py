"""Wilson's interval against his formula."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from formicarium.statistics.intervals import wilson


@given(st.integers(1, 500).flatmap(lambda n: st.tuples(st.integers(0, n), st.just(n))))
def test_wilson_is_wilsons_formula(counts):
    successes, runs = counts
    z, p = 1.959963984540054, successes / runs
    middle = (p + z * z / (2 * runs)) / (1 + z * z / runs)
    half = z / (1 + z * z / runs) * math.sqrt(p * (1 - p) / runs + z * z / (4 * runs * runs))
    found = wilson(successes, runs)
    assert found.low == pytest.approx(max(middle - half, 0), abs=1e-9)
    assert found.high == pytest.approx(min(middle + half, 1), abs=1e-9)
    assert found.value == p


def test_more_successes_than_runs_are_refused():
    with pytest.raises(ValueError):
        wilson(3, 2)

"""Percentiles of a heap, from those of its samples, against the heap itself."""

import numpy as np
import pytest

from formicarium.statistics.pooling import pooled_percentiles

SHARES = (5, 25, 50, 75, 95)


def test_one_sample_is_its_own_heap():
    values = [1.0, 2.0, 4.0, 8.0, 16.0]
    assert pooled_percentiles(SHARES, [values], [7]) == pytest.approx(values)
    assert pooled_percentiles(SHARES, [values, values], [7, 3]) == pytest.approx(values)


def test_a_large_sample_counts_for_more_and_the_heap_is_wider_than_its_samples():
    draws = np.random.default_rng(1)
    samples = [draws.gamma(3.0, scale, size) for scale, size in ((20.0, 4000), (40.0, 1000), (25.0, 2000))]
    heap = np.percentile(np.concatenate(samples), SHARES)
    found = pooled_percentiles(SHARES, [np.percentile(s, SHARES) for s in samples], [len(s) for s in samples])
    assert found == pytest.approx(heap, rel=0.06)
    apart = pooled_percentiles(SHARES, [[1.0, 1.1, 1.2, 1.3, 1.4], [9.0, 9.1, 9.2, 9.3, 9.4]], [10, 30])
    assert apart[0] < 1.3 and apart[2] > 9.0  # where medians of the samples' percentiles would be 5.0 and 5.2


def test_nothing_is_refused():
    with pytest.raises(ValueError, match="no percentiles"):
        pooled_percentiles(SHARES, [], [])

"""Means with their confidence intervals."""

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from scipy import stats


class Mean(NamedTuple):
    """A mean with its confidence interval; with one value the interval is that value."""

    value: float
    low: float
    high: float
    number: int  # of values


def mean_of(values: Sequence[float] | np.ndarray, confidence: float = 0.95) -> Mean:
    """Return the mean with Student's interval.

    Raises:
        ValueError: if there are no values.
    """
    found = np.asarray(values, float)
    if not len(found):
        raise ValueError("no values have no mean")
    value = float(found.mean())
    if len(found) == 1:
        return Mean(value, value, value, 1)
    error = float(found.std(ddof=1)) / math.sqrt(len(found))
    half = float(stats.t.ppf(0.5 + 0.5 * confidence, len(found) - 1)) * error
    return Mean(value, value - half, value + half, len(found))


def welch(first: Sequence[float], second: Sequence[float]) -> float:
    """Return the two-sided p-value of Welch's test that two sets have the same mean; 1 with fewer than two values."""
    if len(first) < 2 or len(second) < 2:
        return 1.0
    if np.ptp(first) == 0.0 and np.ptp(second) == 0.0:
        return 1.0 if first[0] == second[0] else 0.0
    return float(stats.ttest_ind(first, second, equal_var=False).pvalue)

"""Means with their confidence intervals."""

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
import scipy


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
    half = float(scipy.stats.t.ppf(0.5 + 0.5 * confidence, len(found) - 1)) * error
    return Mean(value, value - half, value + half, len(found))


def contrast(cells: Sequence[Sequence[float]], weights: Sequence[float], confidence: float = 0.95) -> Mean:
    """Return a weighted sum of the means of cells, with an interval that lets every cell have its own variance.

    Variance: ``sum w^2 s^2 / n``; degrees of freedom after Satterthwaite (1946). A cell of one value takes the mean
    variance of the others; if no cell has two values the interval is the sum itself.

    Raises:
        ValueError: if a cell is empty.
    """
    if not all(len(cell) for cell in cells):
        raise ValueError("no values have no mean")
    sizes, factors = np.array([len(cell) for cell in cells], float), np.asarray(weights, float)
    value = float(factors @ [np.mean(cell) for cell in cells])
    spreads = np.array([np.var(cell, ddof=1) if len(cell) > 1 else math.nan for cell in cells])
    number = int(sizes.sum())
    known = sizes > 1
    if not known.any() or not np.nansum(spreads):
        return Mean(value, value, value, number)
    parts = factors**2 * np.where(known, spreads, np.nanmean(spreads)) / sizes
    freedom = parts.sum() ** 2 / (parts[known] ** 2 / (sizes[known] - 1)).sum()
    half = float(scipy.stats.t.ppf(0.5 + 0.5 * confidence, freedom)) * math.sqrt(parts.sum())
    return Mean(value, value - half, value + half, number)


def welch(first: Sequence[float], second: Sequence[float]) -> float:
    """Return the two-sided p-value of Welch's test that two sets have the same mean; 1 with fewer than two values."""
    if len(first) < 2 or len(second) < 2:
        return 1.0
    if np.ptp(first) == 0.0 and np.ptp(second) == 0.0:
        return 1.0 if first[0] == second[0] else 0.0
    return float(scipy.stats.ttest_ind(first, second, equal_var=False).pvalue)

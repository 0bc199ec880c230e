"""Tests of whether two sets of runs differ."""

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
import scipy


class Comparison(NamedTuple):
    """Outcome of a two-sided test of two sets of runs against "no difference"."""

    test: str
    statistic: float
    p_value: float


def log_rank(
    times: Sequence[float | None],
    ends: Sequence[float],
    other_times: Sequence[float | None],
    other_ends: Sequence[float],
) -> Comparison:
    """Compare two run-time distributions with censoring (log-rank test; Mantel 1966).

    Times and ends as for ``run_times``. The statistic is the signed square root of chi-squared; where no run of one
    set reached the target while runs of both were still going, nothing speaks for a difference.
    """
    with np.errstate(invalid="ignore", divide="ignore"):
        result = scipy.stats.logrank(_censored(times, ends), _censored(other_times, other_ends))
    if not math.isfinite(result.statistic):
        return Comparison("log-rank", 0.0, 1.0)
    return Comparison("log-rank", float(result.statistic), float(result.pvalue))


def fisher(successes: int, runs: int, other_successes: int, other_runs: int) -> Comparison:
    """Compare two shares (Fisher's exact test). The statistic is the sample odds ratio."""
    result = scipy.stats.fisher_exact([[successes, runs - successes], [other_successes, other_runs - other_successes]])
    return Comparison("Fisher exact", float(result.statistic), float(result.pvalue))


def _censored(times: Sequence[float | None], ends: Sequence[float]) -> "scipy.stats.CensoredData":
    reached = np.array([time is not None and math.isfinite(time) for time in times])
    seconds = [time if there else end for time, end, there in zip(times, ends, reached)]
    return scipy.stats.CensoredData.right_censored(seconds, ~reached)

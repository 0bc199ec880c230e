"""Run-time distributions: the share of runs that had reached a target by time t, with censored runs.

A run that ended without reaching its target says only that its time is longer than that (it is censored).
The estimate is Kaplan and Meier's; when no run ended before the common cap it is simply
``RTD(t) = #{r_j <= t} / k`` for k runs (Hoos & Stuetzle 2004).
"""

import math
import warnings
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
import scipy


class RunTimes(NamedTuple):
    """Distribution of the time to a target over k runs."""

    times: np.ndarray  # (T,) seconds, increasing: when a run reached the target or ended
    share: np.ndarray  # (T,) share of runs that have reached it by then
    low: np.ndarray  # (T,) lower end of the confidence band, 0 before the first success
    high: np.ndarray  # (T,) upper end of the confidence band, nan before the first success
    runs: int  # k
    reached: int  # runs that reached the target
    end: float  # seconds, end of the longest run

    def at(self, time: float) -> float:
        """Return the share of runs that have reached the target by ``time``."""
        index = int(np.searchsorted(self.times, time, side="right")) - 1
        return float(self.share[index]) if index >= 0 else 0.0

    @property
    def median(self) -> float:
        """Time by which half of the runs have reached the target, seconds; infinite if it was not reached.

        Where exactly half have, it lies midway between that time and the next, as a median of an even
        number of times does.
        """
        half = np.flatnonzero(self.share > 0.5 - 1e-12)
        more = np.flatnonzero(self.share > 0.5 + 1e-12)
        return float((self.times[half[0]] + self.times[more[0]]) / 2) if len(more) else math.inf


def run_times(times: Sequence[float | None], ends: Sequence[float], confidence: float = 0.95) -> RunTimes:
    """Estimate a run-time distribution with a pointwise log-log confidence band.

    Args:
        times: of each run, seconds; None, nan or inf where the target was not reached.
        ends: when each run ended, seconds; used where the target was not reached.
        confidence: of the band at each time.

    Raises:
        ValueError: if there are no runs, or the lengths differ.
    """
    if len(times) != len(ends) or not len(times):
        raise ValueError(f"need one end for each of at least one run, got {len(times)} times, {len(ends)} ends")
    reached = np.array([time is not None and math.isfinite(time) for time in times])
    seconds = np.array([time if there else end for time, end, there in zip(times, ends, reached)], float)
    estimate = scipy.stats.ecdf(scipy.stats.CensoredData.right_censored(seconds, ~reached)).cdf
    low, high = _band(estimate, confidence)
    return RunTimes(
        np.asarray(estimate.quantiles),
        np.asarray(estimate.probabilities),
        low,
        high,
        len(seconds),
        int(reached.sum()),
        float(seconds.max()),
    )


def _band(estimate, confidence: float) -> tuple[np.ndarray, np.ndarray]:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", RuntimeWarning)  # undefined at shares 0 and 1; filled in below
        interval = estimate.confidence_interval(confidence, method="log-log")
    low, high = np.array(interval.low.probabilities), np.array(interval.high.probabilities)
    share = np.asarray(estimate.probabilities)
    low[share == 0] = 0.0
    complete = np.isnan(low)  # share 1: the formula ends one step earlier, the lower end stays where it was
    low[complete] = np.nanmax(low, initial=0.0)
    high[complete] = 1.0
    return low, high


def in_words(seconds: float, digits: int = 0) -> str:
    """Write a time for people: "1,458 s", or "not reached"."""
    return f"{seconds:,.{digits}f} s" if math.isfinite(seconds) else "not reached"

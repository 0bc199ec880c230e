"""How large a difference between two sets of runs is, with its confidence interval."""

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
import scipy

from formicarium.statistics.intervals import wilson

RESAMPLES = 4000
Times = Sequence[float | None]  # seconds; None, nan or inf where the target was not reached


class Effect(NamedTuple):
    """A difference with its confidence interval; nan where it is not defined."""

    value: float
    low: float
    high: float


def risk_difference(successes: int, runs: int, other_successes: int, other_runs: int) -> Effect:
    """Return the first share minus the second, with Newcombe's interval (1998, method 10; 95 %).

    With Wilson's intervals (l, u) and (l', u') of the shares p and p' it is
    ``p - p' - sqrt((p - l)^2 + (u' - p')^2)`` to ``p - p' + sqrt((u - p)^2 + (p' - l')^2)``.
    """
    one, other = wilson(successes, runs), wilson(other_successes, other_runs)
    difference = one.value - other.value
    below = math.hypot(one.value - one.low, other.high - other.value)
    above = math.hypot(one.high - one.value, other.value - other.low)
    return Effect(difference, difference - below, difference + above)


def odds_ratio(successes: int, runs: int, other_successes: int, other_runs: int) -> Effect:
    """Return the odds of success in the first set over those in the second (conditional estimate, exact 95 %)."""
    failures, other_failures = runs - successes, other_runs - other_successes
    if not (successes + other_successes) or not (failures + other_failures):
        return Effect(math.nan, 0.0, math.inf)  # all runs of both sets ended alike
    found = scipy.stats.contingency.odds_ratio([[successes, failures], [other_successes, other_failures]])
    interval = found.confidence_interval(0.95)
    return Effect(float(found.statistic), float(interval.low), float(interval.high))


def hazard_ratio(times: Times, ends: Sequence[float], other_times: Times, other_ends: Sequence[float]) -> Effect:
    """Return the rate of reaching the target in the first set over that in the second (95 %).

    Cox's proportional hazards with the set as the only covariate, ties after Efron (1977); the interval is where
    twice the log partial likelihood is within 3.84 of its maximum. Above 1: the first set is faster.
    """
    seconds, reached, first = _joined(times, ends, other_times, other_ends)
    if not reached[first].any() or not reached[~first].any():
        low, high = (0.0, math.inf)
        value = math.nan if not reached.any() else (0.0 if not reached[first].any() else math.inf)
        return Effect(value, low, high)
    groups = _tied(seconds, reached, first)

    def minus_likelihood(logarithm: float) -> float:
        ratio, total = math.exp(logarithm), 0.0
        for deaths, own_deaths, at_risk, own_at_risk in groups:
            risk = at_risk - own_at_risk + ratio * own_at_risk
            tied = deaths - own_deaths + ratio * own_deaths
            shares = np.arange(deaths) / deaths
            total += own_deaths * logarithm - float(np.log(risk - shares * tied).sum())
        return -total

    best = scipy.optimize.minimize_scalar(
        minus_likelihood, bounds=(-12.0, 12.0), method="bounded", options={"xatol": 1e-9}
    )
    limit = best.fun + scipy.stats.chi2.ppf(0.95, 1) / 2

    def beyond(logarithm: float) -> float:
        return minus_likelihood(logarithm) - limit

    low = scipy.optimize.brentq(beyond, -12.0, best.x) if beyond(-12.0) > 0 else -math.inf
    high = scipy.optimize.brentq(beyond, best.x, 12.0) if beyond(12.0) > 0 else math.inf
    return Effect(math.exp(best.x), math.exp(low), math.exp(high))


def _joined(
    times: Times, ends: Sequence[float], other_times: Times, other_ends: Sequence[float]
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    one, one_reached = observed(times, ends)
    other, other_reached = observed(other_times, other_ends)
    first = np.arange(len(one) + len(other)) < len(one)
    return np.concatenate([one, other]), np.concatenate([one_reached, other_reached]), first


def observed(times: Times, ends: Sequence[float]) -> tuple[np.ndarray, np.ndarray]:
    """Return for every run the time it was seen to (seconds) and whether it had reached the target then."""
    reached = np.array([time is not None and math.isfinite(time) for time in times], bool)
    return np.array([time if there else end for time, end, there in zip(times, ends, reached)], float), reached


def _tied(seconds: np.ndarray, reached: np.ndarray, first: np.ndarray) -> list[tuple[int, int, int, int]]:
    """For every time of an event: events, those of the first set, runs at risk, those of the first set."""
    groups = []
    for time in np.unique(seconds[reached]):
        now, risk = reached & (seconds == time), seconds >= time
        groups.append((int(now.sum()), int((now & first).sum()), int(risk.sum()), int((risk & first).sum())))
    return groups


def median_ratio(
    times: Times, ends: Sequence[float], other_times: Times, other_ends: Sequence[float], seed: int = 0
) -> Effect:
    """Return the median time of the first set over that of the second, with a bootstrap interval (95 %).

    Medians are Kaplan and Meier's; a median that was not reached is infinite. The interval holds the middle 95 %
    of the ratios of runs drawn again from each set; where neither median was reached a draw says nothing, and is
    counted against both ends.
    """
    random = np.random.default_rng(seed)
    one, other = observed(times, ends), observed(other_times, other_ends)
    with np.errstate(invalid="ignore"):
        as_they_are = [_medians(*runs, np.arange(len(runs[0]))[None])[0] for runs in (one, other)]
        value = float(as_they_are[0] / as_they_are[1])
        drawn = [random.integers(0, len(runs[0]), (RESAMPLES, len(runs[0]))) for runs in (one, other)]
        ratios = _medians(*one, drawn[0]) / _medians(*other, drawn[1])
    low = np.quantile(np.where(np.isnan(ratios), 0.0, ratios), 0.025, method="lower")
    high = np.quantile(np.where(np.isnan(ratios), math.inf, ratios), 0.975, method="higher")
    return Effect(value, float(low), float(high))


def _medians(seconds: np.ndarray, reached: np.ndarray, drawn: np.ndarray) -> np.ndarray:
    """Return the median of every row of ``drawn`` (indices of runs), midway where exactly half have reached."""
    order = np.lexsort((~reached, seconds))  # at equal times those that reached the target come first
    places = np.sort(np.argsort(order)[drawn], axis=1)
    times, events = seconds[order][places], reached[order][places]
    left = 1.0 - events / (drawn.shape[1] - np.arange(drawn.shape[1]))
    survival = np.cumprod(left, axis=1)
    medians = np.full(len(drawn), math.inf)
    half, more = survival < 0.5 + 1e-9, survival < 0.5 - 1e-9
    there = more.any(axis=1)
    rows = np.flatnonzero(there)
    medians[rows] = (times[rows, half[rows].argmax(axis=1)] + times[rows, more[rows].argmax(axis=1)]) / 2
    return medians


def holm(p_values: Sequence[float]) -> list[float]:
    """Return p-values adjusted for the number of tests (Holm 1979)."""
    order = np.argsort(p_values)
    adjusted, largest = [0.0] * len(p_values), 0.0
    for rank, index in enumerate(order):
        largest = max(largest, min(1.0, (len(p_values) - rank) * p_values[index]))
        adjusted[index] = largest
    return adjusted

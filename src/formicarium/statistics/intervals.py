"""Confidence intervals of shares."""

from typing import NamedTuple

import scipy


class Share(NamedTuple):
    """A share of runs with its confidence interval."""

    successes: int
    runs: int
    low: float  # lower end, 0..1
    high: float  # upper end, 0..1

    @property
    def value(self) -> float:
        """Successes over runs."""
        return self.successes / self.runs


def wilson(successes: int, runs: int, confidence: float = 0.95) -> Share:
    """Return a share with Wilson's score interval (Wilson 1927).

    Raises:
        ValueError: if there are no runs, or more successes than runs.
    """
    interval = scipy.stats.binomtest(successes, runs).proportion_ci(confidence, method="wilson")
    return Share(successes, runs, float(interval.low), float(interval.high))

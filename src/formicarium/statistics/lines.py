"""Straight lines through points."""

from collections.abc import Sequence
from typing import NamedTuple

import scipy


class Line(NamedTuple):
    """A straight line y = intercept + slope x, fitted by least squares."""

    slope: float
    intercept: float
    r_squared: float  # share of the variance of y that the line accounts for

    def at(self, x: float) -> float:
        """Return the height of the line at ``x``."""
        return self.intercept + self.slope * x


def fit_line(x: Sequence[float], y: Sequence[float]) -> Line:
    """Fit a line to points.

    Raises:
        ValueError: if there are fewer than three points (two always lie on a line), or all have the same x.
    """
    if len(x) < 3:
        raise ValueError(f"a line through {len(x)} points says nothing: need at least 3")
    found = scipy.stats.linregress(x, y)
    return Line(float(found.slope), float(found.intercept), float(found.rvalue**2))

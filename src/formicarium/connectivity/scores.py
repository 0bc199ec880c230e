"""How good estimates are, judged by an evaluator that sees the whole graph (ST-12). No estimator imports this file."""

from typing import NamedTuple

import numpy as np

from formicarium.connectivity.estimate import Estimates
from formicarium.connectivity.exact import algebraic_connectivity, random_walk_connectivity
from formicarium.connectivity.parameters import EstimatorTable

TEN_PERCENT, ONE_PERCENT = 0.10, 0.01


def error(adjacency: np.ndarray, estimates: Estimates, estimator: EstimatorTable, metric: str) -> np.ndarray:
    """Return the relative error of the median node after each noted iteration; 1.0 is 100 %.

    Args:
        adjacency: (K, K) of a connected graph.
        estimates: of that graph's nodes.
        estimator: that made them.
        metric: "eigenvalue": of lambda2 (PI1, PI2) or of mu2 (Wave); "paper": the same, but of omega2 for Wave.

    Raises:
        ValueError: if the metric is unknown.
    """
    if metric not in ("eigenvalue", "paper"):
        raise ValueError(f"metric {metric!r} is not eigenvalue or paper")
    if estimator.method != "Wave":
        return relative_error(estimates.values, algebraic_connectivity(adjacency))
    truth = random_walk_connectivity(adjacency)
    if metric == "eigenvalue" or estimates.frequencies is None:
        return relative_error(estimates.values, truth)
    return relative_error(estimates.frequencies, float(np.arccos(1.0 - 0.5 * estimator.wave_speed**2 * truth)))


def relative_error(values: np.ndarray, truth: float) -> np.ndarray:
    """Return the median over nodes (last axis) of |value - truth| / truth; values that are not finite do not count.

    Where no node has a finite value: infinity.
    """
    with np.errstate(invalid="ignore"):
        off = np.abs(values - truth) / truth
    off = np.sort(np.where(np.isfinite(values), off, np.nan), axis=-1)  # nan last
    count = np.isfinite(off).sum(axis=-1)
    low, high = (np.maximum(0, place) for place in ((count - 1) // 2, count // 2))
    middle = [np.take_along_axis(off, place[..., None], axis=-1)[..., 0] for place in (low, high)]
    return np.where(count > 0, 0.5 * (middle[0] + middle[1]), np.inf)


class Reached(NamedTuple):
    """When an error was small enough; None: never."""

    first: int | None  # iteration at which it first was
    stays: int | None  # from which on it was to the end


def reached(iterations: np.ndarray, errors: np.ndarray, limit: float) -> Reached:
    """Return when errors (S,) at iterations (S,) came down to a limit."""
    good = errors <= limit
    if not good.any():
        return Reached(None, None)
    bad = np.flatnonzero(~good)
    last_bad = int(bad[-1]) if len(bad) else -1
    stays = int(iterations[last_bad + 1]) if last_bad + 1 < len(good) else None
    return Reached(int(iterations[int(good.argmax())]), stays)

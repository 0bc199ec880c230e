"""Percentiles of what several samples hold together, from the percentiles of each."""

from collections.abc import Sequence

import numpy as np


def pooled_percentiles(
    shares: Sequence[float], percentiles: Sequence[Sequence[float]], sizes: Sequence[int]
) -> list[float]:
    """Return the percentiles of all samples in one heap, each value with the same weight.

    Each sample's distribution is taken to be straight between its percentiles, and to go on beyond the outer two as
    steeply as just inside them; the heap's is their mean, weighted by size.

    Args:
        shares: which percentiles, in percent, increasing.
        percentiles: of every sample, (samples, shares).
        sizes: number of values of every sample, (samples,).

    Raises:
        ValueError: if there is no sample.
    """
    if not len(sizes) or not sum(sizes):
        raise ValueError("no values have no percentiles")
    below, above = shares[0] / (shares[1] - shares[0]), (100.0 - shares[-1]) / (shares[-1] - shares[-2])
    heights = np.array([0.0, *shares, 100.0]) / 100.0
    curves = []
    for values in percentiles:
        first = values[0] - below * (values[1] - values[0])
        last = values[-1] + above * (values[-1] - values[-2])
        curves.append([first, *values, last])
    places = np.unique(np.array(curves))
    weights = np.asarray(sizes, float) / sum(sizes)
    heap = sum(weight * np.interp(places, curve, heights) for weight, curve in zip(weights, curves, strict=True))
    return [float(np.interp(share / 100.0, heap, places)) for share in shares]

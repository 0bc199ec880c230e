"""Which chain members stand next to each other, as far as a frame tells."""

import numpy as np


def bands(places: np.ndarray, reach: float) -> list[np.ndarray]:
    """Join neighbours: the shortest tree over all members, without its edges longer than ``reach``.

    A frame holds no list of who is linked to whom, so this is a drawing aid, not a measurement.

    Args:
        places: (N, 2) positions of the chain members, metres.
        reach: metres.

    Returns:
        Segments, each (2, 2).
    """
    if len(places) < 2:
        return []
    difference = places[:, None] - places[None]
    distance = np.sqrt((difference**2).sum(axis=2))
    # Prim's algorithm: grow the tree by the member nearest to it.
    nearest = np.zeros(len(places), int)
    gap = distance[0].copy()
    gap[0] = np.inf
    segments = []
    for _ in range(len(places) - 1):
        new = int(np.argmin(gap))
        if gap[new] <= reach:
            segments.append(places[[nearest[new], new]])
        closer = distance[new] < gap
        closer &= np.isfinite(gap)
        nearest[closer] = new
        gap[closer] = distance[new][closer]
        gap[new] = np.inf
    return segments

"""Estimators on delivered messages (ST-73)."""

import numpy as np
import pytest

from formicarium.connectivity.aboard import estimate_aboard
from formicarium.connectivity.estimate import estimate
from formicarium.connectivity.graphs import random_unit_disc
from formicarium.connectivity.parameters import METHODS, estimator

GRAPH = random_unit_disc(10, 0.5, 301)


@pytest.mark.parametrize("method", METHODS)
def test_where_everything_arrives_and_nobody_moves_it_is_the_plain_estimator(method):
    """To the last bit, though the loop is another one."""
    aboard = estimate_aboard(np.repeat(GRAPH[None], 400, axis=0), estimator(method), seed=3, every=7)
    plain = estimate(GRAPH, estimator(method), seed=3, iterations=400, every=7)
    assert aboard.iterations.tolist() == plain.iterations.tolist()
    assert aboard.values.tobytes() == plain.values.tobytes()


@pytest.mark.parametrize("method", METHODS)
def test_a_message_that_did_not_arrive_says_nothing(method):
    """Whoever hears nobody estimates the same whatever the others are."""
    said = []
    for seed in (1, 2):
        received = np.repeat(random_unit_disc(10, 0.5, 300 + seed)[None].astype(bool), 60, axis=0)
        received[:, 4, :] = False
        said.append(estimate_aboard(received, estimator(method), seed=9).values[:, 4])
    assert np.array_equal(*said, equal_nan=True)


def test_losses_are_directed_and_of_their_cycle_alone():
    """One message lost in cycle 20, from 1 to 0, changes node 0 then, and nobody else before the next cycle."""
    received = np.repeat(GRAPH[None].astype(bool), 40, axis=0)
    other = received.copy()
    sender = int(np.flatnonzero(GRAPH[0])[0])
    other[20, 0, sender] = False
    one, two = (estimate_aboard(r, estimator("PI1"), seed=5).values for r in (received, other))
    changed = one != two
    assert not changed[:20].any()
    assert changed[20, 0] and not changed[20, 1:].any()
    assert changed[25, np.flatnonzero(GRAPH[0])].all()


def test_nobody_aboard_has_global_memory():
    with pytest.raises(ValueError, match="global memory"):
        estimate_aboard(GRAPH[None], estimator("PI1", "author"), seed=1)

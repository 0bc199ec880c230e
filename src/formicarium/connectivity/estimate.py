"""Run an estimator on a graph: every node's estimate after every iteration."""

from typing import NamedTuple

import numpy as np

from formicarium.connectivity.parameters import EstimatorTable, LinksTable
from formicarium.connectivity.records import MESSAGE, NODE
from formicarium.connectivity.rounds import iterate
from formicarium.connectivity.spectrum import read_out
from formicarium.streams import generator, stream

RELIABLE = LinksTable()


class Estimates(NamedTuple):
    """What the nodes say."""

    iterations: np.ndarray  # (S,) from 1
    values: np.ndarray  # (S, K) of lambda2 (PI1, PI2) or of mu2 (Wave); not finite where a node has none
    frequencies: np.ndarray | None  # (S, K) Wave: rad per iteration, what the values come from


def estimate(
    networks: np.ndarray,
    estimator: EstimatorTable,
    links: LinksTable = RELIABLE,
    *,
    seed: int = 0,
    iterations: int = 2001,
    every: int = 1,
    stay: int | None = None,
) -> Estimates:
    """Run an estimator.

    Args:
        networks: (K, K) adjacency matrix, or (M, K, K) for a graph that changes; the last one stays.
        estimator: which, and how.
        links: how packets are lost.
        seed: decides what is random: starts that are, and losses.
        iterations: to run.
        every: iterations between two that are noted, from the first.
        stay: iterations for which each of M networks lasts.
    """
    found = np.ascontiguousarray(networks if np.ndim(networks) == 3 else np.asarray(networks)[None], bool)
    history, start = _run(found, estimator, links, seed, iterations, stay or iterations)
    noted = np.arange(0, iterations, every)
    if estimator.method != "Wave":
        return Estimates(noted + 1, history[noted], None)
    signal = np.concatenate([start, start, history])  # s(-1) = s(0)
    omega = read_out(signal, noted + 3, estimator.window, estimator.readout == "interpolated")
    return Estimates(noted + 1, eigenvalue(omega, estimator.wave_speed), omega)


def eigenvalue(omega: np.ndarray, wave_speed: float) -> np.ndarray:
    """Return mu = 2 (1 - cos omega) / c^2 (ST-10)."""
    return 2.0 * (1.0 - np.cos(omega)) / wave_speed**2


def _run(
    networks: np.ndarray, estimator: EstimatorTable, links: LinksTable, seed: int, iterations: int, stay: int
) -> tuple[np.ndarray, np.ndarray]:
    size = networks.shape[1]
    nodes = begin(size, estimator, seed)
    start = nodes["value"].copy()[None]
    history = np.empty((iterations, size))
    iterate(
        networks, stay, nodes.view(np.recarray), np.zeros(size, MESSAGE).view(np.recarray),
        np.zeros((size, size), MESSAGE).view(np.recarray), np.zeros((size, size), bool), np.zeros((size, size), bool),
        estimator.record(size), links.drop, int(links.number), stream(seed, "packets"), history,
    )  # fmt: skip
    return history, start


def begin(size: int, estimator: EstimatorTable, seed: int) -> np.ndarray:
    """Return NODE of every node before the first iteration."""
    nodes = np.zeros(size, NODE)
    if estimator.method == "Wave":
        nodes["value"] = generator(seed, "signal").uniform(0.0, 1.0, size)
    elif estimator.start == "random":
        nodes["value"] = generator(seed, "start").uniform(-1.0, 1.0, size)
    else:
        index = np.arange(size) / size
        nodes["value"] = index / np.sqrt((index * index).sum()) if size > 1 else 0.0
    nodes["previous"] = nodes["average"] = nodes["value"]
    return nodes

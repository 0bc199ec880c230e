"""Connectivity of graphs and positions from Python: exact, and as the nodes themselves can find out."""

from typing import Literal, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from formicarium.commands.errors import UserError
from formicarium.connectivity.estimate import Estimates, estimate
from formicarium.connectivity.exact import (
    algebraic_connectivity,
    check_adjacency,
    components,
    diameter,
    is_connected,
    random_walk_connectivity,
    vertex_connectivity,
)
from formicarium.connectivity.graphs import unit_disc
from formicarium.connectivity.parameters import METHODS, LinksTable, estimator

MOST_NODES = 600  # whose vertex connectivity is worth the wait


class Connectivity(NamedTuple):
    """How connected a graph of K nodes is."""

    adjacency: np.ndarray  # (K, K) bool
    lambda2: float  # second eigenvalue of the Laplacian D - A; 0 in parts, K if complete, infinite for one node
    mu2: float  # the same of D^-1 (D - A), which waves have; 0 to 2
    parts: np.ndarray  # (K,) number of the component of each node, from 0
    diameter: int  # most hops between two nodes, -1 if in parts
    vertex_connectivity: int | None  # nodes that must fail before the others are parted; None above 600 nodes
    estimates: Estimates | None  # .iterations (S,), .values (S, K): what each node says; None without a method


def connectivity_of(
    graph: ArrayLike,
    *,
    reach: float | None = None,
    method: Literal["PI1", "PI2", "Wave"] | None = None,
    iterations: int = 2001,
    drop: float = 0.0,
    seed: int = 0,
) -> Connectivity:
    """Tell how connected a graph is, exactly, and if a method is given, what its nodes can find out of that.

    Args:
        graph: (K, K) adjacency matrix, 0 or 1, symmetric; with ``reach`` positions, (K, 2) or (K, 3), metres.
        reach: metres; nodes not farther apart than this are linked.
        method: a distributed estimator of lambda2 (PI1, PI2) or of mu2 (Wave), each node with its own memory and its
            neighbours' messages alone, one message an iteration.
        iterations: that the estimator runs.
        drop: probability that a message is lost, 0 to 1, each way by itself.
        seed: decides the estimator's starts and losses.

    Raises:
        UserError: if an argument is not allowed, or there is nothing to estimate: one node, or a graph in parts.
        ValueError: if the graph is no undirected, unweighted graph; names the first wrong entry.
    """
    matrix = check_adjacency(np.asarray(graph)) if reach is None else unit_disc(_positions(graph), _length(reach))
    said = None if method is None else _estimates(matrix, method, iterations, drop, seed)
    return Connectivity(
        matrix,
        algebraic_connectivity(matrix),
        random_walk_connectivity(matrix),
        components(matrix),
        diameter(matrix),
        vertex_connectivity(matrix) if len(matrix) <= MOST_NODES else None,
        said,
    )


def _positions(graph: ArrayLike) -> np.ndarray:
    places = np.asarray(graph, float)
    if places.ndim != 2 or places.shape[1] not in (2, 3) or not len(places):
        raise UserError(
            f"positions of shape {places.shape}: must be (K, 2) or (K, 3), metres; leave reach for a matrix"
        )
    if not np.isfinite(places).all():
        node = int(np.argwhere(~np.isfinite(places))[0][0])
        raise UserError(f"position {node} is {places[node].tolist()}: must be finite, metres")
    return places


def _length(reach: float) -> float:
    if not (np.isfinite(reach) and reach > 0):
        raise UserError(f"reach = {reach!r}: must be a distance in metres above 0")
    return float(reach)


def _estimates(matrix: np.ndarray, method: str, iterations: int, drop: float, seed: int) -> Estimates:
    if method not in METHODS:
        raise UserError(f"method = {method!r}: must be one of {', '.join(METHODS)}")
    if iterations < 1:
        raise UserError(f"iterations = {iterations}: must be at least 1")
    if not 0.0 <= drop <= 1.0:
        raise UserError(f"drop = {drop!r}: must be a probability, 0 to 1")
    if len(matrix) == 1 or not is_connected(matrix):
        why = "has one node" if len(matrix) == 1 else "is in parts"
        raise UserError(f"the graph {why}, so there is nothing for an estimator to converge to: leave method away")
    return estimate(matrix, estimator(method), LinksTable(drop=drop), seed=seed, iterations=iterations)

"""Graphs of one's own: robots placed at random, linked within a range (unit-disc graphs); graph6 as text."""

import numpy as np

from formicarium.connectivity.exact import is_connected
from formicarium.streams import generator

MOST_ATTEMPTS = 10_000


def unit_disc(positions: np.ndarray, reach: float) -> np.ndarray:
    """Return the adjacency matrix of (K, D) positions, metres: linked if not farther apart than ``reach``, metres."""
    apart = positions[:, None, :] - positions[None, :, :]
    matrix = (apart * apart).sum(axis=-1) <= reach * reach
    np.fill_diagonal(matrix, False)
    return matrix


def random_unit_disc(nodes: int, reach: float, seed: int) -> np.ndarray:
    """Return a connected unit-disc graph of nodes placed uniformly in a square of side 1.

    Placements that are not connected are drawn again, so this is the uniform placement given that it is connected.

    Raises:
        ValueError: if none was in 10,000 attempts.
    """
    draws = generator(seed, "unit-disc graph")
    for _ in range(MOST_ATTEMPTS):
        matrix = unit_disc(draws.uniform(0.0, 1.0, (nodes, 2)), reach)
        if (nodes == 1 or matrix.any(axis=1).all()) and is_connected(matrix):  # the first is quick
            return matrix
    raise ValueError(f"{nodes} nodes with reach {reach:g} in a square of side 1 are practically never connected")


def to_graph6(adjacency: np.ndarray) -> str:
    """Write a graph in the graph6 format (B. D. McKay), one line of printable characters.

    Raises:
        ValueError: with more than 258,047 nodes.
    """
    matrix = np.asarray(adjacency, bool)
    size = len(matrix)
    if size > 258_047:
        raise ValueError(f"{size} nodes are too many for graph6")
    head = [size] if size < 63 else [63, size >> 12, (size >> 6) & 63, size & 63]
    bits = matrix.T[np.tril_indices(size, -1)]
    bits = np.concatenate([bits, np.zeros(-len(bits) % 6, bool)]).reshape(-1, 6)
    return "".join(chr(63 + int(value)) for value in [*head, *(bits @ (32, 16, 8, 4, 2, 1))])


def from_graph6(text: str) -> np.ndarray:
    """Read a graph in the graph6 format.

    Raises:
        ValueError: if the text is none.
    """
    values = np.array([ord(character) - 63 for character in text.strip().removeprefix(">>graph6<<")])
    if not len(values) or values.min() < 0 or values.max() > 63:
        raise ValueError(f"{text[:40]!r} is no graph in graph6: only the characters from ? to ~ may occur")
    large = values[0] == 63
    size = int(values[1:4] @ (4096, 64, 1)) if large and len(values) > 3 else int(values[0])
    bits = np.unpackbits(values[4 if large else 1 :].astype(np.uint8)[:, None], axis=1)[:, 2:].ravel()
    wanted = size * (size - 1) // 2
    if not wanted <= len(bits) < wanted + 6:
        raise ValueError(f"{text[:40]!r} is no graph in graph6: {size} nodes need {wanted} bits, here are {len(bits)}")
    matrix = np.zeros((size, size), bool)
    matrix[np.tril_indices(size, -1)] = bits[:wanted]
    return matrix | matrix.T

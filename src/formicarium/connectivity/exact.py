"""Exact connectivity of small undirected graphs, for whoever sees the whole graph: observers, evaluators, tests.

A graph is its adjacency matrix: (K, K), symmetric, 0 or 1 (or bool), zero diagonal. No robot can compute these values
from what it hears; the estimators beside this file may not import it.
"""

import numpy as np
from scipy.sparse import csr_array
from scipy.sparse.csgraph import connected_components, maximum_flow, shortest_path

UNREACHED = -1  # hops to a node of another component


def check_adjacency(adjacency: np.ndarray) -> np.ndarray:
    """Return the matrix as bool (K, K).

    Raises:
        ValueError: if it is no adjacency matrix of an undirected, unweighted graph; names the first wrong entry.
    """
    matrix = np.asarray(adjacency)
    if matrix.ndim != 2 or matrix.shape[0] != matrix.shape[1] or not len(matrix):
        raise ValueError(
            f"an adjacency matrix is square and not empty, this one is {' x '.join(map(str, matrix.shape))}"
        )
    rules = (
        ((matrix != 0) & (matrix != 1), "must be 0 or 1: graphs are unweighted"),
        (np.diag(np.diag(matrix) != 0), "must be 0: no node is its own neighbour"),
        (matrix != matrix.T, "differs from its mirror image: links have two directions"),
    )
    for wrong, reason in rules:
        if wrong.any():
            row, column = map(int, np.argwhere(wrong)[0])
            raise ValueError(f"entry ({row}, {column}) = {matrix[row, column]}: {reason}")
    return matrix.astype(bool)


def laplacian(adjacency: np.ndarray) -> np.ndarray:
    """Return L = D - A (ST-1)."""
    matrix = np.asarray(adjacency, float)
    return np.diag(matrix.sum(axis=1)) - matrix


def laplacian_spectrum(adjacency: np.ndarray) -> np.ndarray:
    """Return the K eigenvalues of L, ascending."""
    return np.linalg.eigvalsh(laplacian(adjacency))


def algebraic_connectivity(adjacency: np.ndarray) -> float:
    """Return lambda2, the second smallest eigenvalue of L: 0 if the graph has parts, K if it is complete.

    A single node has no second eigenvalue and counts as connected: infinity.
    """
    if len(adjacency) == 1:
        return float("inf")
    if not is_connected(adjacency):
        return 0.0  # not 1e-17
    return float(laplacian_spectrum(adjacency)[1])


def random_walk_connectivity(adjacency: np.ndarray) -> float:
    """Return mu2, the second smallest eigenvalue of D^-1 L, which waves have (ST-10); in [0, 2].

    Nodes without neighbours make it 0. A single node: infinity.
    """
    if len(adjacency) == 1:
        return float("inf")
    if not is_connected(adjacency):
        return 0.0
    root = 1.0 / np.sqrt(np.asarray(adjacency, float).sum(axis=1))
    return float(np.linalg.eigvalsh(root[:, None] * laplacian(adjacency) * root)[1])


def components(adjacency: np.ndarray) -> np.ndarray:
    """Return the part that each node is in: (K,) numbers from 0, in the order of their first nodes."""
    return connected_components(csr_array(np.asarray(adjacency, bool)), directed=False)[1].astype(int)


def is_connected(adjacency: np.ndarray) -> bool:
    """Return whether every node reaches every other."""
    return int(components(adjacency).max()) == 0


def reachable(adjacency: np.ndarray, node: int) -> np.ndarray:
    """Return which nodes ``node`` reaches, itself included: (K,) bool."""
    parts = components(adjacency)
    return parts == parts[node]


def hop_distances(adjacency: np.ndarray, node: int | None = None) -> np.ndarray:
    """Return the least number of links between nodes, UNREACHED if there is no path.

    Returns (K, K) int, or (K,) from one node if it is given.
    """
    matrix = csr_array(np.asarray(adjacency, float))
    hops = shortest_path(matrix, directed=False, unweighted=True, indices=node)
    return np.where(np.isinf(hops), UNREACHED, hops).astype(int)


def diameter(adjacency: np.ndarray) -> int:
    """Return the greatest number of hops between two nodes, UNREACHED if the graph has parts."""
    hops = hop_distances(adjacency)
    return UNREACHED if (hops == UNREACHED).any() else int(hops.max())


def articulation_nodes(adjacency: np.ndarray) -> np.ndarray:
    """Return which nodes part their component when they fail: (K,) bool."""
    matrix = np.asarray(adjacency, bool)
    parts, cut = components(matrix), np.zeros(len(matrix), bool)
    for node in range(len(matrix)):
        rest = parts == parts[node]
        rest[node] = False
        cut[node] = rest.any() and not is_connected(matrix[np.ix_(rest, rest)])
    return cut


def vertex_connectivity(adjacency: np.ndarray) -> int:
    """Return how many nodes must fail before the others are parted; K - 1 for a complete graph, 0 for one in parts.

    Menger's theorem, by maximum flows between few pairs (Esfahanian and Hakimi, Networks 14, 1984): from a node of
    least degree to all that are no neighbours of it, and between its neighbours.
    """
    matrix = np.asarray(adjacency, bool)
    if len(matrix) == 1 or not is_connected(matrix):
        return 0
    degree = matrix.sum(axis=1)
    start = int(degree.argmin())
    least = int(degree[start])
    around = np.flatnonzero(matrix[start])
    pairs = [(start, int(node)) for node in np.flatnonzero(~matrix[start]) if node != start]
    pairs += [(int(a), int(b)) for k, a in enumerate(around) for b in around[k + 1 :] if not matrix[a, b]]
    network = _split(matrix)
    for a, b in pairs:
        if least <= 1:
            break
        least = min(least, int(maximum_flow(network, a + len(matrix), b).flow_value))
    return least


def _split(matrix: np.ndarray) -> csr_array:
    """Return the flow network in which node k is an entrance k and an exit K + k with room for one between them."""
    size = len(matrix)
    capacity = np.zeros((2 * size, 2 * size), np.int32)
    capacity[np.arange(size), size + np.arange(size)] = 1
    capacity[size:, :size] = matrix
    return csr_array(capacity)

"""Exact values against closed formulas (Fiedler 1973) and slow definitions."""

from itertools import combinations

import numpy as np
import pytest

from formicarium.connectivity.exact import (
    UNREACHED,
    algebraic_connectivity,
    articulation_nodes,
    check_adjacency,
    components,
    diameter,
    hop_distances,
    is_connected,
    random_walk_connectivity,
    reachable,
    vertex_connectivity,
)


def path(size):
    return np.eye(size, k=1, dtype=int) + np.eye(size, k=-1, dtype=int)


def ring(size):
    matrix = path(size)
    matrix[0, -1] = matrix[-1, 0] = 1
    return matrix


def complete(size):
    return 1 - np.eye(size, dtype=int)


def star(size):
    matrix = np.zeros((size, size), int)
    matrix[0, 1:] = matrix[1:, 0] = 1
    return matrix


def some_graph(seed, size=8, share=0.35):
    draws = np.triu(np.random.default_rng(seed).uniform(size=(size, size)) < share, 1)
    return (draws | draws.T).astype(int)


@pytest.mark.parametrize("size", [3, 7, 10])
def test_lambda2_of_graphs_that_have_formulas(size):
    assert algebraic_connectivity(path(size)) == pytest.approx(2 - 2 * np.cos(np.pi / size))
    assert algebraic_connectivity(ring(size)) == pytest.approx(2 - 2 * np.cos(2 * np.pi / size))
    assert algebraic_connectivity(complete(size)) == pytest.approx(size)
    assert algebraic_connectivity(star(size)) == pytest.approx(1)


@pytest.mark.parametrize("size", [4, 9])
def test_mu2_of_graphs_that_have_formulas(size):
    assert random_walk_connectivity(ring(size)) == pytest.approx(1 - np.cos(2 * np.pi / size))
    assert random_walk_connectivity(complete(size)) == pytest.approx(size / (size - 1))
    assert random_walk_connectivity(star(size)) == pytest.approx(1)


def test_a_graph_in_parts_has_none():
    parted = np.zeros((5, 5), int)
    parted[:3, :3] = complete(3)
    parted[3:, 3:] = complete(2)
    assert algebraic_connectivity(parted) == random_walk_connectivity(parted) == 0.0
    assert vertex_connectivity(parted) == 0
    assert diameter(parted) == UNREACHED
    assert list(components(parted)) == [0, 0, 0, 1, 1]
    assert list(reachable(parted, 4)) == [False] * 3 + [True] * 2
    assert hop_distances(parted)[0, 3] == UNREACHED
    assert algebraic_connectivity(np.zeros((1, 1))) == np.inf


def test_hops_along_a_path():
    assert list(hop_distances(path(6), 2)) == [2, 1, 0, 1, 2, 3]
    assert diameter(path(6)) == 5
    assert (hop_distances(ring(6)) == hop_distances(ring(6)).T).all()


@pytest.mark.parametrize("seed", range(25))
def test_vertex_connectivity_is_the_smallest_set_whose_failure_parts_the_rest(seed):
    graph = some_graph(seed, share=0.3 + 0.02 * seed)
    size = len(graph)

    def parts(failed):
        rest = [k for k in range(size) if k not in failed]
        return not is_connected(graph[np.ix_(rest, rest)])

    slow = next((n for n in range(size - 1) if any(map(parts, combinations(range(size), n)))), size - 1)
    assert vertex_connectivity(graph) == slow
    if is_connected(graph):
        assert list(articulation_nodes(graph)) == [parts({k}) for k in range(size)]
        assert (algebraic_connectivity(graph) <= slow + 1e-9) or (graph == complete(size)).all()  # Fiedler's bound


def test_the_path_the_ring_and_the_complete_graph():
    assert [vertex_connectivity(g) for g in (path(5), ring(5), complete(5))] == [1, 2, 4]
    assert articulation_nodes(star(4)).tolist() == [True, False, False, False]


@pytest.mark.parametrize(
    ("entry", "reason"), [((1, 1, 1), "own neighbour"), ((0, 1, 2), "unweighted"), ((0, 2, 1), "two directions")]
)
def test_what_is_no_adjacency_matrix_is_refused_with_its_entry(entry, reason):
    row, column, value = entry
    matrix = path(4)
    matrix[row, column] = value
    with pytest.raises(ValueError, match=rf"entry \({row}, {column}\) = {value}: .*{reason}"):
        check_adjacency(matrix)
    with pytest.raises(ValueError, match="square"):
        check_adjacency(path(4)[:3])

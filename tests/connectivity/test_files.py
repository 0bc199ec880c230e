"""Every kind of file gives the same graph; what is wrong is named with file, line and value."""

import re

import numpy as np
import pytest

from formicarium.connectivity.files import GraphError, read_graphs
from formicarium.connectivity.graphs import from_graph6, random_unit_disc, to_graph6, unit_disc

MATRIX = np.array([[0, 1, 0], [1, 0, 1], [0, 1, 0]])
TEXTS = {
    "matrix.txt": "0 1 0\n1 0 1\n0 1 0\n",
    "matrix.csv": "0,1,0\r\n1,0,1\r\n0,1,0\r\n",
    "octave.mat": "# Created by Octave 3.8.2\n# type: matrix\n# rows: 3\n# columns: 3\n 0 1 0\n 1 0 1\n 0 1 0\n\n\n",
    "edges.txt": "# two links\n0 1\n1 2\n",
    "names.csv": "anna;bert\nbert;cleo\n",
    "graph.g6": "Bg\n",
}


@pytest.mark.parametrize("name", TEXTS)
def test_a_path_of_three_nodes_from_every_kind_of_file(tmp_path, name):
    (tmp_path / name).write_bytes(TEXTS[name].encode())
    (graph,) = read_graphs(tmp_path / name)
    assert (graph.adjacency == MATRIX).all()


def test_arrays_positions_and_several_graphs(tmp_path):
    np.save(tmp_path / "many.npy", np.array([MATRIX, 1 - np.eye(3)]))
    assert [graph.adjacency.sum() for graph in read_graphs(tmp_path / "many.npy")] == [4, 6]
    (tmp_path / "places.csv").write_text("x,y\n0,0\n1,0\n2,0\n")
    (graph,) = read_graphs(tmp_path / "places.csv", reach=1.0)  # at the edge of the range: linked
    assert (graph.adjacency == MATRIX).all()
    (tmp_path / "two.txt").write_text(TEXTS["matrix.txt"] + "\n" + TEXTS["matrix.txt"])
    assert len(read_graphs(tmp_path / "two.txt")) == 2
    (tmp_path / "lone.txt").write_text("1 2\n7\n")
    (graph,) = read_graphs(tmp_path / "lone.txt")
    assert graph.labels == ("1", "2", "7")
    assert graph.adjacency.sum() == 2


@pytest.mark.parametrize(
    ("text", "reach", "told"),
    [
        ("0 1 0\n1 0 x\n0 1 0\n", None, "line 2: 'x' is no number"),
        ("0 1 0\n1 0 1\n0 0 0\n", None, "line 2, value 3: 1, but line 3 says 0"),
        ("0 1 0\n1 0 2\n0 2 0\n", None, "line 2, value 3: 2 must be 0 or 1"),
        ("1 1 0\n1 0 0\n0 0 0\n", None, "line 1, value 1: 1, but a node is not its own neighbour"),
        ("0 1 0\n1 0\n0 1 0\n", None, "line 2: 2 values, the other rows of this matrix have 3"),
        ("0 1 0 1\n1 0 1 0\n", None, "line 1: 2 rows of 4 values are no square matrix"),
        ("0 1\n2 2\n3 1\n", None, "line 2: 2 is linked to itself"),
        ("0 0\n1 east\n", 1.0, "line 2: 'east' is no number"),
        ("0 0\n1 nan\n", 1.0, "line 2: nan is not finite"),
        ("0 0\n1\n", 1.0, "line 2: 1 values; a position is x y"),
        ("\n\n", None, "is empty"),
    ],
)
def test_what_is_wrong_is_named(tmp_path, text, reach, told):
    path = tmp_path / "graph.txt"
    path.write_text(text)
    with pytest.raises(GraphError, match=re.escape(told)) as trouble:
        read_graphs(path, reach)
    assert str(path) in str(trouble.value)


def test_files_that_are_no_graphs(tmp_path):
    (tmp_path / "picture.png").write_bytes(b"\x89PNG\xff\xfe")
    np.save(tmp_path / "line.npy", np.zeros(4))
    (tmp_path / "cut.npy").write_bytes((tmp_path / "line.npy").read_bytes()[:-9])
    (tmp_path / "bad.g6").write_text("Bgg\n")
    for name in ("picture.png", "line.npy", "cut.npy", "bad.g6", "nowhere.txt"):
        with pytest.raises(GraphError, match=name):
            read_graphs(tmp_path / name)


@pytest.mark.parametrize("nodes", [1, 2, 9, 62, 63, 100])
def test_graph6_reads_what_it_wrote(nodes):
    draws = np.triu(np.random.default_rng(nodes).uniform(size=(nodes, nodes)) < 0.4, 1)
    assert (from_graph6(to_graph6(draws | draws.T)) == (draws | draws.T)).all()


def test_graph6_is_the_published_format():
    """The example of the format's description: 5 nodes, links 0-2, 0-4, 1-3, 3-4."""
    matrix = np.zeros((5, 5), bool)
    for a, b in ((0, 2), (0, 4), (1, 3), (3, 4)):
        matrix[a, b] = matrix[b, a] = True
    assert to_graph6(matrix) == "DQc"


def test_nodes_at_the_edge_of_the_range_are_linked():
    assert unit_disc(np.array([[0.0, 0.0], [3.0, 0.0], [6.001, 0.0]]), 3.0).sum() == 2


def test_own_graphs_resemble_the_published_ones():
    """ST-2: mean degree 2.6 to 6.4 at ten nodes; repeatable."""
    graphs = [random_unit_disc(10, 0.5, seed) for seed in range(20)]
    assert 3.5 < np.mean([graph.sum() / 10 for graph in graphs]) < 5.5
    assert (random_unit_disc(10, 0.5, 3) == graphs[3]).all()
    assert len({to_graph6(graph) for graph in graphs}) == 20
    with pytest.raises(ValueError, match="practically never"):
        random_unit_disc(40, 0.01, 1)

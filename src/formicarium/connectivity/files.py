"""Reading graphs: matrices (text, CSV, Octave text, .npy), edge lists, positions with a range, graph6."""

import io
import math
import re
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

import numpy as np

from formicarium.connectivity.exact import check_adjacency
from formicarium.connectivity.graphs import from_graph6, unit_disc

KINDS = ("matrix", "edges", "positions", "graph6")


class Graph(NamedTuple):
    """A graph of a file."""

    adjacency: np.ndarray  # (K, K) bool
    labels: tuple[str, ...]  # of the nodes


class GraphError(ValueError):
    """A file holds no graph: the message names file, line and value, and the way out."""


class Row(NamedTuple):
    """A line of numbers or names."""

    line: int  # from 1
    words: list[str]


def read_graphs(path: Path, reach: float | None = None, kind: str | None = None) -> list[Graph]:
    """Return all graphs of a file.

    Args:
        path: of the file.
        reach: metres; given, the file holds positions, and nodes within this range are linked.
        kind: one of KINDS; told from the content if not given.

    Raises:
        GraphError: if it cannot be read or is no graph.
    """
    try:
        content = path.read_bytes()
    except OSError as error:
        raise GraphError(f"cannot read {path}: {error.strerror or error}") from error
    if content[:6] == b"\x93NUMPY":
        return _from_arrays(path, content, reach)
    try:
        text = content.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise GraphError(f"{path}: byte {error.start} is no text, and the file is no .npy array") from error
    if kind == "graph6" or (kind is None and (path.suffix == ".g6" or text.startswith(">>graph6<<"))):
        return [_from_line(path, k, line) for k, line in enumerate(text.splitlines(), 1) if line.strip()]
    if reach is not None and kind is None:
        kind = "positions"
    blocks = list(_blocks(text))
    if not blocks:
        raise GraphError(f"{path} is empty: a matrix, an edge list or positions are needed")
    if kind is None:
        kind = "matrix" if all(_is_square(block) for block in blocks) else _guessed(path, blocks)
    if kind == "matrix":
        return [_graph(_matrix(path, block), f"{path}, line {block[0].line}") for block in blocks]
    rows = [row for block in blocks for row in block]
    return [_from_edges(path, rows) if kind == "edges" else _from_positions(path, rows, reach)]


def _blocks(text: str) -> Iterator[list[Row]]:
    """Yield runs of lines; blank lines and comments (Octave's headers among them) part them."""
    block: list[Row] = []
    for number, line in enumerate(text.splitlines(), 1):
        words = [word for word in re.split(r"[,;\s]+", line.split("#")[0].split("%")[0].strip()) if word]
        if words:
            block.append(Row(number, words))
        elif block:
            yield block
            block = []
    if block:
        yield block


def _is_square(block: list[Row]) -> bool:
    words = [row.words for row in block]
    if len(block) == 2:  # two links look like this too
        return words in ([["0", "1"], ["1", "0"]], [["0", "0"], ["0", "0"]])
    return all(len(row) == len(block) for row in words)


def _guessed(path: Path, blocks: list[list[Row]]) -> str:
    widths = {len(row.words) for block in blocks for row in block}
    if widths <= {1, 2}:
        return "edges"
    block = next(block for block in blocks if not _is_square(block))
    common = max({len(row.words) for row in block}, key=[len(row.words) for row in block].count)
    odd = next((row for row in block if len(row.words) != common), None)
    if odd is not None and common == len(block):
        raise GraphError(
            f"{path}, line {odd.line}: {len(odd.words)} values, the other rows of this matrix have {common}"
        )
    raise GraphError(
        f"{path}, line {block[0].line}: {len(block)} rows of {common} values are no square matrix, and an edge "
        "list has two names a line; positions need a range"
    )


def _number(path: Path, row: Row, word: str, what: str) -> float:
    try:
        value = float(word)
    except ValueError:
        raise GraphError(f"{path}, line {row.line}: {word!r} is no number; {what}") from None
    if not math.isfinite(value):
        raise GraphError(f"{path}, line {row.line}: {word} is not finite; {what}")
    return value


def _matrix(path: Path, block: list[Row]) -> np.ndarray:
    for row in block:
        if len(row.words) != len(block):
            raise GraphError(
                f"{path}, line {row.line}: {len(row.words)} values in a row of a matrix of {len(block)} rows"
            )
    values = np.array([[_number(path, row, word, "entries are 0 or 1") for word in row.words] for row in block])
    wrong = [(k, j) for k, j in np.argwhere((values != 0) & (values != 1))]
    if wrong:
        k, j = wrong[0]
        raise GraphError(
            f"{path}, line {block[k].line}, value {j + 1}: {block[k].words[j]} must be 0 or 1: graphs are unweighted"
        )
    for k, j in np.argwhere((values != values.T) | np.diag(np.diag(values) != 0)):
        reason = "a node is not its own neighbour" if k == j else f"line {block[j].line} says {block[j].words[k]}"
        raise GraphError(f"{path}, line {block[k].line}, value {j + 1}: {block[k].words[j]}, but {reason}")
    return values


def _graph(matrix: np.ndarray, place: str) -> Graph:
    try:
        found = check_adjacency(matrix)
    except ValueError as error:
        raise GraphError(f"{place}: {error}") from error
    return Graph(found, tuple(map(str, range(len(found)))))


def _from_arrays(path: Path, content: bytes, reach: float | None) -> list[Graph]:
    try:
        array = np.load(io.BytesIO(content), allow_pickle=False)
    except (ValueError, EOFError, OSError) as error:
        raise GraphError(f"{path} is no whole .npy array of numbers: {error}") from error
    if not (np.issubdtype(array.dtype, np.number) or array.dtype == bool):
        raise GraphError(f"{path} holds {array.dtype}, not numbers")
    if reach is not None:
        rows = [Row(k + 1, list(map(str, row))) for k, row in enumerate(np.atleast_2d(array).tolist())]
        return [_from_positions(path, rows, reach)]
    if array.ndim not in (2, 3):
        raise GraphError(f"{path} has shape {array.shape}: a matrix (K, K) or several (G, K, K) are needed")
    stack = array if array.ndim == 3 else array[None]
    return [_graph(matrix, f"{path}, graph {k}" if array.ndim == 3 else str(path)) for k, matrix in enumerate(stack)]


def _from_line(path: Path, number: int, line: str) -> Graph:
    try:
        return _graph(from_graph6(line), str(path))
    except ValueError as error:
        raise GraphError(f"{path}, line {number}: {error}") from error


def _from_edges(path: Path, rows: list[Row]) -> Graph:
    """Two names a line are a link, one name is a node that may have none."""
    for row in rows:
        if len(row.words) > 2:
            raise GraphError(f"{path}, line {row.line}: {len(row.words)} values; a link is two names, a lone node one")
        if len(row.words) == 2 and row.words[0] == row.words[1]:
            raise GraphError(f"{path}, line {row.line}: {row.words[0]} is linked to itself")
    names = {word for row in rows for word in row.words}
    whole = all(re.fullmatch(r"-?\d+", name) for name in names)
    labels = sorted(names, key=int) if whole else sorted(names)
    place = {name: k for k, name in enumerate(labels)}
    matrix = np.zeros((len(labels), len(labels)), bool)
    for row in rows:
        if len(row.words) == 2:
            a, b = place[row.words[0]], place[row.words[1]]
            matrix[a, b] = matrix[b, a] = True
    return Graph(matrix, tuple(labels))


def _from_positions(path: Path, rows: list[Row], reach: float | None) -> Graph:
    if reach is None:
        raise GraphError(f"{path} holds positions: a range is needed")
    if rows and not any(_is_number(word) for word in rows[0].words):
        rows = rows[1:]  # a line of titles
    if not rows:
        raise GraphError(f"{path} holds no positions")
    for row in rows:
        if len(row.words) not in (2, 3) or len(row.words) != len(rows[0].words):
            raise GraphError(
                f"{path}, line {row.line}: {len(row.words)} values; a position is x y, or x y z, in metres"
            )
    points = np.array([[_number(path, row, word, "metres") for word in row.words] for row in rows])
    return Graph(unit_disc(points, reach), tuple(map(str, range(len(points)))))


def _is_number(word: str) -> bool:
    try:
        float(word)
    except ValueError:
        return False
    return True

"""The algebraic connectivity of the range graph, exactly, while a trial runs."""

import math

from formicarium.compiled import compiled

HALVINGS = 60  # of the interval in which lambda_2 is


@compiled
def lambda_2(state, matrix, rows):
    """Return the second smallest eigenvalue of the Laplacian of the living robots' range graph; 0 for one robot.

    Householder's reduction to three diagonals, then bisection on Sturm's count of eigenvalues.

    Args:
        state: of the trial.
        matrix: (N, N) scratch.
        rows: (4, N) scratch.
    """
    count = fill_laplacian(state, matrix, rows[3])
    if count < 2:
        return 0.0
    tridiagonalise(matrix, count, rows[0], rows[1], rows[2])
    low = 0.0
    high = 2.0 * count
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        if eigenvalues_below(rows[0], rows[1], count, middle) >= 2:
            high = middle
        else:
            low = middle
    return low


@compiled
def fill_laplacian(state, matrix, number):
    """Write L = D - A of the living robots; return how many they are. ``number`` (N,) is scratch."""
    count = 0
    for place in range(len(state.robots)):
        i = state.world.lists[place].order
        number[i] = -1.0
        if state.robots[i].alive == 1:
            number[i] = count
            count += 1
    for i in range(len(state.robots)):
        if number[i] < 0.0:
            continue
        row = int(number[i])
        for column in range(count):
            matrix[row, column] = 0.0
        for n in range(state.world.neighbour_count[i]):
            near = state.world.neighbours[i, n]
            if number[near.index] >= 0.0 and near.distance <= state.footbot[0].radio_range:
                matrix[row, int(number[near.index])] = -1.0
                matrix[row, row] += 1.0
    return count


@compiled
def tridiagonalise(matrix, count, diagonal, beside, vector):
    """Reduce a symmetric matrix to its diagonal and the one beside it, by reflections; the matrix is used up."""
    for k in range(count - 2):
        square = 0.0
        for i in range(k + 1, count):
            square += matrix[i, k] * matrix[i, k]
        length = math.sqrt(square)
        if length > 0.0:
            first = matrix[k + 1, k]
            alpha = -length if first > 0.0 else length
            for i in range(k + 1, count):
                vector[i] = matrix[i, k]
            vector[k + 1] = first - alpha
            norm = 2.0 * (square - alpha * first)  # |v|^2
            if norm > 0.0:
                reflect(matrix, count, k + 1, vector, norm, beside)
            matrix[k + 1, k] = alpha
        diagonal[k] = matrix[k, k]
    for k in range(max(0, count - 2), count):
        diagonal[k] = matrix[k, k]
    for k in range(count - 1):
        beside[k] = matrix[k + 1, k]


@compiled
def reflect(matrix, count, start, vector, norm, scratch):
    """Replace the block from ``start`` on by H A H with H = 1 - 2 v v' / |v|^2: A - v w' - w v'."""
    middle = 0.0
    for i in range(start, count):
        total = 0.0
        for j in range(start, count):
            total += matrix[i, j] * vector[j]
        scratch[i] = 2.0 * total / norm
        middle += scratch[i] * vector[i]
    for i in range(start, count):
        scratch[i] -= middle / norm * vector[i]
    for i in range(start, count):
        for j in range(start, count):
            matrix[i, j] -= vector[i] * scratch[j] + scratch[i] * vector[j]


@compiled
def eigenvalues_below(diagonal, beside, count, bound):
    """Return how many eigenvalues of a tridiagonal matrix are less than ``bound`` (Sturm)."""
    below = 0
    value = 1.0
    for k in range(count):
        square = beside[k - 1] * beside[k - 1] if k > 0 else 0.0
        if value == 0.0:
            value = 1e-300
        value = diagonal[k] - bound - (square / value if k > 0 else 0.0)
        if value < 0.0:
            below += 1
    return below

"""The tree of permutations of the initial sequence, searched depth first (Figs 6, S15, S17; TS-116, TS-117).

Children are visited in alphabetical order, so the leaves are the permutations in lexicographic order and UPI, the
unique permutation identifier, is their number. A guardian knows its own label and UPI; from these two it works out
the place of its own task, and nothing about the others.
"""

from formicarium.compiled import compiled


@compiled
def permutations(tasks):
    """Return m!, the number of leaves of the tree."""
    product = 1
    for k in range(2, tasks + 1):
        product *= k
    return product


@compiled
def place_of(label, upi, tasks):
    """Return how many tasks come before the one labelled ``label`` (1 = a, 2 = b, ...) in permutation ``upi`` mod m!.

    Digit k of ``upi`` in the factorial number system tells which of the labels still left, in alphabetical order,
    comes at place k.
    """
    rest = upi % permutations(tasks)
    left = (1 << tasks) - 1  # bit k is set while label k + 1 has no place yet
    for k in range(tasks):
        leaves = permutations(tasks - 1 - k)
        skip = rest // leaves
        rest %= leaves
        for n in range(tasks):
            if left >> n & 1 == 0:
                continue
            if skip == 0:
                if n + 1 == label:
                    return k
                left &= ~(1 << n)
                break
            skip -= 1
    return tasks  # no such label

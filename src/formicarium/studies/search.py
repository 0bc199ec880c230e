"""The search of Mark II as its guardians do it: which order of the labels each UPI stands for (Figs 6, S15, S17)."""

from formicarium.systems.sequencing.permutations import permutations, place_of


def sequences(tasks: int) -> list[tuple[int, ...]]:
    """Return the order of the labels, 1 = a, 2 = b, ..., for every UPI from 0; put together from all guardians."""
    labels = range(1, tasks + 1)
    return [
        tuple(sorted(labels, key=lambda label: int(place_of(label, upi, tasks)))) for upi in range(permutations(tasks))
    ]


def letter(label: int) -> str:
    """Return a label as the paper writes it."""
    return chr(96 + label)

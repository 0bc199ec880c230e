"""The permutation tree against the paper's tables (A4, TS-116, TS-117; Fig. S15 for three tasks, Fig. S17 for four)."""

import itertools

import pytest

from formicarium.systems.sequencing.permutations import permutations, place_of

# Section 11: the orders in the sequence of their UPI, as printed.
THREE = ["abc", "acb", "bac", "bca", "cab", "cba"]
FOUR = [
    *("abcd", "abdc", "acbd", "acdb", "adbc", "adcb", "bacd", "badc", "bcad", "bcda", "bdac", "bdca"),
    *("cabd", "cadb", "cbad", "cbda", "cdab", "cdba", "dabc", "dacb", "dbac", "dbca", "dcab", "dcba"),
]


def order(upi: int, tasks: int) -> str:
    """Return the order that guardians who know only their own label direct runners through."""
    places = {place_of(label, upi, tasks): "abcd"[label - 1] for label in range(1, tasks + 1)}
    return "".join(places[k] for k in range(tasks))


@pytest.mark.parametrize("printed", [THREE, FOUR])
def test_the_orders_are_the_printed_ones(printed):
    tasks = len(printed[0])
    assert [order(upi, tasks) for upi in range(len(printed))] == printed


def test_the_guardian_of_the_second_task_goes_through_the_states_of_figure_6():
    """TS-118: it directs runners that have done 1, 2, 0, 0, 2, 1 tasks."""
    assert [place_of(2, upi, 3) for upi in range(6)] == [1, 2, 0, 0, 2, 1]


@pytest.mark.parametrize("tasks", [2, 3, 4, 5])
def test_the_order_is_lexicographic_and_begins_again_after_the_last(tasks):
    """TS-129."""
    leaves = ["".join(p) for p in itertools.permutations("abcde"[:tasks])]
    assert permutations(tasks) == len(leaves)
    for upi in range(2 * len(leaves)):
        for label in range(1, tasks + 1):
            assert place_of(label, upi, tasks) == leaves[upi % len(leaves)].index("abcde"[label - 1])


def test_a_label_that_does_not_exist_has_no_place():
    assert place_of(0, 0, 3) == 3 and place_of(4, 0, 3) == 3

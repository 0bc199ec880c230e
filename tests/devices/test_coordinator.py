"""The coordinator judges by its own record, not by what it is told (TS-26, TS-27, TS-30)."""

import itertools

import numpy as np
import pytest

from formicarium.devices.coordinator import COORDINATOR, judge
from formicarium.physics.records import records
from formicarium.robots.infrared import FAILURE, NOTED, SUCCESS

A, B, C = 3, 1, 2  # the correct order: blue, red, green
ROBOT = 17


def coordinator(always_negative=0):
    record = records(COORDINATOR, 1)[0]
    record.tasks = 3
    record.order[:3] = (A, B, C)
    record.always_negative = always_negative
    return record


# name: [(claim, task, right?, faults so far)], what a robot does in a row
STORIES = {
    "the sequence": [(1, A, True, 0), (2, B, True, 0), (3, C, True, 0)],
    "the sequence, twice": [(1, A, True, 0), (2, B, True, 0), (3, C, True, 0)] * 2,
    "a wrong first task": [(1, B, False, 0), (1, C, False, 0), (1, A, True, 0)],
    "a failure sends back to the start": [(1, A, True, 0), (2, C, False, 0), (1, A, True, 0), (2, B, True, 0)],
    "the same task again": [(1, A, True, 0), (2, A, False, 0)],
    "claim 1 starts afresh": [(1, A, True, 0), (2, B, True, 0), (1, A, True, 0), (2, B, True, 0), (3, C, True, 0)],
    "claim 1 with a later task": [(1, A, True, 0), (1, B, False, 0)],
    "a claim ahead of the record": [(2, B, False, 1), (3, C, False, 2)],
    "a claim behind the record": [(1, A, True, 0), (2, B, True, 0), (2, C, False, 1)],
    "a wrong claim with the right task": [(1, A, True, 0), (3, B, False, 1), (2, B, False, 2), (1, A, True, 2)],
    "a claim after a failure": [(1, A, True, 0), (2, C, False, 0), (2, B, False, 1)],
    "a fourth task": [(1, A, True, 0), (2, B, True, 0), (3, C, True, 0), (4, A, False, 1)],
}


@pytest.mark.parametrize("story", STORIES.values(), ids=STORIES.keys())
def test_the_truth_table(story):
    record = coordinator()
    for claim, task, right, faults in story:
        assert judge(record, ROBOT, claim, task) == (SUCCESS if right else FAILURE)
        assert record.faults == faults


def test_robots_have_records_of_their_own():
    record = coordinator()
    assert judge(record, 1, 1, A) == SUCCESS
    assert judge(record, 255, 1, A) == SUCCESS
    assert judge(record, 1, 2, B) == SUCCESS
    assert judge(record, 255, 2, C) == FAILURE
    assert judge(record, 1, 3, C) == SUCCESS
    assert judge(record, 2, 2, B) == FAILURE and record.faults == 1


@pytest.mark.parametrize("task, expected", [(A, FAILURE), (B, SUCCESS)])
def test_a_booth_that_always_says_no(task, expected):
    record = coordinator(always_negative=A)
    record.order[:3] = (A, B, C) if task == A else (B, A, C)
    assert judge(record, ROBOT, 1, task) == expected
    assert record.faults == 0


@pytest.mark.parametrize("order", list(itertools.permutations((1, 2, 3))))
def test_only_the_correct_order_succeeds(order):
    record = coordinator()
    answers = []
    for number, task in enumerate(order):
        answers.append(judge(record, ROBOT, number + 1, task) == SUCCESS)
    expected = [order[: k + 1] == (A, B, C)[: k + 1] for k in range(3)]
    assert answers == expected


def test_any_story_is_judged_as_a_slow_clerk_would():
    draws = np.random.default_rng(1)
    record, book, faults = coordinator(), {}, 0
    for _ in range(4000):
        robot, claim, task = (int(draws.integers(*bounds)) for bounds in ((1, 4), (1, 5), (1, 4)))
        done = [] if claim == 1 else book.get(robot, [])
        faults += claim != len(done) + 1
        right = claim == len(done) + 1 and [*done, task] == [A, B, C][: len(done) + 1]
        book[robot] = [*done, task] if right and len(done) < 2 else []
        assert judge(record, robot, claim, task) == (SUCCESS if right else FAILURE)
        assert record.faults == faults


# Delayed feedback: name: [(claim, task, byte, faults so far)]
LATE = {
    "the sequence, twice": [(1, A, NOTED, 0), (2, B, NOTED, 0), (3, C, SUCCESS, 0)] * 2,
    "a wrong first task": [(1, B, NOTED, 0), (2, A, NOTED, 0), (3, C, FAILURE, 0), (1, A, NOTED, 0)],
    "a wrong last task": [(1, A, NOTED, 0), (2, B, NOTED, 0), (3, B, FAILURE, 0)],
    "a right one after a wrong one": [(1, B, NOTED, 0), (2, C, NOTED, 0), (3, A, FAILURE, 0)]
    + [(1, A, NOTED, 0), (2, B, NOTED, 0), (3, C, SUCCESS, 0)],
    "a new start on the way": [(1, B, NOTED, 0), (1, A, NOTED, 0), (2, B, NOTED, 0), (3, C, SUCCESS, 0)],
    "a claim that is not the record's": [(1, A, NOTED, 0), (3, C, FAILURE, 1), (2, B, FAILURE, 2), (1, A, NOTED, 2)],
}


@pytest.mark.parametrize("story", LATE)
def test_delayed_feedback_is_a_verdict_on_the_whole_sequence(story):
    """TS-28, TS-30."""
    record = coordinator()
    record.delayed = 1
    for claim, task, byte, faults in LATE[story]:
        assert judge(record, ROBOT, claim, task) == byte
        assert record.faults == faults


@pytest.mark.parametrize("order", list(itertools.product((A, B, C), repeat=3)))
def test_delayed_feedback_does_not_tell_where_a_sequence_went_wrong(order):
    record = coordinator()
    record.delayed = 1
    bytes_heard = [judge(record, ROBOT, claim, task) for claim, task in enumerate(order, 1)]
    assert bytes_heard == [NOTED, NOTED, SUCCESS if order == (A, B, C) else FAILURE]


def test_a_booth_that_is_always_negative_is_so_at_the_end_of_the_sequence():
    record = coordinator(always_negative=B)
    record.delayed = 1
    assert [judge(record, ROBOT, n, task) for n, task in enumerate((A, B, C), 1)] == [NOTED, NOTED, FAILURE]

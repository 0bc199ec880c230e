"""Run-time distributions against counting and against a published example."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from formicarium.statistics.runtimes import in_words, run_times

CAP = 100.0
TIMES = st.lists(st.floats(0.1, CAP) | st.none(), min_size=1, max_size=30)

# Freireich et al. 1963, weeks of remission under 6-MP; the textbook example of Kaplan and Meier's estimate.
FREIREICH = [
    *((6, True), (6, True), (6, True), (6, False), (7, True), (9, False), (10, True), (10, False)),
    *((11, False), (13, True), (16, True), (17, False), (19, False), (20, False), (22, True), (23, True)),
    *((25, False), (32, False), (32, False), (34, False), (35, False)),
]


@given(TIMES)
def test_without_early_ends_the_share_is_a_count(times):
    found = run_times(times, [CAP] * len(times))
    for t in [0.0, 1.0, *(t for t in times if t), CAP]:
        assert found.at(t) == pytest.approx(sum(r is not None and r <= t for r in times) / len(times))


@given(TIMES)
def test_the_band_holds_the_curve(times):
    found = run_times(times, [CAP] * len(times))
    there = found.share > 0
    assert (found.low[there] <= found.share[there] + 1e-12).all()
    assert (found.high[there] >= found.share[there] - 1e-12).all()
    assert not np.isnan(found.low).any()


@given(TIMES, st.randoms())
def test_the_order_of_runs_does_not_matter(times, random):
    shuffled = random.sample(times, len(times))
    one, other = (run_times(t, [CAP] * len(t)) for t in (times, shuffled))
    assert np.array_equal(one.share, other.share)
    assert one.median == other.median


def test_a_published_table():
    times = [t if event else None for t, event in FREIREICH]
    found = run_times(times, [t for t, _ in FREIREICH])
    # Survival as printed in Lawless (1982) and everywhere since.
    printed = {6: 0.857, 7: 0.807, 10: 0.753, 13: 0.690, 16: 0.627, 22: 0.538, 23: 0.448}
    for week, survival in printed.items():
        assert 1 - found.at(week) == pytest.approx(survival, abs=5e-4)
    assert found.median == 23
    # Log-log 95 % limits of survival at 7 and at 23 weeks (Greenwood's variance), worked out by hand.
    for week in (7, 23):
        survival = 1 - found.at(week)
        variance = sum(
            d / (n * (n - d))
            for t, d, n in [
                (6, 3, 21),
                (7, 1, 17),
                (10, 1, 15),
                (13, 1, 12),
                (16, 1, 11),
                (22, 1, 7),
                (23, 1, 6),
            ]
            if t <= week
        )
        wide = 1.959964 * math.sqrt(variance) / math.log(survival)
        index = np.searchsorted(found.times, week)
        assert 1 - found.low[index] == pytest.approx(survival ** math.exp(wide), abs=1e-6)
        assert 1 - found.high[index] == pytest.approx(survival ** math.exp(-wide), abs=1e-6)


def test_a_median_that_was_not_reached_says_so():
    assert run_times([10.0, None, math.inf, math.nan], [CAP] * 4).median == math.inf
    assert in_words(run_times([None], [CAP]).median) == "not reached"
    assert in_words(1458.4) == "1,458 s"


@given(TIMES)
def test_the_median_is_that_of_the_times_with_unreached_ones_infinitely_late(times):
    late = [math.inf if time is None else time for time in times]
    assert run_times(times, [CAP] * len(times)).median == pytest.approx(np.median(late))


def test_the_median_of_the_published_tenth_sequences():
    """Table S3 of the Mark I3 robot runs, one of which ended before its tenth sequence."""
    times = [1198, 1506, 1250, 2248, 1070, 1410, 923, 1600, None, 1656]
    assert run_times(times, [2400] * 10).median == 1458


@pytest.mark.parametrize(("times", "ends"), [([], []), ([1.0], [])])
def test_no_runs_are_refused(times, ends):
    with pytest.raises(ValueError, match="at least one run"):
        run_times(times, ends)

"""Tests of difference against published examples and a formula."""

from math import comb

import pytest

from formicarium.statistics.compare import fisher, log_rank


def test_log_rank_of_the_remission_trial():
    """Freireich et al. 1963: chi-squared 16.79 on one degree of freedom, in every textbook."""
    treated = [6, 6, 6, 7, 10, 13, 16, 22, 23]
    ended = [6, 9, 10, 11, 17, 19, 20, 25, 32, 32, 34, 35]
    placebo = [1, 1, 2, 2, 3, 4, 4, 5, 5, 8, 8, 8, 8, 11, 11, 12, 12, 15, 17, 22, 23]
    found = log_rank([*treated, *[None] * len(ended)], [*treated, *ended], placebo, placebo)
    assert found.statistic**2 == pytest.approx(16.79, abs=0.005)
    assert found.p_value == pytest.approx(4.17e-5, rel=0.01)


def test_fisher_on_the_lady_tasting_tea():
    """Three of four cups right each way: tables as extreme or more are 17 of 35 arrangements."""
    one_sided = [comb(4, k) * comb(4, 4 - k) / comb(8, 4) for k in range(5)]
    two_sided = sum(p for p in one_sided if p <= one_sided[3] + 1e-12)
    found = fisher(3, 4, 1, 4)
    assert found.p_value == pytest.approx(two_sided)
    assert found.statistic == pytest.approx(9.0)


def test_equal_sets_do_not_differ():
    times = [1.0, 2.0, None]
    assert log_rank(times, [3.0] * 3, times, [3.0] * 3).p_value == pytest.approx(1.0)
    assert fisher(5, 10, 5, 10).p_value == pytest.approx(1.0)


@pytest.mark.filterwarnings("error")
def test_sets_in_which_nothing_was_reached_do_not_differ():
    assert log_rank([None, None], [9.0, 9.0], [None], [5.0]) == ("log-rank", 0.0, 1.0)
    assert log_rank([None], [1.0], [2.0], [2.0]).p_value == 1.0

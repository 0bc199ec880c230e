"""Sizes of effects against published examples, formulas and simulated truth."""

import math

import numpy as np
import pytest
from scipy import stats

from formicarium.statistics.effects import hazard_ratio, holm, median_ratio, odds_ratio, risk_difference
from formicarium.statistics.runtimes import run_times

TREATED = [6, 6, 6, 7, 10, 13, 16, 22, 23]
ENDED = [6, 9, 10, 11, 17, 19, 20, 25, 32, 32, 34, 35]
PLACEBO = [1, 1, 2, 2, 3, 4, 4, 5, 5, 8, 8, 8, 8, 11, 11, 12, 12, 15, 17, 22, 23]
REMISSION = (PLACEBO, PLACEBO, [*TREATED, *[None] * len(ENDED)], [*TREATED, *ENDED])


@pytest.mark.parametrize(
    ("table", "low", "high"),
    [((56, 70, 48, 80), 0.0524, 0.3339), ((9, 10, 3, 10), 0.1705, 0.8090), ((10, 10, 0, 10), 0.6075, 1.0)],
)
def test_risk_differences_of_newcombe(table, low, high):
    """Newcombe 1998 (Statistics in Medicine 17:873), Table II, method 10."""
    found = risk_difference(*table)
    assert found.low == pytest.approx(low, abs=5e-5)
    assert found.high == pytest.approx(high, abs=5e-5)


def test_the_odds_ratio_of_the_lady_tasting_tea():
    """R's fisher.test estimates 6.408309; at the ends of the interval each tail holds 2.5 %."""
    found = odds_ratio(3, 4, 1, 4)
    assert found.value == pytest.approx(6.408309, rel=1e-5)
    assert stats.nchypergeom_fisher(8, 4, 4, found.low).sf(2) == pytest.approx(0.025, rel=1e-3)
    assert stats.nchypergeom_fisher(8, 4, 4, found.high).cdf(3) == pytest.approx(0.025, rel=1e-3)


def test_the_hazard_ratio_of_the_remission_trial():
    """Cox regression of Freireich et al. 1963 with Efron's ties: coefficient 1.5721, standard error 0.4124.

    The interval is that of the likelihood, which for 42 patients is close to 1.96 standard errors.
    """
    found = hazard_ratio(*REMISSION)
    assert math.log(found.value) == pytest.approx(1.5721, abs=5e-5)
    assert math.log(found.low) == pytest.approx(1.5721 - 1.96 * 0.4124, abs=0.06)
    assert math.log(found.high) == pytest.approx(1.5721 + 1.96 * 0.4124, abs=0.06)


def test_ratios_turn_over_with_the_sets():
    turned = hazard_ratio(*REMISSION[2:], *REMISSION[:2])
    assert turned.value == pytest.approx(1 / hazard_ratio(*REMISSION).value, rel=1e-6)
    assert turned.low == pytest.approx(1 / hazard_ratio(*REMISSION).high, rel=1e-6)


def test_the_median_ratio_is_that_of_the_medians():
    treated = run_times(REMISSION[2], REMISSION[3]).median
    found = median_ratio(*REMISSION)
    assert found.value == pytest.approx(run_times(PLACEBO, PLACEBO).median / treated)
    assert found.low < found.value < found.high
    assert found == median_ratio(*REMISSION)


def test_intervals_hold_the_truth_about_as_often_as_they_say():
    """Exponential times of rates 1 and 2, ended at 1.5: the hazard ratio is 2, that of the medians 1/2."""
    random, inside = np.random.default_rng(7), {"hazard": 0, "median": 0}
    for _ in range(60):
        sets = []
        for rate in (2.0, 1.0):
            times = random.exponential(1 / rate, 40)
            sets += [[float(time) if time < 1.5 else None for time in times], [1.5] * 40]
        hazard, median = hazard_ratio(*sets), median_ratio(*sets)
        inside["hazard"] += hazard.low < 2.0 < hazard.high
        inside["median"] += median.low < 0.5 < median.high
    assert 52 <= inside["hazard"] <= 60
    assert 52 <= inside["median"] <= 60


def test_where_nothing_was_reached_intervals_are_wide_open():
    never, ends, some = [None] * 5, [9.0] * 5, [1.0, 2.0, 3.0, 4.0, 5.0]
    assert hazard_ratio(never, ends, some, some) == (0.0, 0.0, math.inf)
    assert math.isnan(hazard_ratio(never, ends, never, ends).value)
    assert median_ratio(never, ends, some, some).value == math.inf
    found = median_ratio(never, ends, never, ends)
    assert math.isnan(found.value) and (found.low, found.high) == (0.0, math.inf)
    assert math.isnan(odds_ratio(5, 5, 7, 7).value)
    assert odds_ratio(5, 5, 7, 7)[1:] == (0.0, math.inf)


def test_holm_on_four_tests():
    assert holm([0.01, 0.04, 0.03, 0.005]) == pytest.approx([0.03, 0.06, 0.06, 0.02])
    assert holm([]) == []

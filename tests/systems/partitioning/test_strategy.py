"""The paper's equations 1 to 4 (AC-29): tables worked by hand, and what must hold for any numbers."""

import math

import numpy as np
import pytest

from formicarium.systems.partitioning.strategy import giving_up_probability, partition_probability, renewed

# t_NP, t_1, t_2 -> P_p at S = 0.5, 5, 10 (TP-13)
EQUATION_1 = [
    (400, 60, 60, 0.7625, 0.999991, 1.0),
    (400, 120, 120, 0.5826, 0.965555, 0.998729),
    (400, 150, 150, 0.5416, 0.841131, 0.965555),
    (400, 180, 180, 0.5139, 0.635424, 0.752336),
    (400, 200, 200, 0.5, 0.5, 0.5),
    (400, 220, 220, 0.4875, 0.377541, 0.268941),
    (400, 260, 260, 0.4626, 0.182426, 0.047426),
    (400, 320, 320, 0.4256, 0.047426, 0.002473),
    (200, 50, 50, 0.6225, 0.993307, 0.999955),
    (100, 100, 100, 0.3775, 0.006693, 0.000045),
]


@pytest.mark.parametrize("row", EQUATION_1)
def test_the_table_of_equation_1(row):
    whole, first, second, *expected = row
    for steepness, value in zip((0.5, 5.0, 10.0), expected, strict=True):
        digits = 1e-4 if steepness == 0.5 else 1e-6
        assert partition_probability(whole, first, second, steepness, 1e-12) == pytest.approx(value, abs=digits)


def times(count):
    return np.random.default_rng(1).uniform(1.0, 2000.0, (count, 3))


def test_both_branches_mirror_each_other_and_scale_does_not_matter():
    for whole, first, second in times(500):
        one = partition_probability(whole, first, second, 5.0, 1e-12)
        parts = first + second
        other = partition_probability(parts, 0.5 * whole, 0.5 * whole, 5.0, 1e-12)
        assert one + other == pytest.approx(1.0, abs=1e-9)
        assert partition_probability(7 * whole, 7 * first, 7 * second, 5.0, 1e-12) == pytest.approx(one, abs=1e-9)


def test_the_longer_the_whole_the_likelier_the_parts():
    values = [partition_probability(whole, 90.0, 110.0, 5.0, 0.0) for whole in np.linspace(1.0, 3000.0, 999)]
    assert (np.diff(values) >= 0).all()
    below, above = (partition_probability(200.0 + e, 100.0, 100.0, 5.0, 0.0) for e in (-1e-9, 1e-9))
    assert above - below < 1e-9


def test_no_probability_is_quite_0_or_1():
    assert partition_probability(1e9, 1.0, 1.0, 5.0, 1e-12) == 1.0 - 1e-12
    assert partition_probability(1.0, 1e9, 1e9, 5.0, 1e-12) == 1e-12


@pytest.mark.parametrize(
    ("waited", "expected"),
    [(0, 0.3208), (30, 0.3486), (60, 0.3775),
     (120, 0.4378), (180, 0.5), (240, 0.5622), (360, 0.6792),
     (600, 0.8520), (1200, 0.9859)],
)  # fmt: skip
def test_the_table_of_equations_3_and_4_at_every_scale(waited, expected):
    for scale in (1.0, 2.0, 10.0 / 3.0):
        own = 60.0 * scale
        found = giving_up_probability(waited * scale, own, own, own, -0.5, -1.0)
        theta = -0.5 * ((waited - 60.0) / 120.0 - 1.0)
        assert found == pytest.approx(1.0 / (1.0 + math.exp(theta)), abs=1e-12)
        assert found == pytest.approx(expected, abs=1e-4)


def test_patience_wears_off_with_time_and_a_larger_own_estimate_lengthens_it():
    """T8: K > 0, or exp(-Theta), makes the probability shrink: the commonest slip in copying it out."""
    waits = [giving_up_probability(w, 60.0, 60.0, 60.0, -0.5, -1.0) for w in range(0, 2000, 7)]
    assert (np.diff(waits) > 0).all()
    assert giving_up_probability(0.0, 300.0, 60.0, 300.0, -0.5, -1.0) == pytest.approx(0.286, abs=1e-3)
    assert giving_up_probability(0.0, 60.0, 60.0, 300.0, -0.5, -1.0) == pytest.approx(0.358, abs=1e-3)


def test_one_measurement_nearly_erases_the_past():
    estimate, history = 75.0, []
    for _ in range(3):
        estimate = renewed(estimate, 400.0, 0.8)
        history.append(estimate)
    assert history == pytest.approx([335.0, 387.0, 397.4])

"""Analyses of variance against another implementation, and contrasts against their formulas."""

import numpy as np
import pandas
import pytest
from scipy import stats
from statsmodels.formula.api import ols
from statsmodels.stats.anova import anova_lm

from formicarium.statistics.means import contrast, welch
from formicarium.statistics.variance import analyse


def made_up(lost=0):
    """Return runs of a 3 x 3 x 2 design with an interaction of a and b, some of them lost."""
    draws = np.random.default_rng(1)
    rows = [(a, b, c) for a in (0.0, 100.0, 200.0) for b in (0.5, 5.0, 10.0) for c in (-1.0, -5.0) for _ in range(4)]
    table = pandas.DataFrame(rows, columns=["a", "b", "c"])
    table["y"] = 200 + table.a * 0.1 + table.c - 0.03 * table.a * table.b + draws.normal(0, 5, len(table))
    return table.drop(draws.choice(len(table), lost, replace=False))


@pytest.mark.parametrize("lost", [0, 13])
def test_every_line_of_the_table_is_that_of_statsmodels(lost):
    table = made_up(lost)
    ours = analyse(table.y, {name: table[name] for name in "abc"})
    theirs = anova_lm(ols("y ~ (C(a, Sum) + C(b, Sum) + C(c, Sum)) ** 2", table).fit(), typ=2)
    assert ours.squares == pytest.approx(theirs.sum_sq["Residual"])
    assert ours.freedom == theirs.df["Residual"]
    for term in ours.terms:
        line = theirs.loc[":".join(f"C({name}, Sum)" for name in term.factors)]
        assert (term.squares, term.freedom, term.ratio) == pytest.approx((line.sum_sq, line.df, line.F))
        assert term.p_value == pytest.approx(line["PR(>F)"], rel=1e-6)
    assert ours.term("b", "a").p_value < 1e-6 < ours.term("b", "c").p_value


def test_in_a_balanced_design_the_terms_add_up_to_one():
    table = made_up()
    ours = analyse(table.y, {name: table[name] for name in "abc"})
    total = ((table.y - table.y.mean()) ** 2).sum()
    assert sum(term.share for term in ours.terms) + ours.squares / total == pytest.approx(1.0)


def test_too_few_runs_are_refused():
    with pytest.raises(ValueError, match="no degrees of freedom"):
        analyse([1.0, 2.0], {"a": [0, 1]})
    with pytest.raises(ValueError, match="one level"):
        analyse([1.0, 2.0, 3.0], {"a": [0, 0, 0]})


def test_a_contrast_of_two_cells_is_welchs_test():
    one, other = [5.0, 6.0, 7.5, 9.0], [4.0, 4.5, 5.5]
    found = contrast([one, other], [1.0, -1.0])
    assert found.value == pytest.approx(np.mean(one) - np.mean(other))
    interval = stats.ttest_ind(one, other, equal_var=False).confidence_interval(0.95)
    assert (found.low, found.high) == pytest.approx((interval.low, interval.high))
    exact = 1.0 - welch(one, other)
    touching = contrast([one, other], [1.0, -1.0], confidence=exact)
    assert touching.low == pytest.approx(0.0, abs=1e-9)


def test_a_contrast_without_spread_is_its_value():
    assert contrast([[3.0], [1.0]], [1.0, -1.0])[:3] == (2.0, 2.0, 2.0)
    assert contrast([[3.0], [1.0, 2.0]], [1.0, -1.0]).low < 1.5
    with pytest.raises(ValueError, match="no mean"):
        contrast([[], [1.0]], [1.0, -1.0])

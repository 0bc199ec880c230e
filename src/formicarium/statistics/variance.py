"""Analysis of variance of designs with several factors, balanced or not."""

import itertools
from collections.abc import Mapping, Sequence
from typing import NamedTuple

import numpy as np
import scipy


class Term(NamedTuple):
    """What a main effect or the interaction of two factors explains."""

    factors: tuple[str, ...]  # one or two names
    squares: float  # sum of squares, type II
    freedom: int  # degrees of freedom
    ratio: float  # F, against what no term explains
    p_value: float
    share: float  # eta squared: of the sum of squares about the mean


class Analysis(NamedTuple):
    """All main effects and two-way interactions, and what they leave."""

    terms: tuple[Term, ...]
    squares: float  # of the residuals
    freedom: int
    residuals: np.ndarray  # (n,)

    def term(self, *factors: str) -> Term:
        """Return a main effect, or the interaction of two factors in any order."""
        return next(term for term in self.terms if set(term.factors) == set(factors))


def analyse(values: Sequence[float] | np.ndarray, factors: Mapping[str, Sequence[float]]) -> Analysis:
    """Return the analysis with all main effects and two-way interactions, type II sums of squares.

    A term's sum of squares is what it explains beyond all terms that do not contain it:
    ``RSS(those) - RSS(those and the term)``; in a balanced design all types are the same.

    Args:
        values: the response, (n,).
        factors: levels of every run by the factor's name, each (n,).

    Raises:
        ValueError: if a factor has one level only, or no degrees of freedom are left for the residuals.
    """
    response = np.asarray(values, float)
    names = [(name,) for name in factors] + list(itertools.combinations(factors, 2))
    columns = {name: _columns(name, factors) for name in names}
    left, freedom, residuals = _fit(response, list(columns.values()))
    if freedom < 1:
        raise ValueError(f"{len(response)} runs leave no degrees of freedom")
    total = float(((response - response.mean()) ** 2).sum())
    terms = []
    for name in names:
        others = [columns[other] for other in names if not set(name) <= set(other)]
        without, free_without, _ = _fit(response, others)
        with_it, free_with, _ = _fit(response, [*others, columns[name]])
        degrees, squares = free_without - free_with, without - with_it
        ratio = squares / degrees / (left / freedom) if degrees and left > 0 else float("nan")
        terms.append(
            Term(name, squares, degrees, ratio, float(scipy.stats.f.sf(ratio, degrees, freedom)), squares / total)
        )
    return Analysis(tuple(terms), left, freedom, residuals)


def _fit(response: np.ndarray, columns: Sequence[np.ndarray]) -> tuple[float, int, np.ndarray]:
    """Return what a linear model with these columns and a mean leaves: squares, degrees of freedom, residuals."""
    design = np.column_stack([np.ones(len(response)), *columns])
    found, _, rank, _ = np.linalg.lstsq(design, response, rcond=None)
    residuals = response - design @ found
    freedom = len(response) - int(rank)
    return float((residuals**2).sum()), freedom, residuals


def _columns(name: tuple[str, ...], factors: Mapping[str, Sequence[float]]) -> np.ndarray:
    """Return the columns of a term: each level against the last, and products of those for an interaction."""
    result = np.ones((len(next(iter(factors.values()))), 1))
    for factor in name:
        column = np.asarray(factors[factor])
        levels = np.unique(column)
        if len(levels) < 2:
            raise ValueError(f"{factor} has one level only")
        coded = np.stack([(column == level).astype(float) - (column == levels[-1]) for level in levels[:-1]], axis=1)
        result = (result[:, :, None] * coded[:, None, :]).reshape(len(column), -1)
    return result

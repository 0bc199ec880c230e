"""The analysis of variance of Table 1's grid (TP-80): four analyses, effects with intervals, AC-26 to AC-28."""

import itertools
from collections.abc import Iterable, Sequence
from typing import Any, NamedTuple

import numpy as np
import scipy

from formicarium.statistics.means import Mean, contrast
from formicarium.statistics.variance import Analysis, analyse
from formicarium.studies.foraging import Row, column, consistent, picked

INTERFACING = "cache.interfacing_time"
# The factors of Table 1, as columns of a row, with their letters and levels.
GRID: dict[str, tuple[str, tuple[float, ...]]] = {
    INTERFACING: ("Π", (0.0, 100.0, 200.0)),
    "strategy.alpha": ("α", (0.5, 0.75, 1.0)),
    "strategy.steepness": ("S", (0.5, 5.0, 10.0)),
    "strategy.giveup_steepness": ("K", (-0.5, -1.5, -2.5)),
    "strategy.giveup_offset": ("O", (-1.0, -5.0, -9.0)),
}
TIMES = GRID[INTERFACING][1]
RESPONSE = "objects_per_robot"
SURE = 0.001  # p-value below which K and O are said to matter (AC-28)


class Study(NamedTuple):
    """One of the four analyses."""

    title: str
    cells: int  # that have runs
    runs: int
    analysis: Analysis
    ranked: Analysis  # of the ranks of the response: without its outliers and its skewness
    skewness: float  # of the residuals
    excess: float  # their kurtosis less three
    spread_p: float  # that all cells have the same spread (Brown and Forsythe), nan if no cell has two runs


def cells_of_grid(rows: Iterable[Row]) -> dict[tuple[float, ...], list[float]]:
    """Return the objects per robot of every cell of the grid, by its levels in the order of GRID."""
    cells: dict[tuple[float, ...], list[float]] = {}
    for row in rows:
        cells.setdefault(tuple(float(row[name]) for name in GRID), []).append(float(row[RESPONSE]))
    return cells


def analyses(rows: Sequence[Row]) -> list[Study]:
    """Return the paper's four analyses: one with Π as a factor, three with Π fixed; inconsistent runs left out.

    Raises:
        ValueError: if there are too few runs.
    """
    kept = consistent(rows)
    if not kept:
        raise ValueError("no run of the grid of Table 1")
    studies = [_analysis("all Π", kept, list(GRID))]
    for time in sorted({float(row[INTERFACING]) for row in kept}):
        own = [row for row in kept if row[INTERFACING] == time]
        studies.append(_analysis(f"Π = {time:g} s", own, [name for name in GRID if name != INTERFACING]))
    return studies


def _analysis(title: str, rows: Sequence[Row], names: Sequence[str]) -> Study:
    response = np.array(column(rows, RESPONSE))
    factors = {GRID[name][0]: [float(row[name]) for row in rows] for name in names}
    analysis, ranked = analyse(response, factors), analyse(scipy.stats.rankdata(response), factors)
    cells = cells_of_grid(rows)
    several = [cell for cell in cells.values() if len(cell) > 1]
    spread_p = float(scipy.stats.levene(*several, center="median").pvalue) if len(several) > 1 else float("nan")
    shape = analysis.residuals
    skewness, excess = float(scipy.stats.skew(shape)), float(scipy.stats.kurtosis(shape))
    return Study(title, len(cells), len(rows), analysis, ranked, skewness, excess, spread_p)


def table_of_terms(rows: Sequence[Row]) -> list[dict[str, Any]]:
    """Return a row for every term of every analysis, and one for what is left."""
    table: list[dict[str, Any]] = []
    for study in analyses(rows):
        for term, rank in zip(study.analysis.terms, study.ranked.terms, strict=True):
            name = " x ".join(term.factors)
            numbers = {"sum_of_squares": term.squares, "freedom": term.freedom, "F": term.ratio, "p": term.p_value}
            table.append(
                {"analysis": study.title, "term": name} | numbers | {"eta2": term.share, "p_ranks": rank.p_value}
            )
        rest = {"sum_of_squares": study.analysis.squares, "freedom": study.analysis.freedom}
        empty = dict.fromkeys(("F", "p", "eta2", "p_ranks"))
        table.append({"analysis": study.title, "term": "residuals"} | rest | empty)
    return table


def level_mean(rows: Sequence[Row], **levels: float) -> Mean:
    """Return the mean over the cells at these levels ("strategy__alpha"), each cell with the same weight."""
    cells = list(cells_of_grid(picked(rows, **levels)).values())
    return contrast(cells, [1.0 / max(1, len(cells))] * len(cells))


def difference(rows: Sequence[Row], name: str, high: float, low: float, at: Sequence[tuple[float, float]]) -> Mean:
    """Return what a factor's high level gives more than its low one, over cells with both.

    Args:
        rows: consistent runs of the grid.
        name: the factor's column.
        high: one level.
        low: the other.
        at: (interfacing time, weight) pairs: ((0, 1), (200, -1)) is the interaction with Π.
    """
    cells, place = cells_of_grid(rows), list(GRID).index(name)
    chosen: list[Sequence[float]] = []
    weights: list[float] = []
    for time, weight in at:
        ours = [key for key in cells if key[0] == time and key[place] == high]
        pairs = [(key, (*key[:place], low, *key[place + 1 :])) for key in ours]
        pairs = [(one, other) for one, other in pairs if other in cells]
        if not pairs:
            raise ValueError(f"no runs of the grid at Π {time:g}")
        for one, other in pairs:
            chosen += [cells[one], cells[other]]
            weights += [weight / len(pairs), -weight / len(pairs)]
    return contrast(chosen, weights)


def _words(mean: Mean) -> str:
    return f"{mean.value:+.1f} ({mean.low:+.1f} to {mean.high:+.1f})"


def _grid(rows: Sequence[Row]) -> Sequence[Row]:
    found = {float(row[INTERFACING]) for row in rows}
    if found < set(TIMES):
        raise ValueError("the grid of Table 1")
    return rows


def alpha_effect(rows: Sequence[Row]) -> tuple[str, bool | None]:
    """AC-26: what alpha 1 gives more than 0.5; reported only."""
    _grid(rows)
    third = [(time, 1.0 / len(TIMES)) for time in TIMES]
    name = "strategy.alpha"
    said = [f"α 1 against 0.5, objects per robot: all Π {_words(difference(rows, name, 1.0, 0.5, third))}"]
    said += [f"Π {time:g} {_words(difference(rows, name, 1.0, 0.5, [(time, 1.0)]))}" for time in TIMES]
    return ", ".join(said), None


def steepness_interaction(rows: Sequence[Row]) -> tuple[str, bool | None]:
    """AC-27: a steep choice gains more at small Π than at large: the sign, if the interval leaves one."""
    _grid(rows)
    name = "strategy.steepness"
    gains = ", ".join(f"Π {time:g} {_words(difference(rows, name, 10.0, 0.5, [(time, 1.0)]))}" for time in TIMES)
    turn = difference(rows, name, 10.0, 0.5, [(TIMES[0], 1.0), (TIMES[-1], -1.0)])
    said = f"S 10 against 0.5: {gains}; Π 0 less Π 200 {_words(turn)}"
    if turn.low <= 0.0 <= turn.high:
        return f"{said}: the interval leaves the sign open", None
    return said, turn.value > 0.0


def giving_up_matters(rows: Sequence[Row]) -> tuple[str, bool | None]:
    """AC-28: K and O, both main effects; the best and worst pair at every Π is told with it."""
    whole = analyses(_grid(rows))[0].analysis
    values = {name: whole.term(name).p_value for name in ("K", "O")}
    said = [f"p of K {values['K']:.1g}, of O {values['O']:.1g}, of K x O {whole.term('K', 'O').p_value:.1g}"]
    for time in TIMES:
        means = _pairs(rows, time)
        best, worst = max(means, key=lambda pair: means[pair]), min(means, key=lambda pair: means[pair])
        said.append(f"Π {time:g}: best {best} {means[best]:.0f}, worst {worst} {means[worst]:.0f}")
    return "; ".join(said), max(values.values()) < SURE


def _pairs(rows: Sequence[Row], time: float) -> dict[tuple[float, float], float]:
    """Return the mean of every pair of K and O at one interfacing time."""
    means = {}
    for pair in itertools.product(GRID["strategy.giveup_steepness"][1], GRID["strategy.giveup_offset"][1]):
        own = picked(
            rows, cache__interfacing_time=time, strategy__giveup_steepness=pair[0], strategy__giveup_offset=pair[1]
        )
        if own:
            means[pair] = float(np.mean(column(own, RESPONSE)))
    return means


def section(rows: Sequence[Row]) -> list[str]:
    """Return the analyses as lines of Markdown."""
    lines = ["Type II sums of squares, main effects and two-way interactions; p of ranks: the same on ranks.", ""]
    try:
        found = analyses(rows)
    except ValueError as lacking:
        return [*lines, f"Runs are missing: {lacking}."]
    for study in found:
        lines += [f"### {study.title}: {study.runs} runs in {study.cells} cells", ""]
        lines += ["| term | F | freedom | p | η² | p of ranks |", "|---|---|---|---|---|---|"]
        for term, rank in zip(study.analysis.terms, study.ranked.terms, strict=True):
            numbers = f"{term.ratio:.1f} | {term.freedom} | {term.p_value:.1g} | {term.share:.3f} | {rank.p_value:.1g}"
            lines.append(f"| {' x '.join(term.factors)} | {numbers} |")
        shape = f"skewness {study.skewness:.2f}, kurtosis {study.excess:+.1f} over normal"
        spread = f"p that all cells spread alike {study.spread_p:.1g}"
        lines += ["", f"Residuals: {study.analysis.freedom} degrees of freedom, {shape}; {spread}.", ""]
    return lines

"""AC-21 to AC-25: what the size of the swarm does to the three methods (Fig. 11)."""

import itertools
import math
from collections.abc import Callable, Sequence

import numpy as np

from formicarium.statistics.means import contrast, welch
from formicarium.studies.foraging import METHODS, Runs, column, picked

CHANCE = 0.05  # p-value from which on a difference is put down to chance, shared by the differences that could refute
WORDS = {True: "hold", False: "fail", None: "leave it open"}

Sizes = dict[str, dict[int, list[float]]]  # objects per robot of every run, by method and size of the swarm


def _cell(runs: Runs, method: str, time: float, robots: int) -> tuple[list[float], list[float]]:
    """Return objects per robot of the clean runs of a cell, and of all its runs."""
    chosen = (
        picked(rows, method=method, interfacing_time_s=time, robots=robots) for rows in (runs.scalability, runs.crowds)
    )
    clean, everything = (column(rows, "objects_per_robot") for rows in chosen)
    return clean, everything


def _sizes(runs: Runs, time: float) -> tuple[Sizes, Sizes, list[str]]:
    """Return the runs that count, all runs, and words on cells in which fewer than half of the runs are clean.

    A mean has no spread with fewer than two runs; where so few are clean all of a cell's runs count.
    """
    counted: Sizes = {method: {} for method in METHODS}
    every: Sizes = {method: {} for method in METHODS}
    marked = []
    for method, n in itertools.product(METHODS, sorted({row["robots"] for row in runs.crowds})):
        clean, everything = _cell(runs, method, time, n)
        if not everything:
            continue
        alone = min(2, len(everything))
        counted[method][n], every[method][n] = clean if len(clean) >= alone else everything, everything
        if 2 * len(clean) < len(everything):
            marked.append(
                f"{method} {n}: {len(clean)} of {len(everything)}{'' if len(clean) >= alone else ', all count'}"
            )
    return counted, every, marked


def _by_size(runs: Runs, test: Callable[[Sizes], tuple[str, bool | None]]) -> tuple[str, bool | None]:
    """Test both interfacing times: it fails if one fails, and is open if one is. With runs left out, and with all."""
    said, verdicts = [], []
    for time in sorted({row["interfacing_time_s"] for row in runs.crowds}):
        counted, every, marked = _sizes(runs, time)
        words, verdict = _asked(test, counted)
        if marked:
            words += f" (few runs without phantoms: {'; '.join(marked)})"
        if every != counted:
            others, other = _asked(test, every)
            words += "; all runs: the same" if other == verdict else f"; all runs {WORDS[other]}: {others}"
        said.append(f"Π {time:g}: {words}")
        verdicts.append(verdict)
    if not said:
        raise ValueError("no runs of several sizes")
    return "; ".join(said), False if False in verdicts else None if None in verdicts else True


def _asked(test: Callable[[Sizes], tuple[str, bool | None]], sizes: Sizes) -> tuple[str, bool | None]:
    try:
        return test(sizes)
    except ValueError as lacking:
        return f"runs are missing ({lacking})", None


def _line(values: dict[int, list[float]]) -> str:
    return ", ".join(f"{n}: {np.mean(value):.0f}" for n, value in values.items())


def above_surely(values: Sequence[float], others: Sequence[float], chance: float = CHANCE) -> bool | None:
    """Tell whether one set has the greater mean (95 %, Welch); None if it has, but chance would do."""
    if np.mean(values) <= np.mean(others):
        return False
    return True if welch(values, others) < chance else None


def below_surely(values: Sequence[float], others: Sequence[float], tests: int) -> bool | None:
    """Tell whether one set has the smaller mean: True only if one of so many tests would not say so by chance.

    False if it surely has the greater one, None if chance would do.
    """
    p_value, below = welch(values, others), np.mean(values) < np.mean(others)
    if below:
        return True if p_value < CHANCE / tests else None
    return False if p_value < CHANCE else None


def never_falls(runs: Runs) -> tuple[str, bool | None]:
    """AC-21: who never partitions does the less, the more there are."""

    def falls(sizes: Sizes) -> tuple[str, bool | None]:
        line = sizes["never"]
        steps = list(itertools.pairwise(line))
        if not steps:
            raise ValueError("no runs of several sizes")
        rises = {f"{a} to {b}": above_surely(line[b], line[a], CHANCE / len(steps)) for a, b in steps}
        unsure = [step for step, rise in rises.items() if rise is None]
        words = _line(line) + (f" (the rise from {', '.join(unsure)} may be chance)" if unsure else "")
        return words, False if True in rises.values() else None if unsure else True

    return _by_size(runs, falls)


def best_at_eight(runs: Runs) -> tuple[str, bool | None]:
    """AC-22: no size is surely better than eight robots."""

    def peak(sizes: Sizes) -> tuple[str, bool | None]:
        above: list[bool | None] = []
        for name in ("always", "adaptive"):
            line = sizes[name]
            if 8 not in line or len(line) < 2:
                raise ValueError(f"no runs of {name} with 8 robots")
            above += [above_surely(line[n], line[8], 0.5 * CHANCE / (len(line) - 1)) for n in line if n != 8]
        words = f"always {_line(sizes['always'])}; adaptive {_line(sizes['adaptive'])}"
        return words, False if True in above else None if None in above else True

    return _by_size(runs, peak)


def declines_less(runs: Runs) -> tuple[str, bool | None]:
    """AC-23: from 8 to 30 robots the adaptive method loses less."""

    def decline(sizes: Sizes) -> tuple[str, bool | None]:
        cells = []
        for name in ("adaptive", "always"):
            if not {8, 30} <= sizes[name].keys():
                raise ValueError(f"no runs of {name} with 8 and with 30 robots")
            cells += [sizes[name][30], sizes[name][8]]
        left = {"adaptive": _ratio(*cells[:2]), "always": _ratio(*cells[2:])}
        said = ", ".join(f"{name} {value:.2f}" for name, value in left.items())
        more = math.log(left["adaptive"] / left["always"])
        # The spread of a logarithm of a mean is that of the values over it, to first order.
        relative = contrast([np.array(cell) / np.mean(cell) for cell in cells], [1.0, -1.0, -1.0, 1.0])
        margin = relative.high - relative.value
        sure = min(map(len, cells)) > 1 and abs(more) > margin
        return f"30 against 8 robots: {said}", more > 0 if sure else None

    return _by_size(runs, decline)


def _ratio(values: Sequence[float], others: Sequence[float]) -> float:
    return float(np.mean(values) / np.mean(others))


def _above(runs: Runs, other: str, least: int) -> tuple[str, bool | None]:
    def compare(sizes: Sizes) -> tuple[str, bool | None]:
        ours, others = sizes["adaptive"], sizes[other]
        both = [n for n in ours if n in others and n > 8]
        words = ", ".join(f"{n}: {np.mean(ours[n]):.0f} against {np.mean(others[n]):.0f}" for n in both)
        tested = [n for n in both if n >= least]
        if not tested:
            raise ValueError(f"no runs of {least} robots and more")
        below = [below_surely(ours[n], others[n], len(tested)) for n in tested]
        return words, False if True in below else None if None in below else True

    return _by_size(runs, compare)


def above_always(runs: Runs) -> tuple[str, bool | None]:
    """AC-24: adaptive above always, in large swarms."""
    return _above(runs, "always", 22)


def above_never(runs: Runs) -> tuple[str, bool | None]:
    """AC-25: adaptive above never, in large swarms."""
    return _above(runs, "never", 14)

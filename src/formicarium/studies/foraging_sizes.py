"""AC-21 to AC-25: what the size of the swarm does to the three methods (Fig. 11)."""

import itertools
from collections.abc import Callable, Sequence

import numpy as np

from formicarium.statistics.means import welch
from formicarium.studies.foraging import METHODS, Runs, column, picked

CHANCE = 0.05  # p-value from which on a difference is put down to chance


Sizes = dict[str, dict[int, list[float]]]  # objects per robot of every run, by method and size of the swarm


def _sizes(runs: Runs, method: str, time: float) -> tuple[dict[int, list[float]], list[str]]:
    """Return the runs of a method by size, and for which sizes all runs count because none is without a phantom."""
    clean, everything = (
        picked(rows, method=method, interfacing_time_s=time) for rows in (runs.scalability, runs.crowds)
    )
    if not clean:
        raise ValueError(f"no {method} at Π {time:g}")
    found, marked = {}, []
    for n in sorted({row["robots"] for row in (*clean, *everything)}):
        own = picked(clean, robots=n)
        if not own:
            marked.append(f"{method} {n}")
        found[n] = column(own or picked(everything, robots=n), "objects_per_robot")
    return found, marked


def _by_size(runs: Runs, test: Callable[[Sizes], tuple[str, bool | None]]) -> tuple[str, bool | None]:
    """Test both interfacing times: it fails if one fails, and is open if one is."""
    said, verdicts = [], []
    for time in sorted({row["interfacing_time_s"] for row in runs.scalability}):
        found = {method: _sizes(runs, method, time) for method in METHODS}
        words, verdict = test({method: sizes for method, (sizes, _) in found.items()})
        marked = [cell for _, cells in found.values() for cell in cells]
        without = f" (no run without phantoms, so all count: {', '.join(marked)})" if marked else ""
        said.append(f"Π {time:g}: {words}{without}")
        verdicts.append(verdict)
    if not said:
        raise ValueError("no runs of several sizes")
    return "; ".join(said), False if False in verdicts else None if None in verdicts else True


def _line(values: dict[int, list[float]]) -> str:
    return ", ".join(f"{n}: {np.mean(value):.0f}" for n, value in values.items())


def above_surely(values: Sequence[float], others: Sequence[float]) -> bool | None:
    """Tell whether one set has the greater mean (95 %, Welch); None if it has, but chance would do."""
    if np.mean(values) <= np.mean(others):
        return False
    return True if welch(values, others) < CHANCE else None


def never_falls(runs: Runs) -> tuple[str, bool | None]:
    """AC-21: who never partitions does the less, the more there are."""

    def falls(sizes: Sizes) -> tuple[str, bool | None]:
        line = sizes["never"]
        steps = list(itertools.pairwise(line))
        if not steps:
            raise ValueError("no runs of several sizes")
        rises = {f"{a} to {b}": above_surely(line[b], line[a]) for a, b in steps}
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
                raise ValueError(f"no clean runs of {name} with 8 robots")
            above += [above_surely(line[n], line[8]) for n in line if n != 8]
        words = f"always {_line(sizes['always'])}; adaptive {_line(sizes['adaptive'])}"
        return words, False if True in above else None if None in above else True

    return _by_size(runs, peak)


def declines_less(runs: Runs) -> tuple[str, bool | None]:
    """AC-23: from 8 to 30 robots the adaptive method loses less."""

    def decline(sizes: Sizes) -> tuple[str, bool | None]:
        left = {}
        for name in ("always", "adaptive"):
            if not {8, 30} <= sizes[name].keys():
                raise ValueError("no clean runs of 8 and of 30 robots")
            left[name] = float(np.mean(sizes[name][30]) / np.mean(sizes[name][8]))
        said = ", ".join(f"{name} {value:.2f}" for name, value in left.items())
        return f"30 against 8 robots: {said}", left["adaptive"] > left["always"]

    return _by_size(runs, decline)


def _above(runs: Runs, other: str, least: int) -> tuple[str, bool | None]:
    def compare(sizes: Sizes) -> tuple[str, bool | None]:
        ours, others = sizes["adaptive"], sizes[other]
        both = [n for n in ours if n in others and n > 8]
        words = ", ".join(f"{n}: {np.mean(ours[n]):.0f} against {np.mean(others[n]):.0f}" for n in both)
        tested = [n for n in both if n >= least]
        if not tested:
            raise ValueError(f"no clean runs of {least} robots and more")
        return words, all(np.mean(ours[n]) > np.mean(others[n]) for n in tested)

    return _by_size(runs, compare)


def above_always(runs: Runs) -> tuple[str, bool | None]:
    """AC-24: adaptive above always, in large swarms."""
    return _above(runs, "always", 22)


def above_never(runs: Runs) -> tuple[str, bool | None]:
    """AC-25: adaptive above never, in large swarms."""
    return _above(runs, "never", 14)

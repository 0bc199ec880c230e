"""The acceptance statements AC-1 to AC-31 on our runs: a sentence, numbers and a verdict each."""

from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np
import scipy

from formicarium.statistics.means import welch
from formicarium.studies import foraging_anova, foraging_method, foraging_sizes
from formicarium.studies.foraging import TIMES, Row, Runs, column, consistent, picked, share_by_hour
from formicarium.studies.foraging_sizes import above_surely

NEAR_CROSSING = 15.0  # s of Π round the crossing of the references, where none of them is the worse one (AC-9)
LEAST_SHARE = 0.2  # of the median; who does less stands still (T27)
HOLDS, FAILS, OPEN, TOLD = "holds", "fails", "open", "reported"
REPORTED = ("AC-10", "AC-19", "AC-26")  # of which the specification asks for numbers, not for a verdict


class Claim(NamedTuple):
    """A statement with what our runs say to it."""

    number: str
    statement: str
    finding: str
    verdict: str


Test = Callable[[Runs], tuple[str, bool | None]]


def claims(runs: Runs) -> list[Claim]:
    """Test every statement for which there are runs; those without inconsistency only (TP-46)."""
    clean = Runs(*(consistent(rows) for rows in runs))._replace(crowds=runs.scalability)
    found = []
    for number, statement, test in TESTS:
        try:
            finding, verdict = test(clean)
            undecided = TOLD if number in REPORTED else OPEN
        except (ValueError, ZeroDivisionError, IndexError) as lacking:
            finding, verdict, undecided = f"runs are missing ({lacking})", None, OPEN
        found.append(Claim(number, statement, finding, undecided if verdict is None else HOLDS if verdict else FAILS))
    return found


def _mean(rows: Sequence[Row], name: str) -> float:
    values = column(rows, name)
    if not values:
        raise ValueError(f"no {name}")
    return float(np.mean(values))


def _some(rows: Sequence[Row]) -> None:
    if not rows:
        raise ValueError("no runs")


def _cell(runs: Runs, method: str, time: float) -> list[Row]:
    return picked(runs.performance, method=method, interfacing_time_s=time)


def _objects(runs: Runs, method: str) -> list[float]:
    return [_mean(_cell(runs, method, t), "objects_per_robot") for t in TIMES]


def _list(values: Sequence[float] | np.ndarray, digits: int = 0) -> str:
    return ", ".join(f"{value:.{digits}f}" for value in values)


def _ac_1(runs: Runs) -> tuple[str, bool | None]:
    times = [_mean(_cell(runs, "never", t), "whole_mean_s") for t in TIMES]
    spread = (max(times) - min(times)) / min(times)
    return f"t_NP {_list(times)} s, spread {100 * spread:.1f} %", all(320 <= t <= 480 for t in times) and spread < 0.03


def _ac_2(runs: Runs) -> tuple[str, bool | None]:
    cell = _cell(runs, "always", 0.0)
    harvest, store = _mean(cell, "harvest_mean_s"), _mean(cell, "store_mean_s")
    near = "R2 (60 s each)" if harvest < 90 else "R1 (120 s each)"
    good = 45 <= harvest <= 150 and 45 <= store <= 150 and abs(harvest / store - 1) < 0.05
    return f"harvest {harvest:.1f} s, store {store:.1f} s, nearer to {near}", good


def _ac_3(runs: Runs) -> tuple[str, bool | None]:
    ratio = _mean(_cell(runs, "always", 0.0), "store_mean_s") / _mean(_cell(runs, "never", 0.0), "whole_mean_s")
    return f"t_store(always) / t_NP(never) = {ratio:.2f}", ratio <= 0.5


def _ac_4(runs: Runs) -> tuple[str, bool | None]:
    worst = 0.0
    _some(runs.performance)
    for row in runs.performance:
        if row["method"] == "never":
            worst = max(worst, abs(row["objects_per_robot"] * row["whole_mean_s"] / row["duration_s"] - 1))
        elif row["method"] == "always":
            expected = row["duration_s"] / row["store_mean_s"] * (row["robots"] // 2) / row["robots"]
            worst = max(worst, abs(row["objects_per_robot"] / expected - 1))
    return f"objects against robots by time: worst run off by {100 * worst:.1f} %", worst <= 0.03


def _ac_5(runs: Runs) -> tuple[str, bool | None]:
    values = [column(_cell(runs, method, 0.0), "objects_per_robot") for method in ("always", "never")]
    means = [_mean(_cell(runs, method, 0.0), "objects_per_robot") for method in ("always", "never")]
    return f"always {means[0]:.0f}, never {means[1]:.0f}, p {welch(*values):.1g}", means[0] > means[1]


def _ac_6(runs: Runs) -> tuple[str, bool | None]:
    always, never = _objects(runs, "always"), _objects(runs, "never")
    return f"always {_list(always)}; never {_list(never)}", all(
        n > a for a, n in zip(always[2:], never[2:], strict=True)
    )


def _ac_7(runs: Runs) -> tuple[str, bool | None]:
    ahead = [a > n for a, n in zip(_objects(runs, "always"), _objects(runs, "never"), strict=True)]
    crossings = [(TIMES[k], TIMES[k + 1]) for k in range(len(TIMES) - 1) if ahead[k] != ahead[k + 1]]
    return f"crossings between Π of {crossings} s", len(crossings) == 1 and crossings[0][1] <= 50


def _ac_8(runs: Runs) -> tuple[str, bool | None]:
    always, never = _objects(runs, "always"), _objects(runs, "never")
    flat = (max(never) - min(never)) / min(never)
    good = all(np.diff(always) < 0) and always[-1] < never[-1] / 3 and flat < 0.03
    return f"never varies by {100 * flat:.1f} %, always falls to {always[-1]:.0f}", good


def _ac_9(runs: Runs) -> tuple[str, bool | None]:
    always, never, adaptive = (_objects(runs, method) for method in ("always", "never", "adaptive"))
    ratios = [c / max(a, n) for a, n, c in zip(always, never, adaptive, strict=True)]
    above = []
    for t, a, n in zip(TIMES, always, never, strict=True):
        worse = _cell(runs, "always" if a < n else "never", t)
        ours, others = (column(rows, "objects_per_robot") for rows in (_cell(runs, "adaptive", t), worse))
        above.append(above_surely(ours, others))
    near = _crossing(always, never)
    gates = [surely for t, surely in zip(TIMES, above, strict=True) if near is None or abs(t - near) > NEAR_CROSSING]
    said = f"adaptive / better reference: {_list(ratios, 2)} (target 0.9, {'met' if min(ratios) >= 0.9 else 'missed'})"
    unsure = [f"{t:g}" for t, surely in zip(TIMES, above, strict=True) if not surely]
    said += f"; not surely above the worse one at Π {', '.join(unsure) or 'none'}"
    return said, False if False in gates else None if None in gates else True


def _crossing(always: Sequence[float], never: Sequence[float]) -> float | None:
    """Return the interfacing time (s) at which the references first change places, on straight lines."""
    ahead = [a - n for a, n in zip(always, never, strict=True)]
    for k in range(len(TIMES) - 1):
        if ahead[k] > 0 >= ahead[k + 1]:
            return TIMES[k] + (TIMES[k + 1] - TIMES[k]) * ahead[k] / (ahead[k] - ahead[k + 1])
    return None


def _ac_10(runs: Runs) -> tuple[str, bool | None]:
    said = [f"{c:.0f} at Π {t:g} (references {a:.0f}, {n:.0f})" for t, a, n, c in zip(
        TIMES, _objects(runs, "always"), _objects(runs, "never"), _objects(runs, "adaptive"), strict=True
    ) if t in (25.0, 50.0)]  # fmt: skip
    return "; ".join(said), None


def _ac_11(runs: Runs) -> tuple[str, bool | None]:
    shares = [100 * _mean(_cell(runs, "adaptive", t), "share_corridor") for t in TIMES]
    rho = float(scipy.stats.spearmanr(TIMES, shares).statistic)
    return f"corridor {_list(shares)} %, Spearman {rho:.2f}", rho >= 0.95


def _ac_12(runs: Runs) -> tuple[str, bool | None]:
    chosen = [100 - 100 * _mean(_cell(runs, "adaptive", t), "share_corridor") for t in TIMES]
    used = [100 * _mean(_cell(runs, "adaptive", t), "share_used") for t in TIMES]
    good = chosen[0] > 50 and chosen[1] > 50 and chosen[-1] < 50
    return f"cache chosen {_list(chosen)} %, used {_list(used)} %", good


def _ac_13(runs: Runs) -> tuple[str, bool | None]:
    _some(runs.performance)
    sums = [row["share_used"] + row["share_gave_up"] + row["share_corridor"] for row in runs.performance]
    never = all(row["share_corridor"] == 1 for row in picked(runs.performance, method="never"))
    always = all(row["share_used"] == 1 for row in picked(runs.performance, method="always"))
    return f"sums 1 in {len(sums)} runs, references pure", max(abs(s - 1) for s in sums) < 1e-9 and never and always


def _ac_14(runs: Runs) -> tuple[str, bool | None]:
    said, good = [], True
    for t in (0.0, 25.0, 50.0):
        for name in ("harvest_mean_s", "store_mean_s"):
            a, b = _mean(_cell(runs, "adaptive", t), name), _mean(_cell(runs, "always", t), name)
            good = good and a < b
            said.append(f"{a:.0f} < {b:.0f}")
    return f"harvest and store at Π 0, 25, 50 (s): {', '.join(said)}", good


def _ac_15(runs: Runs) -> tuple[str, bool | None]:
    spreads = [[_mean(_cell(runs, "always", t), f"{n}_sd_s") for t in (0.0, 25.0, 50.0)] for n in ("harvest", "store")]
    good = all(s[0] < s[1] < s[2] for s in spreads)
    return f"sd of harvest {_list(spreads[0])} s, of store {_list(spreads[1])} s", good


def _ac_16(runs: Runs) -> tuple[str, bool | None]:
    gains = []
    for t in (0.0, 25.0, 50.0):
        parts = sum(_mean(_cell(runs, "always", t), n) for n in ("harvest_mean_s", "store_mean_s"))
        gains.append(_mean(_cell(runs, "never", t), "whole_mean_s") / parts)
    return f"t_NP / (t_h + t_s) at Π 0, 25, 50: {_list(gains, 2)}", gains[0] > 1 > gains[2] and gains[0] > gains[
        1
    ] > gains[2]


def _windows(runs: Runs, before: float, after: float) -> np.ndarray:
    """Return the median share of the cache in every window of an hour."""
    cell = picked(runs.adaptivity, interfacing_time_s=before, cache__switched_time=after)
    if not cell:
        raise ValueError("no runs with a change")
    found = np.median([[share[0] for share in share_by_hour(row)] for row in cell], axis=0)
    if len(found) < 16:
        raise ValueError("runs shorter than the paper's")
    return found


def _ac_17(runs: Runs) -> tuple[str, bool | None]:
    down, up = _windows(runs, 200.0, 0.0)[3:8], _windows(runs, 0.0, 200.0)[3:8]
    said = f"cache in windows 4 to 8: Π 200 first {_list(100 * down)} %; Π 0 first {_list(100 * up)} %"
    return said, bool((down < 0.5).all() and (up > 0.5).all())


def _ac_18(runs: Runs) -> tuple[str, bool | None]:
    down, up = _windows(runs, 200.0, 0.0)[13:16], _windows(runs, 0.0, 200.0)[13:16]
    said = f"cache in windows 14 to 16: 200 to 0 {_list(100 * down)} %; 0 to 200 {_list(100 * up)} %"
    return said, bool((down > 0.5).all() and (up < 0.5).all())


def _ac_19(runs: Runs) -> tuple[str, bool | None]:
    said = []
    for before, after in ((200.0, 0.0), (0.0, 200.0)):
        windows = _windows(runs, before, after)
        middle = 0.5 * (windows[3:8].mean() + windows[13:16].mean())
        side = windows > middle
        changed = next((k for k in range(8, 16) if side[k] != side[7]), None)
        said.append(f"{before:g} to {after:g}: half way in window {'none' if changed is None else changed + 1}")
    return "; ".join(said), None


def _ac_20(runs: Runs) -> tuple[str, bool | None]:
    said, good = [], True
    for t in (200.0, 0.0):
        windows = _windows(runs, t, t)
        early, late = float(windows[3:8].mean()), float(windows[13:16].mean())
        good = good and (early > 0.5) == (late > 0.5)
        said.append(f"Π {t:g}: cache {100 * early:.0f} % then {100 * late:.0f} %")
    return "; ".join(said), good


def _t_27(runs: Runs) -> tuple[str, bool | None]:
    rows = [row for row in (*runs.performance, *runs.scalability) if row["method"] == "never"]
    shares = column(rows, "least_share")
    if not shares:
        raise ValueError("no runs of never")
    words = f"in {len(shares)} runs of never the least busy robot did {min(shares):.2f} of the median at least"
    return words, min(shares) >= LEAST_SHARE


TESTS: list[tuple[str, str, Test]] = [
    ("AC-1", "never: t_NP in 320 to 480 s, the same at every Π (within 3 %)", _ac_1),
    ("AC-2", "always, Π 0: harvest and store in 45 to 150 s and equal within 5 %", _ac_2),
    ("AC-3", "Π 0: storing through the cache takes at most half of t_NP", _ac_3),
    ("AC-4", "Little's law in every run of the references, within 3 %", _ac_4),
    ("AC-5", "Π 0: always better than never", _ac_5),
    ("AC-6", "Π 50 and more: never better than always", _ac_6),
    ("AC-7", "the two lines cross once, at Π of at most 50 s", _ac_7),
    ("AC-8", "never is flat in Π, always falls strictly, below a third of never at Π 200", _ac_8),
    ("AC-9", "adaptive is better than the worse reference everywhere", _ac_9),
    ("AC-10", "adaptive exceeds both references near Π 50", _ac_10),
    ("AC-11", "the corridor's share rises with Π", _ac_11),
    ("AC-12", "the cache is chosen most at Π 0 and 25, the corridor at Π 200", _ac_12),
    ("AC-13", "shares add up, references are pure", _ac_13),
    ("AC-14", "harvest and store take less with adaptive than with always at Π 0, 25, 50", _ac_14),
    ("AC-15", "with always their spread grows with Π", _ac_15),
    ("AC-16", "the gain in speed falls with Π, above 1 at 0 and below 1 at 50", _ac_16),
    ("AC-17", "before the change one strategy leads (windows 4 to 8)", _ac_17),
    ("AC-18", "at the end the other one leads (windows 14 to 16)", _ac_18),
    ("AC-19", "reaction time", _ac_19),
    ("AC-20", "without a change there is no reversal", _ac_20),
    ("AC-21", "never: objects per robot fall with N", foraging_sizes.never_falls),
    ("AC-22", "always and adaptive are best at N = 8", foraging_sizes.best_at_eight),
    ("AC-23", "from 8 to 30 robots adaptive declines less than always, both Π", foraging_sizes.declines_less),
    ("AC-24", "adaptive better than always for N of 22 and more", foraging_sizes.above_always),
    ("AC-25", "adaptive better than never for N of 14 and more", foraging_sizes.above_never),
    ("AC-26", "ANOVA: high alpha is best", lambda runs: foraging_anova.alpha_effect(runs.anova)),
    (
        "AC-27",
        "ANOVA: a steep choice gains more at small Π",
        lambda runs: foraging_anova.steepness_interaction(runs.anova),
    ),
    ("AC-28", "ANOVA: K and O matter (p < 0.001)", lambda runs: foraging_anova.giving_up_matters(runs.anova)),
    ("AC-29", "the equations as the specification's tables have them", foraging_method.equations),
    ("AC-30", "a scripted robot's times come out as by hand", foraging_method.scripted_times),
    ("AC-31", "the cache's automaton, and objects kept", foraging_method.automaton),
    ("T27", "never: nobody stands still unnoticed (0.2 of the median)", _t_27),
]

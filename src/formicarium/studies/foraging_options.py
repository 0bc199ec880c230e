"""What the options beyond the paper bring (TP-O3 to TP-O5): rows and, for reaction and spread, event logs."""

from collections.abc import Callable, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
import scipy

from formicarium.statistics.means import Mean, contrast, mean_of, welch
from formicarium.studies.chart import Chart, Panel, Trace
from formicarium.studies.foraging import SWITCH, Row, column, consistent, picked
from formicarium.systems.partitioning.measures import EventKind
from formicarium.systems.partitioning.memory import Label

CYCLE = 0.1  # s
WINDOW = 600.0  # s, of the share of the cache after a change
SETTLED = 10000.0  # s before and after the change, by which levels are read off
STEADY = 3  # windows in a row that must be past the middle
TIMES = (0.0, 25.0, 50.0, 100.0, 200.0)  # s, at which S fixed and S after one's stays are compared
PERIODS = (0.1, 10.0)  # s, between two draws of P_g
CHANCE = 0.05  # p-value from which on a difference is put down to chance
NO_REACTION = 1e9  # s, that stand for none in ranks
ANSWERS = {True: "holds", False: "fails", None: "open"}
VARIANTS = {
    "as in the paper": {"strategy__social_weight": 0.0, "strategy__exploration_age": 0.0},
    "talking": {"strategy__social_weight": 0.5, "strategy__exploration_age": 0.0},
    "aged exploration": {"strategy__social_weight": 0.0, "strategy__exploration_age": 3600.0},
}
TOLD = ("subject", "value", "detail")  # fields of an ESTIMATES event, one a time
HEADS = (
    "draw of P_g",
    "",
    "runs",
    "objects per robot",
    "reaction (median)",
    "runs without one",
    "cache at the end",
    "disagreement",
)
Log = Callable[[Row], np.ndarray]  # row -> its EVENTs


def cache_share(events: np.ndarray, window: float = WINDOW) -> np.ndarray:
    """Return the share of actions that used the cache, window by window; actions as in TP-84."""
    used = np.isin(events["kind"], (EventKind.DROPPED, EventKind.PICKED))
    decided = np.isin(events["kind"], (EventKind.HARVESTED, EventKind.STORED, EventKind.BEGAN))
    other = (events["kind"] == EventKind.GAVE_UP) | (decided & (events["subject"] == Label.CORRIDOR))
    place = np.floor(events["cycle"] * CYCLE / window).astype(int)
    count = int(place.max()) + 1
    first, second = (np.bincount(place[chosen], minlength=count) for chosen in (used, other))
    return first / np.maximum(1, first + second)


def reaction_time(events: np.ndarray) -> float:
    """Return the s after the change at which the cache's share has got half way to its last level and stays there.

    Infinite if it does not rise.
    """
    share = cache_share(events)
    change, settled = int(SWITCH / WINDOW), int(SETTLED / WINDOW)
    before, after = share[change - settled : change].mean(), share[-settled:].mean()
    if after <= before:
        return float("inf")
    past = share[change:] > 0.5 * (before + after)
    for k in range(len(past) - STEADY + 1):
        if past[k : k + STEADY].all():
            return (k + 1) * WINDOW
    return float("inf")


def _last_level(events: np.ndarray) -> float:
    return float(cache_share(events)[-int(SETTLED / WINDOW) :].mean())


def spread(events: np.ndarray) -> float:
    """Return how far robots disagree: the spread of their times over their mean, averaged over times and the run.

    Looked at every window from the settling time on, with each robot's times as of its last decision.
    """
    told = events[events["kind"] == EventKind.ESTIMATES]
    robots, found = np.unique(told["robot"]), []
    for moment in np.arange(SETTLED, told["cycle"].max() * CYCLE, WINDOW):
        known = told[told["cycle"] * CYCLE <= moment]
        last = [known[known["robot"] == robot][-1] for robot in robots if (known["robot"] == robot).any()]
        values = np.array([[one[name] for name in TOLD] for one in last], float)
        found.append(float((values.std(axis=0, ddof=1) / values.mean(axis=0)).mean()))
    return float(np.mean(found))


def changes(rows: Sequence[Row], period: float, variant: str) -> list[Row]:
    """Return the runs in which the interfacing time falls from 200 s to 0."""
    return picked(rows, cache__switch_time=SWITCH, strategy__giveup_draw_period=period, **VARIANTS[variant])


def steady(rows: Sequence[Row], time: float, most: float) -> list[Row]:
    """Return the runs without a change at an interfacing time, with S fixed (0) or after one's own stays."""
    return picked(rows, cache__switch_time=-1.0, interfacing_time_s=time, strategy__steepness_most=most)


class Change(NamedTuple):
    """The clean runs of one variant through the change."""

    rows: Sequence[Row]
    reactions: list[float]  # s, infinite if there is none
    spreads: list[float]  # how far robots disagree
    last_levels: list[float]  # share of the cache at the end


def changed(rows: Sequence[Row], log: Log) -> dict[tuple[float, str], Change]:
    """Return what the logs say, for each reading of giving up and each variant that has clean runs."""
    found = {}
    for period in PERIODS:
        for variant in VARIANTS:
            cell = consistent(changes(rows, period, variant))
            if cell:
                logs = [log(row) for row in cell]
                numbers = ([measure(events) for events in logs] for measure in (reaction_time, spread, _last_level))
                found[period, variant] = Change(cell, *numbers)
    return found


def table_of_changes(found: Mapping[tuple[float, str], Change]) -> list[dict[str, Any]]:
    """Return a row for each reading of giving up and each variant: objects, reaction time, disagreement."""
    table: list[dict[str, Any]] = []
    for (period, variant), change in found.items():
        objects, disagreement = mean_of(column(change.rows, "objects_per_robot")), mean_of(change.spreads)
        table.append(
            {"draw_period_s": period, "variant": variant, "runs": len(change.rows)}
            | {"objects_per_robot": objects.value, "low": objects.low, "high": objects.high}
            | {"reaction_median_s": float(np.median(change.reactions))}
            | {"never_reacted": int(np.isinf(change.reactions).sum())}
            | {"disagreement": disagreement.value, "disagreement_low": disagreement.low}
            | {"disagreement_high": disagreement.high, "share_after": float(np.mean(change.last_levels))}
        )
    return table


def steeper_is_no_worse(found: Sequence[tuple[float, Mean, float]]) -> tuple[str, bool | None]:
    """Return words and a verdict on TP-O4: nowhere worse beyond chance, better at one end; open without an end."""
    sure = {time: p_value for time, _, p_value in found}
    worse = [time for time, gain, p in found if gain.value < 0 and p < CHANCE / len(found)]
    better = [time for time, gain, p in found if gain.value > 0 and p < CHANCE and time in (TIMES[0], TIMES[-1])]
    if set(TIMES) - set(sure) or any(gain.number < 4 for _, gain, _ in found):
        return "runs are missing", None
    words = f"worse beyond chance at Π {_times(worse)}, better at the ends {_times(better)}"
    return words, False if worse else True if better else None


def _times(times: Sequence[float]) -> str:
    return ", ".join(f"{time:g}" for time in times) or "none"


def talking_is_quicker(found: Mapping[tuple[float, str], Change], period: float) -> tuple[str, bool | None]:
    """Return words and a verdict on TP-O3: a shorter median reaction and less disagreement (one-sided, 95 %)."""
    silent, talking = (found.get((period, name)) for name in ("as in the paper", "talking"))
    if silent is None or talking is None or min(len(silent.rows), len(talking.rows)) < 2:
        return "runs are missing", None
    medians = [float(np.median(change.reactions)) for change in (talking, silent)]
    ranks = [np.minimum(change.reactions, NO_REACTION) for change in (talking, silent)]
    quicker = float(scipy.stats.mannwhitneyu(*ranks, alternative="less").pvalue)
    closer = float(scipy.stats.ttest_ind(talking.spreads, silent.spreads, equal_var=False, alternative="less").pvalue)
    words = f"reaction {_seconds(medians[0])} against {_seconds(medians[1])} (p {quicker:.2g}), disagreement "
    words += f"{np.mean(talking.spreads):.2f} against {np.mean(silent.spreads):.2f} (p {closer:.2g})"
    if max(quicker, closer) < CHANCE:
        return words, True
    return words, False if max(quicker, closer) > 1 - CHANCE else None


def gains(rows: Sequence[Row]) -> list[tuple[float, Mean, float]]:
    """Return for each interfacing time what S after one's stays brings in objects per robot, and Welch's p."""
    found = []
    for time in TIMES:
        fixed, adapted = (column(consistent(steady(rows, time, most)), "objects_per_robot") for most in (0.0, 10.0))
        if fixed and adapted:
            found.append((time, contrast([adapted, fixed], [1.0, -1.0]), welch(adapted, fixed)))
    return found


def figure_options(rows: Sequence[Row]) -> Chart:
    """Objects per robot with S fixed and after one's own stays."""
    traces = []
    for label, most in (("S = 5", 0.0), ("S after one's own stays", 10.0)):
        cells = [(time, column(consistent(steady(rows, time, most)), "objects_per_robot")) for time in TIMES]
        there = [(time, mean_of(values)) for time, values in cells if values]
        traces.append(Trace(label, [time for time, _ in there], [mean for _, mean in there]))
    kept = consistent(rows)
    note = f"{len(kept)} runs; {len(rows) - len(kept)} with phantom or lost objects left out; bars: 95 % intervals"
    panel = Panel("", "interfacing time Π (s)", "objects per robot", traces)
    return Chart("figure-options", "Adaptive steepness (TP-O4)", note, [panel])


def section(rows: Sequence[Row], log: Log) -> list[str]:
    """Return what the options bring as lines of Markdown."""
    lines = [f"{len(rows)} runs, {len(rows) - len(consistent(rows))} left out. Intervals: 95 %, over runs.", ""]
    lines += ["S after one's own stays in cache booths (TP-O4), against S = 5:", ""]
    lines += ["| Π (s) | objects per robot more | p (Welch) |", "|---|---|---|"]
    for time, gain, p_value in gains(rows):
        lines.append(f"| {time:g} | {gain.value:+.1f} ({gain.low:+.1f} to {gain.high:+.1f}) | {p_value:.2g} |")
    words, verdict = steeper_is_no_worse(gains(rows))
    lines += ["", f"Nowhere worse and better at one end: **{ANSWERS[verdict]}**; {words}."]
    lines += ["", "Talking (TP-O3) and aged exploration (TP-O5), Π from 200 to 0 s at half time:", ""]
    lines += [f"| {' | '.join(HEADS)} |", "|---" * len(HEADS) + "|"]
    found = changed(rows, log)
    for row in table_of_changes(found):
        objects = f"{row['objects_per_robot']:.0f} ({row['low']:.0f} to {row['high']:.0f})"
        apart = f"{row['disagreement']:.2f} ({row['disagreement_low']:.2f} to {row['disagreement_high']:.2f})"
        lines.append(
            f"| {row['draw_period_s']:g} s | {row['variant']} | {row['runs']} | {objects} "
            f"| {_seconds(row['reaction_median_s'])} | {row['never_reacted']} "
            f"| {100 * row['share_after']:.0f} % | {apart} |"
        )
    lines.append("")
    for period in PERIODS:
        words, verdict = talking_is_quicker(found, period)
        lines.append(f"- Talking is quicker and agrees more, draw every {period:g} s: **{ANSWERS[verdict]}**; {words}.")
    return lines


def _seconds(time: float) -> str:
    return "none" if np.isinf(time) else f"{time:.0f} s"

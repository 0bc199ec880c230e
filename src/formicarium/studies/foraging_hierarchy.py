"""A tree of tasks between a cheap and a dear cache (TP-O2): does the swarm cut at the cheap one only?"""

from collections.abc import Sequence
from typing import NamedTuple

from formicarium.statistics.means import Mean, mean_of
from formicarium.studies.chart import Chart, Panel, Trace
from formicarium.studies.foraging import Row, column, consistent, picked

PERIODS = (0.1, 10.0)  # s, between two draws of P_g
DEAR = (200.0, -200.0)  # s, by which the second cache takes longer than the first
HALF = 0.5  # of the decisions beside a cache: chosen more often, it is where the task is cut (as AC-12)
CACHES = ("first", "second")
HEADS = (
    "Π (s), first and second",
    "runs",
    "left out",
    "objects per robot",
    "first cache chosen",
    "second chosen",
    "objects over the first",
    "over the second",
)


class Cell(NamedTuple):
    """Runs that differ in their seed alone."""

    method: str  # as a reader calls it
    times: tuple[float, float]  # s, of the two caches
    rows: Sequence[Row]


def cells(rows: Sequence[Row]) -> list[Cell]:
    """Return the cells that have runs: the references, then the tree for each draw of P_g and dear cache."""
    found = [
        Cell(method, (0.0, 200.0), picked(rows, method=method, strategy__hierarchical=False))
        for method in ("never", "always")
    ]
    found += [
        Cell(f"tree, draw every {period:g} s", (max(0.0, -extra), max(0.0, extra)), trees(rows, period, extra))
        for period in PERIODS
        for extra in DEAR
    ]
    return [cell for cell in found if cell.rows]


def trees(rows: Sequence[Row], period: float, extra: float) -> list[Row]:
    """Return the runs of the tree with one draw of P_g and one dear cache."""
    return picked(rows, strategy__hierarchical=True, strategy__giveup_draw_period=period, cache__second_extra=extra)


def chosen(rows: Sequence[Row], cache: str) -> Mean:
    """Return the share of decisions beside a cache in which it was chosen."""
    return mean_of(column(consistent(rows), f"chosen_{cache}"))


def cuts_at_the_cheap_one_only(rows: Sequence[Row], period: float) -> tuple[str, bool | None]:
    """Return words and a verdict: the cheap cache is chosen in more than half of the decisions, the dear one in fewer.

    Open where an interval leaves it so, or runs are missing.
    """
    said, verdicts = [], []
    for extra in DEAR:
        cell = consistent(trees(rows, period, extra))
        if len(cell) < 2:
            return f"runs are missing (draw every {period:g} s)", None
        cheap, dear = (chosen(cell, cache) for cache in (CACHES if extra > 0 else CACHES[::-1]))
        name = "first" if extra > 0 else "second"
        said.append(f"the {name} cache cheap: chosen {_percent(cheap)}, the dear one {_percent(dear)}")
        for share in (cheap, Mean(1 - dear.value, 1 - dear.high, 1 - dear.low, dear.number)):
            verdicts.append(True if share.low > HALF else False if share.high < HALF else None)
    return "; ".join(said), False if False in verdicts else None if None in verdicts else True


def figure_hierarchy(rows: Sequence[Row]) -> Chart:
    """How often each cache is chosen beside it, against by how much the second is the dearer one."""
    traces = []
    for period in PERIODS:
        for cache in CACHES:
            there = [(extra, consistent(trees(rows, period, extra))) for extra in sorted(DEAR)]
            there = [(extra, cell) for extra, cell in there if cell]
            means = [_percentage(chosen(cell, cache)) for _, cell in there]
            traces.append(Trace(f"{cache} cache, draw every {period:g} s", [extra for extra, _ in there], means))
    kept = consistent(rows)
    note = f"{len(kept)} runs; {len(rows) - len(kept)} with phantom or lost objects left out; bars: 95 % intervals"
    panel = Panel("", "Π of the second cache less that of the first (s)", "chosen (% of decisions)", traces)
    return Chart("figure-hierarchy", "A tree of tasks (TP-O2)", note, [panel])


def section(rows: Sequence[Row]) -> list[str]:
    """Return table and verdicts as lines of Markdown."""
    lines = [f"| | {' | '.join(HEADS)} |", "|---" * (len(HEADS) + 1) + "|"]
    for cell in cells(rows):
        kept = consistent(cell.rows)
        out = len(cell.rows) - len(kept)
        start = f"| {cell.method} | {cell.times[0]:g}, {cell.times[1]:g} | {len(cell.rows)} | {out} |"
        if not kept:
            lines.append(f"{start} | | | | |")
            continue
        objects = mean_of(column(kept, "objects_per_robot"))
        over = [mean_of(column(kept, f"over_{name}")) for name in CACHES]
        parts = [f"{objects.value:.0f} ({objects.low:.0f} to {objects.high:.0f})"]
        parts += [_percent(chosen(kept, name)) for name in CACHES] + [_percent(mean) for mean in over]
        lines.append(f"{start} {' | '.join(parts)} |")
    lines.append("")
    for period in PERIODS:
        words, verdict = cuts_at_the_cheap_one_only(rows, period)
        answer = "open" if verdict is None else "holds" if verdict else "fails"
        lines.append(f"- Cut at the cheap cache only, draw every {period:g} s: **{answer}**; {words}.")
    return lines


def _percent(mean: Mean) -> str:
    return f"{100 * mean.value:.0f} % ({100 * mean.low:.0f} to {100 * mean.high:.0f})"


def _percentage(mean: Mean) -> Mean:
    return Mean(100 * mean.value, 100 * mean.low, 100 * mean.high, mean.number)

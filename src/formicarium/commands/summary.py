"""What a set of runs showed, in a few lines."""

from collections import Counter
from collections.abc import Sequence
from pathlib import Path

from rich.console import Console
from rich.table import Table

from formicarium.campaigns.runner import SetReport
from formicarium.campaigns.store import Store
from formicarium.campaigns.table import Row
from formicarium.statistics.compare import log_rank
from formicarium.statistics.intervals import wilson
from formicarium.statistics.runtimes import RunTimes, in_words, run_times
from formicarium.systems.registry import System

# Outcome column: when the run ended, seconds. Without it the cap of the published runs counts.
END = "duration_s"
# Outcome column: why the run did not do all it should.
CAUSE = "cause"


def measured(system: System, rows: Sequence[Row]) -> dict[str, RunTimes]:
    """Return the run-time distribution of every target, by label."""
    if not rows:
        return {}
    ends = [_number(row.get(END)) or system.targets.published_cap for row in rows]
    return {
        label: run_times([_number(row.get(column)) for row in rows], ends)
        for column, label in system.targets.columns.items()
    }


def published(system: System) -> dict[str, RunTimes]:
    """Return the run-time distribution of the published runs, by label of the target."""
    targets = system.targets
    return {
        targets.columns[column]: run_times(times, [targets.published_cap] * len(times))
        for column, times in targets.published.items()
        if column in targets.columns and times
    }


def against_published(system: System, rows: Sequence[Row]) -> dict[str, float]:
    """Return, by label, the p-value of the log-rank test of our run times against the published ones."""
    targets = system.targets
    ends = [_number(row.get(END)) or targets.published_cap for row in rows]
    return {
        targets.columns[column]: log_rank(
            [_number(row.get(column)) for row in rows], ends, times, [targets.published_cap] * len(times)
        ).p_value
        for column, times in targets.published.items()
        if column in targets.columns and times
    }


def print_summary(
    console: Console,
    system: System,
    store: Store,
    seeds: Sequence[int],
    report: SetReport,
    folder: Path,
    pictures: Sequence[Path],
    targets: bool = True,
) -> None:
    """Print targets (if wanted) with intervals and published medians, causes of failure, and where everything is."""
    rows = store.rows_of(seeds)
    loaded = f", {len(report.loaded)} of them loaded" if report.loaded else ""
    failed = f", {len(report.failures)} failed" if report.failures else ""
    span = f"seed {seeds[0]}" if len(seeds) == 1 else f"seeds {seeds[0]} to {seeds[-1]}"
    console.print(
        f"[bold]{system.name}[/bold]: {len(rows)} of {len(seeds)} run{'s' * (len(seeds) > 1)} done "
        f"({span}{loaded}{failed})",
        highlight=False,
    )
    if rows and targets:
        console.print(_one_run(system, rows[0]) if len(seeds) == 1 else _targets(system, rows))
        _print_causes(console, rows)
        if system.targets.published:
            console.print(f"published medians: {system.targets.published_label}", highlight=False, soft_wrap=True)
            if len(rows) > 1:
                console.print("p: log-rank test of our run times against the published ones", highlight=False)
    console.print(f"results   {folder}", highlight=False, soft_wrap=True)
    for path in pictures:
        console.print(f"          {path}", highlight=False, soft_wrap=True)


def _targets(system: System, rows: Sequence[Row]) -> Table:
    table = _table("target", "reached", "share", "95 % interval", "median", "published", "p")
    paper, p_values = published(system), against_published(system, rows)
    for label, times in measured(system, rows).items():
        share = wilson(times.reached, times.runs)
        theirs = in_words(paper[label].median) if label in paper else ""
        interval = f"{share.low:.0%} to {share.high:.0%}"
        reached = f"{times.reached} of {times.runs}"
        p_value = f"{p_values[label]:.2g}" if label in p_values else ""
        table.add_row(label, reached, f"{share.value:.0%}", interval, in_words(times.median), theirs, p_value)
    return table


def _one_run(system: System, row: Row) -> Table:
    table = _table("target", "time", "published")
    paper = published(system)
    for label, times in measured(system, [row]).items():
        table.add_row(label, in_words(times.median), in_words(paper[label].median) if label in paper else "")
    return table


def _table(*titles: str) -> Table:
    table = Table(box=None, pad_edge=False, padding=(0, 2, 0, 0))
    for title in titles:
        table.add_column(title, justify="left" if title == "target" else "right")
    return table


def _print_causes(console: Console, rows: Sequence[Row]) -> None:
    causes = Counter(str(row[CAUSE]) for row in rows if row.get(CAUSE))
    for cause, count in causes.most_common():
        console.print(f"not done  {count} of {len(rows)}: {cause}", highlight=False)


def _number(value: object) -> float | None:
    return float(value) if isinstance(value, int | float) else None

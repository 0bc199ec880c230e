"""Figures from Python."""

from collections.abc import Mapping, Sequence
from pathlib import Path

from formicarium.commands.calls.results import Results
from formicarium.commands.summary import measured, published
from formicarium.statistics.runtimes import RunTimes, run_times
from formicarium.views.runtimes import draw_run_times


def plot_run_times(
    runs: Results | Mapping[str, tuple[Sequence[float | None], Sequence[float]]], path: str | Path, *, title: str = ""
) -> Path:
    """Draw run-time distributions: the share of runs that had reached a target by time t, with a 95 % band.

    Args:
        runs: results of a system, drawn for each of its targets beside the published ones; or label -> (times,
            ends), seconds, with None, nan or inf for a target that was not reached before the end.
        path: of the picture: .png, .svg or .pdf.
        title: above the picture.

    Returns:
        The path.

    Raises:
        ValueError: if there are no runs, or the system names no targets.
        StoreError: if the file cannot be written.
    """
    if not isinstance(runs, Results):
        curves: dict[str, RunTimes] = {label: run_times(times, ends) for label, (times, ends) in runs.items()}
        return draw_run_times(curves, {}, Path(path), title=title)
    found = measured(runs.system, runs.table.to_pylist())
    if not found:
        raise ValueError(f"{runs.folder}: no runs, or {runs.system.name} names no columns with run times")
    label = runs.system.targets.published_label
    return draw_run_times(found, published(runs.system), Path(path), title=title, published_label=label)

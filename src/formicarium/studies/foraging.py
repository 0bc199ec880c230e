"""The partitioning study's runs, picked and summed up."""

from collections.abc import Iterable, Mapping, Sequence
from typing import Any, NamedTuple

from formicarium.statistics.means import Mean, mean_of

METHODS = ("never", "always", "adaptive")
TIMES = (0.0, 25.0, 50.0, 75.0, 100.0, 150.0, 200.0)  # s, of Fig. 7
HOURS = 16  # full windows of a run of 60,000 s; a 17th holds the last 40 minutes
SWITCH = 30000.0  # s

Row = Mapping[str, Any]


class Runs(NamedTuple):
    """The rows of the study's campaigns; any of them may be empty."""

    performance: Sequence[Row]
    adaptivity: Sequence[Row] = ()
    scalability: Sequence[Row] = ()
    anova: Sequence[Row] = ()
    crowds: Sequence[Row] = ()  # those of several sizes again, with those that are left out


def picked(rows: Iterable[Row], **wanted: Any) -> list[Row]:
    """Return the rows whose columns have these values; "cache__switched_time" stands for "cache.switched_time"."""
    return [row for row in rows if all(row.get(name.replace("__", ".")) == value for name, value in wanted.items())]


def consistent(rows: Iterable[Row]) -> list[Row]:
    """Return the runs without phantom or lost objects: the paper shows no others (TP-46)."""
    return [row for row in rows if row["consistent"] == 1]


def column(rows: Iterable[Row], name: str) -> list[float]:
    """Return the numbers of a column, without those that are missing."""
    return [float(row[name]) for row in rows if row[name] is not None]


def mean(rows: Iterable[Row], name: str) -> Mean | None:
    """Return the mean of a column with its interval, None if there is nothing."""
    values = column(rows, name)
    return mean_of(values) if values else None


def share_by_hour(row: Row) -> list[tuple[float, float]]:
    """Return for each window of an hour the shares of cache and corridor; giving up counts as corridor (TP-82)."""
    numbers = [[int(n) for n in str(row[f"{name}_by_hour"]).split()] for name in ("used", "gave_up", "corridor")]
    shares = []
    for used, gave_up, corridor in zip(*numbers, strict=True):
        total = max(1, used + gave_up + corridor)
        shares.append((used / total, (gave_up + corridor) / total))
    return shares


def cells_of(rows: Sequence[Row], factors: Sequence[str]) -> list[dict[str, Any]]:
    """Return a table of cells: factors, runs, excluded runs, and objects per robot with and without those."""
    keys = list(dict.fromkeys(tuple(row.get(name) for name in factors) for row in rows))
    table = []
    for key in keys:
        cell = [row for row in rows if tuple(row.get(name) for name in factors) == key]
        clean, everything = mean(consistent(cell), "objects_per_robot"), mean(cell, "objects_per_robot")
        assert everything is not None
        table.append(
            dict(zip(factors, key, strict=True))
            | {
                "runs": len(cell),
                "excluded": len(cell) - len(consistent(cell)),
                "phantoms": sum(row["phantoms"] for row in cell),
                "lost": sum(row["lost"] for row in cell),
                "objects_per_robot": None if clean is None else clean.value,
                "low": None if clean is None else clean.low,
                "high": None if clean is None else clean.high,
                "objects_per_robot_all_runs": everything.value,
                "share_used": _average(cell, "share_used"),
                "share_gave_up": _average(cell, "share_gave_up"),
                "share_corridor": _average(cell, "share_corridor"),
                "whole_mean_s": _average(cell, "whole_mean_s"),
                "harvest_mean_s": _average(cell, "harvest_mean_s"),
                "store_mean_s": _average(cell, "store_mean_s"),
                "escapes_per_robot_hour": _average(cell, "escapes")
                / (cell[0]["robots"] * cell[0]["duration_s"] / 3600.0),
            }
        )
    return table


def _average(rows: Sequence[Row], name: str) -> float:
    values = column(rows, name)
    return sum(values) / len(values) if values else float("nan")

"""Tables and figures of the study of task schedules."""

import statistics
from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np

from formicarium.scheduling.generator import CLASSES as KINDS
from formicarium.scheduling.generator import DENSITIES
from formicarium.statistics.means import Mean
from formicarium.studies.chart import Chart, Panel, Spread, Trace
from formicarium.studies.scheduling import CLASSES, PAPER, Row

KEYS = ("class", "density", "tasks")


class Cell(NamedTuple):
    """What came of the instances of one combination of factors."""

    factors: Mapping[str, Any]
    rows: Sequence[Row]

    @property
    def proven(self) -> int:
        """How many were proven."""
        return sum(row["ended"] == "proven" for row in self.rows)

    def content(self, objective: str) -> dict[str, Any]:
        """Return a row of the table of cells, the paper's mean beside ours where it has one."""
        seconds = [row["seconds"] for row in self.rows]
        open_gaps = [row["gap"] for row in self.rows if row["ended"] != "proven"]
        paper = PAPER[objective].get(self.factors["class"])
        return {
            **self.factors,
            "instances": len(self.rows),
            "proven": self.proven,
            "mean_s": statistics.fmean(seconds),
            "median_s": statistics.median(seconds),
            "worst_s": max(seconds),
            "paper_mean_s": paper and paper[DENSITIES.index(self.factors["density"])],
            "without_schedule": sum(row["faults"] is None for row in self.rows),
            "median_gap_of_open": statistics.median(open_gaps or [0.0]),
            "worst_gap": max(row["gap"] for row in self.rows),
        }


def grid(rows: Sequence[Row]) -> list[Cell]:
    """Return the cells that have instances, in the order of their factors."""
    names = [name for name in KEYS if rows and name in rows[0]]
    found: dict[tuple, list[Row]] = {}
    for row in rows:
        found.setdefault(tuple(row[name] for name in names), []).append(row)
    return [Cell(dict(zip(names, key)), found[key]) for key in sorted(found)]


def figure_7(rows: Sequence[Row]) -> Chart:
    """Return how much shorter the trip between deployment points becomes, class by class (Fig. 7)."""
    return _reduction(rows, "7", "trip_m", "time_trip_m", "trip between deployment points saved, %")


def figure_8(rows: Sequence[Row]) -> Chart:
    """Return how much shorter the arms become, class by class (Fig. 8)."""
    return _reduction(rows, "8", "relays", "time_relays", "relays of the arms saved, %")


def _reduction(rows: Sequence[Row], name: str, after: str, before: str, up: str) -> Chart:
    panels = []
    for number in CLASSES:
        spreads = []
        for density in DENSITIES:
            chosen = [row for row in rows if (row["class"], row["density"]) == (number, density) and row[before] > 0]
            saved = [100.0 * (1.0 - row[after] / row[before]) for row in chosen]
            if saved:
                shares = [float(share) for share in np.percentile(saved, (5, 25, 50, 75, 95))]
                spreads.append(Spread(f"{density:g}", shares))
        if spreads:
            panels.append(Panel(f"class {number}", "density D", up, spreads=spreads))
    note = f"{len(rows)} instances; against the schedule of least time with relays as few as its points allow"
    return Chart(f"figure-{name}", f"Least dislocation against least time (Fig. {name})", note, panels)


def improved(rows: Sequence[Row], after: str, before: str) -> tuple[int, int]:
    """Return how many instances got better and how many there are."""
    return sum(row[after] < row[before] - 1e-9 for row in rows), len(rows)


def beside(ours: Sequence[Row], model: Sequence[Row]) -> list[dict[str, Any]]:
    """Return the instances that both solved: the exact method, and the paper's model in HiGHS."""
    found = {_instance(row): row for row in ours}
    table = []
    for row in model:
        if mine := found.get(_instance(row)):
            table.append(
                {"class": row["class"], "density": row["density"], "seed": row["seed"]}
                | {f"ours_{name}": mine[name] for name in ("ended", "value", "bound", "seconds")}
                | {f"model_{name}": row[name] for name in ("ended", "value", "bound", "seconds")}
            )
    return table


def _instance(row: Row) -> tuple[int, float, int]:
    return row["class"], row["density"], row["seed"]


def figure_scale(rows: Sequence[Row]) -> Chart:
    """Return seconds and gaps against the number of tasks, a line a class."""
    panels = []
    for name, up, scale in (
        ("seconds", "seconds of the processor", 1.0),
        ("gap", "gap between schedule and bound, %", 100.0),
    ):
        traces = []
        for number in sorted({row["class"] for row in rows}):
            chosen = sorted((row["tasks"], scale * row[name]) for row in rows if row["class"] == number)
            means = [Mean(value, value, value, 1) for _, value in chosen]
            robots = KINDS[number].robots
            traces.append(Trace(f"{robots} robots", [tasks for tasks, _ in chosen], means))
        panels.append(Panel("", "tasks", up, traces))
    return Chart("figure-scale", "Least time: cost against tasks and robots", "one instance a point, D = 0.05", panels)

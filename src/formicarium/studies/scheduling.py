"""The published study of task schedules: six densities, five classes, 24 instances each, for both objectives.

A run is an instance; its seed draws it. Times are those of the processor, one core, so that a busy machine does not
change them.
"""

import statistics
from collections.abc import Mapping, Sequence
from functools import partial
from importlib.metadata import version
from typing import Any, Literal, NamedTuple

import numpy as np

from formicarium.campaigns.cells import Job, cells_of
from formicarium.campaigns.configuration import Configuration
from formicarium.campaigns.design import Design, make_design
from formicarium.campaigns.errors import Futile
from formicarium.campaigns.result import Result, Watch
from formicarium.compiled import room_hash
from formicarium.scheduling.checker import check
from formicarium.scheduling.generator import DENSITIES, draw_instance
from formicarium.scheduling.schedule import Answer, Schedule
from formicarium.scheduling.solver import shorten, solve
from formicarium.studies.chart import Chart, Panel, Spread

Objective = Literal["time", "travel"]
Row = Mapping[str, Any]
CLASSES = (1, 2, 3, 4, 5)
FIRST_SEED, INSTANCES = 200_001, 24
LIMIT = 60.0  # s of the processor for each of the two problems
ROOM = "scheduling"
# Table II: mean seconds of CPLEX 12.7 with 8 threads; 10800 is its limit
PAPER = {
    "time": {
        1: (908.1, 206.4, 15.3, 7.0, 4.9, 0.8),
        2: (210.7, 62.8, 3.8, 3.6, 2.8, 0.7),
        3: (1488.4, 479.6, 13.6, 12.2, 1.7, 1.9),
        4: (1362.1, 202.2, 27.9, 44.8, 2.1, 3.3),
        5: (8038.6, 9626.5, 6350.4, 1006.1, 134.1, 9.0),
    },
    "travel": {
        1: (2455.4, 1657.7, 811.8, 488.0, 2254.3, 44.3),
        2: (1036.9, 1111.5, 530.8, 174.2, 2332.1, 50.5),
        3: (2817.4, 1998.0, 524.9, 1338.8, 772.1, 1049.3),
        4: (4890.9, 2200.1, 781.1, 2149.4, 1249.0, 1453.8),
        5: (10800.0, 10800.0, 10800.0, 10094.7, 5719.1, 31.6),
    },
}


def design_of(objective: Objective, runs: int | None) -> Design:
    """Return the study as a table: a cell for each class and density."""
    content = {
        "name": f"scheduling-{objective}",
        "system": ROOM,
        "replicates": runs or INSTANCES,
        "first_seed": FIRST_SEED,
        "factors": {"class": list(CLASSES), "density": list(DENSITIES)},
    }
    return make_design(content, f"study scheduling, {objective}")


def jobs_of(objective: Objective, runs: int | None) -> list[Job]:
    """Return the cells, ready to run."""
    jobs = []
    for cell in cells_of(design_of(objective, runs)):
        parameters = {**cell.said, "objective": objective, "reach": "printed", "first_hop": "free", "limit_s": LIMIT}
        configuration = Configuration(ROOM, parameters, room_hash(ROOM), version("formicarium"))
        function = partial(solve_one, int(cell.said["class"]), float(cell.said["density"]), objective,
                           configuration.sources)  # fmt: skip
        jobs.append(Job(cell, configuration, function))
    return jobs


class ChangedSources(Futile):
    """A worker found other sources than those that the rows stand for."""


def solve_one(
    number: int, density: float, objective: Objective, sources: str, seed: int, watch: Watch | None
) -> Result:
    """Solve one instance as the paper prints it: its octagon, its first hop free."""
    if room_hash(ROOM) != sources:
        raise ChangedSources("the sources were edited while the study ran; run the same command again")
    instance = draw_instance(number, density, seed)
    answer = solve(instance, "time", "printed", LIMIT, processor_time=True)
    assert answer.schedule is not None
    row: dict[str, Any] = {"class": number, "density": density}
    if objective == "travel":
        raw = answer.schedule
        row |= {"time_trip_m": raw.trip, "time_relays": raw.relays, "time_proven": answer.proven}
        answer = shorten(instance, raw, "printed", LIMIT, charge_first=False, processor_time=True)
    assert answer.schedule is not None
    return Result(row | _row(instance, answer, answer.schedule), {})


def _row(instance: Any, answer: Answer, schedule: Schedule) -> dict[str, Any]:
    verdict = check(instance, schedule, "printed", answer.time_limit)
    return {
        "ended": answer.ended,
        "value": answer.value,
        "bound": answer.bound,
        "gap": answer.gap,
        "proof": answer.proof,
        "seconds": answer.seconds,
        "slots": len(schedule.slots),
        "completion_time": verdict.time,
        "trip_m": verdict.trip,
        "relays": verdict.relays,
        "first_trip_m": verdict.first_trip,
        "arms_over_radio": verdict.over_radio,
        "faults": len(verdict.faults),
    }


class Cell(NamedTuple):
    """What came of the instances of one class and density."""

    number: int
    density: float
    rows: Sequence[Row]

    @property
    def proven(self) -> int:
        """How many were proven."""
        return sum(row["ended"] == "proven" for row in self.rows)

    def content(self, objective: Objective) -> dict[str, Any]:
        """Return a row of the table of cells, the paper's mean beside ours."""
        seconds = [row["seconds"] for row in self.rows]
        open_gaps = [row["gap"] for row in self.rows if row["ended"] != "proven"]
        return {
            "class": self.number,
            "density": self.density,
            "instances": len(self.rows),
            "proven": self.proven,
            "mean_s": statistics.fmean(seconds),
            "median_s": statistics.median(seconds),
            "worst_s": max(seconds),
            "paper_mean_s": PAPER[objective][self.number][DENSITIES.index(self.density)],
            "median_gap_of_open": statistics.median(open_gaps or [0.0]),
            "worst_gap": max(row["gap"] for row in self.rows),
        }  # fmt: skip


def grid(rows: Sequence[Row]) -> list[Cell]:
    """Return the cells that have instances, in the order of Table II."""
    keys = [(number, density) for number in CLASSES for density in DENSITIES]
    found = [Cell(n, d, [row for row in rows if (row["class"], row["density"]) == (n, d)]) for n, d in keys]
    return [cell for cell in found if cell.rows]


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

"""The study of task schedules: six densities, five classes, 24 instances each, for both objectives; then larger ones.

Beside Table II stands the paper's own model, given to HiGHS on one instance in ten. A run is an instance; its seed
draws it. Times are those of the processor, one core, so that a busy machine does not change them.
"""

from collections.abc import Callable, Mapping, Sequence
from functools import partial
from importlib.metadata import version
from typing import Any, NamedTuple

from formicarium.campaigns.cells import Job, cells_of
from formicarium.campaigns.configuration import Configuration
from formicarium.campaigns.design import Design, make_design
from formicarium.campaigns.errors import Futile
from formicarium.campaigns.result import Result, Watch
from formicarium.compiled import room_hash
from formicarium.scheduling.checker import check
from formicarium.scheduling.clock import Clock
from formicarium.scheduling.generator import DENSITIES, draw_instance
from formicarium.scheduling.instance import Instance
from formicarium.scheduling.model import solve_model
from formicarium.scheduling.reach import Reach
from formicarium.scheduling.schedule import Answer
from formicarium.scheduling.solver import RELATIVE_GAP, shorten, solve

Row = Mapping[str, Any]
Solve = Callable[[Instance, float], dict[str, Any]]
CLASSES = (1, 2, 3, 4, 5)
FIRST_SEED, INSTANCES = 200_001, 24
LIMIT = 60.0  # s of the processor for each problem of Table II
ONE_IN = 10  # instances of Table II is given to HiGHS with the paper's model
HUNDRED_SEED, HUNDRED_INSTANCES, HUNDRED_LIMIT = 201_011, 2, 120.0  # a hundred tasks: 48 instances
SCALE_SEED, SCALE_INSTANCES, SCALE_LIMIT = 201_003, 1, 600.0  # up to a thousand
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


class Part(NamedTuple):
    """A campaign of the study."""

    name: str  # after "scheduling-"
    factors: Mapping[str, Sequence[Any]]
    said: Mapping[str, Any]  # the same in every cell
    solve: Solve
    first_seed: int = FIRST_SEED
    instances: int = INSTANCES  # of each cell
    one_in: int = 1  # of all instances in their order is solved

    @property
    def limit(self) -> float:
        """Seconds of the processor for an instance."""
        return float(self.said["limit_s"])

    def design(self, runs: int | None) -> Design:
        """Return the part as a table."""
        content = {
            "name": f"scheduling-{self.name}",
            "system": ROOM,
            "replicates": runs or self.instances,
            "first_seed": self.first_seed,
            "factors": {name: list(levels) for name, levels in self.factors.items()},
        }
        return make_design(content, f"study scheduling, {self.name}")

    def jobs(self, runs: int | None) -> list[Job]:
        """Return the cells, ready to run."""
        jobs, number = [], 0
        for cell in cells_of(self.design(runs)):
            first = cell.number * self.instances
            seeds = [seed for k, seed in enumerate(cell.seeds, first) if k % self.one_in == 0]
            configuration = Configuration(ROOM, {**cell.said, **self.said}, room_hash(ROOM), version("formicarium"))
            function = partial(solve_one, self.name, cell.said, configuration.sources)
            if seeds:
                jobs.append(Job(cell._replace(number=number, seeds=tuple(seeds)), configuration, function))
                number += 1
        return jobs


class ChangedSources(Futile):
    """A worker found other sources than those that the rows stand for."""


def solve_one(part: str, said: Mapping[str, Any], sources: str, seed: int, watch: Watch | None) -> Result:
    """Solve one instance as the paper prints it: its octagon, its first hop free."""
    if room_hash(ROOM) != sources:
        raise ChangedSources("the sources were edited while the study ran; run the same command again")
    number, density = int(said["class"]), float(said["density"])
    instance = draw_instance(number, density, seed, said.get("tasks"))
    return Result({**said, **PARTS[part].solve(instance, PARTS[part].limit)}, {})


def _least_time(instance: Instance, limit: float) -> dict[str, Any]:
    return _row(instance, solve(instance, "time", "printed", limit, processor_time=True))


def _least_travel(instance: Instance, limit: float) -> dict[str, Any]:
    first = solve(instance, "time", "printed", limit, processor_time=True)
    assert first.schedule is not None
    raw = {"time_trip_m": first.schedule.trip, "time_relays": first.schedule.relays, "time_proven": first.proven}
    answer = shorten(instance, first.schedule, "printed", limit, charge_first=False, processor_time=True)
    return raw | _row(instance, answer)


def _paper_time(instance: Instance, limit: float) -> dict[str, Any]:
    """Give HiGHS the paper's model, with as many slots as the best schedule can have: in its favour."""
    first = solve(instance, "time", "printed", limit, processor_time=True)
    return _row(instance, _modelled(instance, first, limit, None))


def _paper_travel(instance: Instance, limit: float) -> dict[str, Any]:
    first = solve(instance, "time", "printed", limit, processor_time=True)
    return _row(instance, _modelled(instance, first, limit, first.value))


def _modelled(instance: Instance, first: Answer, limit: float, time: float | None) -> Answer:
    slots = min(len(instance.tasks), int(first.value / min(task.duration for task in instance.tasks)))
    clock = Clock(limit, None, processor=True)
    value, bound, schedule = solve_model(instance, Reach.PRINTED, clock, slots, time)
    objective, gap = ("time", 1e-9) if time is None else ("travel", RELATIVE_GAP)
    proven = schedule is not None and value - bound <= gap * value
    return Answer(objective, schedule, value, bound, clock.seconds, "HiGHS", "proven" if proven else "time limit", time)


TABLE_2 = {"class": CLASSES, "density": DENSITIES}
AS_PRINTED = {"reach": "printed", "first_hop": "free"}
PARTS = {
    part.name: part
    for part in (
        Part("time", TABLE_2, {"objective": "time", **AS_PRINTED, "limit_s": LIMIT}, _least_time),
        Part("travel", TABLE_2, {"objective": "travel", **AS_PRINTED, "limit_s": LIMIT}, _least_travel),
        Part(
            "paper-time", TABLE_2, {"objective": "time", "solver": "HiGHS", **AS_PRINTED, "limit_s": LIMIT},
            _paper_time, one_in=ONE_IN,
        ),
        Part(
            "paper-travel", TABLE_2, {"objective": "travel", "solver": "HiGHS", **AS_PRINTED, "limit_s": LIMIT},
            _paper_travel, one_in=ONE_IN,
        ),
        Part(
            "hundred-tasks", {"class": (6, 7, 8, 9), "density": DENSITIES},
            {"objective": "time", **AS_PRINTED, "limit_s": HUNDRED_LIMIT}, _least_time, HUNDRED_SEED, HUNDRED_INSTANCES,
        ),
        Part(
            "scale", {"class": (6, 8), "density": (0.05,), "tasks": (50, 100, 200, 500, 1000)},
            {"objective": "time", **AS_PRINTED, "limit_s": SCALE_LIMIT}, _least_time, SCALE_SEED,
            SCALE_INSTANCES,
        ),
    )
}  # fmt: skip


def _row(instance: Instance, answer: Answer) -> dict[str, Any]:
    row: dict[str, Any] = {
        "ended": answer.ended,
        "value": answer.value,
        "bound": answer.bound,
        "gap": answer.gap,
        "proof": answer.proof,
        "seconds": answer.seconds,
    }
    schedule = answer.schedule
    verdict = None if schedule is None else check(instance, schedule, "printed", answer.time_limit)
    return row | {
        "slots": schedule and len(schedule.slots),
        "completion_time": verdict and verdict.time,
        "trip_m": verdict and verdict.trip,
        "relays": verdict and verdict.relays,
        "first_trip_m": verdict and verdict.first_trip,
        "arms_over_radio": verdict and verdict.over_radio,
        "faults": verdict and len(verdict.faults),
    }

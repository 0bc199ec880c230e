"""The cells of a design: every combination of factors that is run, with its seeds."""

import itertools
import json
from collections.abc import Iterable, Mapping
from typing import Any, NamedTuple

from formicarium.campaigns.configuration import Configuration
from formicarium.campaigns.design import Design
from formicarium.campaigns.errors import DesignError
from formicarium.campaigns.result import Function
from formicarium.campaigns.seeds import seeds_of

MOST_RUNS = 1_000_000  # of a design; more is a slip of the pen

Key = tuple[str, int]  # identity of the configuration and seed: what makes a run this run


class Cell(NamedTuple):
    """One combination of factors."""

    number: int  # in the order of the design, from 0
    factors: Mapping[str, Any]
    seeds: tuple[int, ...]  # one a replicate
    said: Mapping[str, Any]  # all that the design says of it: its factors, and what is the same in every cell

    @property
    def label(self) -> str:
        """The factors for people: "speed = 0.1, size = 16"."""
        return ", ".join(f"{name} = {_shown(value)}" for name, value in self.factors.items()) or "as published"


class Job(NamedTuple):
    """A cell that can be run."""

    cell: Cell
    configuration: Configuration
    function: Function

    @property
    def keys(self) -> list[Key]:
        """What its runs are known by, in the order of the replicates."""
        identity = self.configuration.identity
        return [(identity, seed) for seed in self.cell.seeds]


def cells_of(design: Design) -> list[Cell]:
    """Return the cells in order: rows slowest, then the factors as listed, the last one fastest.

    Raises:
        DesignError: if there are too many runs, or two cells are the same.
    """
    size = max(len(design.rows), 1) * design.count
    for levels in design.factors.values():
        size *= len(levels)
    if size > MOST_RUNS:
        raise DesignError(f"the design has {size:,} runs; at most {MOST_RUNS:,}")
    cells: list[Cell] = []
    for row in design.rows or [{}]:
        own: dict[str, Any] = {name: value for name, value in row.items() if name != "first_seed"}
        first = row.get("first_seed")
        assert first is None or isinstance(first, int)
        for values in itertools.product(*design.factors.values()):
            factors = {**own, **dict(zip(design.factors, values))}
            cells.append(Cell(len(cells), factors, seeds_of(design, factors, first), {**design.fixed, **factors}))
    return cells


def check_distinct(jobs: Iterable[Job]) -> None:
    """Make sure that no run is in the design twice.

    Raises:
        DesignError: naming the two cells and a seed that they share.
    """
    found: dict[Key, Cell] = {}
    for job in jobs:
        if len(set(job.cell.seeds)) < len(job.cell.seeds):
            raise DesignError(f"cell {job.cell.number} ({job.cell.label}) has a seed twice")
        for key in job.keys:
            other = found.setdefault(key, job.cell)
            if other is not job.cell:
                raise DesignError(
                    f"cells {other.number} ({other.label}) and {job.cell.number} ({job.cell.label}) are the same runs "
                    f"(seed {key[1]}): remove one of them, or give them seeds of their own"
                )


def _shown(value: Any) -> str:
    return value if isinstance(value, str) else json.dumps(value)

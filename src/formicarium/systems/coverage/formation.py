"""Into what arms grow: stars, as in the paper, or what it names as its future, off by default (ST-74, ST-75)."""

import math
from typing import Any, Literal

from formicarium.systems.coverage.memory import Shape
from formicarium.tables import Table, number

SHAPES = tuple(shape.name.lower() for shape in Shape)
BRANCHES = 7  # of one root at most: a digit of a branch's number
DEPTH = 5  # branchings at most: a branch's number has two bytes


class FormationTable(Table):
    """What every robot is told of the formation before a trial."""

    shape: Literal["star", "fractal"] = number(
        "star", "1", "star: straight arms [paper]; fractal: the tip of an arm with robots to spare branches [ST-75]"
    )
    branch_robots: int = number(2, "1", "of a branch; the last one is the root of the next [choice]", ge=1, le=60)
    branches: int = number(2, "1", "m, that a tip branches into [choice]", ge=1, le=BRANCHES)
    angle: float = number(math.radians(60.0), "rad", "of the outermost to the branch before them [choice]", ge=0)
    ratio: float = number(0.6, "1", "q, of the delta of a branch to that of the one before [ST-75]", gt=0, le=1)
    depth: int = number(2, "1", "branchings between the master and the last tips [ST-75]", ge=1, le=DEPTH)
    queue_share: float = number(0.375, "1", "of delta, between robots to spare at a tip [choice]", gt=0, le=1)
    patience: float = number(5.0, "s", "a robot is to spare for so long before it goes on [choice]", ge=0)


def write_formation(record: Any, formation: FormationTable, cycle_time: float) -> None:
    """Write a FORMATION record."""
    record.shape = SHAPES.index(formation.shape)
    for name in ("branch_robots", "branches", "angle", "ratio", "depth", "queue_share"):
        record[name] = getattr(formation, name)
    record.patience = round(formation.patience / cycle_time)

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

    shape: Literal["star", "fractal", "network"] = number(
        "star",
        "1",
        "star: straight arms [paper]; fractal: the tip of an arm with robots to spare branches [ST-75]; network: it "
        "sends them to the neighbouring arms, as a slime mould does [ST-74]",
    )
    branch_robots: int = number(2, "1", "of a branch; the last one is the root of the next [choice]", ge=1, le=60)
    branches: int = number(2, "1", "fractal: m, that a tip branches into [choice]", ge=1, le=BRANCHES)
    angle: float = number(
        math.radians(60.0), "rad", "fractal: of the outermost to the branch before them [choice]", ge=0
    )
    ratio: float = number(
        0.6, "1", "fractal: q, of the delta of a branch to that of the one before [ST-75]", gt=0, le=1
    )
    depth: int = number(2, "1", "fractal: branchings between the master and the last tips [ST-75]", ge=1, le=DEPTH)
    queue_share: float = number(0.375, "1", "of delta, between robots to spare at a tip [choice]", gt=0, le=1)
    patience: float = number(5.0, "s", "a robot is to spare for so long before it goes on [choice]", ge=0)
    flux_power: float = number(2.0, "1", "network: m of dC/dt = |Q|^m / (1 + |Q|^m) - C [choice ST-74]", gt=0, le=9)
    tube_time: float = number(60.0, "s", "network: unit of time of that rule [choice]", gt=0)
    thinnest: float = number(0.1, "1", "network: a tube of a smaller conductance withers [choice]", gt=0, lt=0.3)


def write_formation(record: Any, formation: FormationTable, cycle_time: float) -> None:
    """Write a FORMATION record."""
    record.kind = SHAPES.index(formation.shape)
    for name in ("branch_robots", "branches", "angle", "ratio", "depth", "queue_share", "flux_power", "thinnest"):
        record[name] = getattr(formation, name)
    if formation.shape == "network":
        record.depth = 1  # tubes do not branch
    record.patience = round(formation.patience / cycle_time)
    record.tube_cycles = formation.tube_time / cycle_time

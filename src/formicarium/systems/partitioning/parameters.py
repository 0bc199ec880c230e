"""Every number of the partitioning system, with unit, bounds and reason.

[paper]: Pini et al., "Task partitioning in swarms of robots: an adaptive method for strategy selection", IRIDIA
technical report 2011-013. TP-.., U..: numbered statements and choices where the paper is silent. [tuned]: found by
calibrating the reference methods only, see docs/results/partitioning.md.
"""

import math
from typing import Any, Literal

import numpy as np
from pydantic import BaseModel, ConfigDict, Field, model_validator

from formicarium.robots.epuck import PINI_2011, Epuck, EpuckSight
from formicarium.tables import Table, number


class ArenaTable(Table):
    """The rectangle, what stands in it and the shades of its floor (Fig. 6, TP-50 to TP-55).

    The arena is its own mirror image about the upright line through its middle; the numbers are of the source's half.
    """

    width: float = number(1.6, "m", "[paper]; which side is 1.6 m is not said: upright here [choice TP-51]", gt=1, le=5)
    height: float = number(2.1, "m", "[paper]", gt=1, le=5)
    booth_pitch: float = number(0.15, "m", "from one booth to the next [choice TP-51]", ge=0.12, le=0.5)
    terminal_booths: int = number(4, "1", "of the source, and of the nest [paper]", ge=1, le=6)
    cache_pairs: int = number(3, "1", "[paper]", ge=1, le=6)
    terminal_top: float = number(0.10, "m", "first booth of source and nest, below the top wall [choice]", ge=0.06)
    cache_top: float = number(0.175, "m", "first pair of the cache, below the top wall [choice]", ge=0.06)
    cache_depth: float = number(0.24, "m", "two booths back to back [choice]", ge=0.24, le=1)
    leg_width: float = number(0.50, "m", "of the corridor's upright parts [choice]", gt=0.1)
    bottom_width: float = number(0.45, "m", "of its part along the bottom wall [choice]", gt=0.1)
    block_top: float = number(1.45, "m", "of the solid block between the areas and the corridor [choice]", gt=0.2)
    zone_depth: float = number(0.25, "m", "of the cache's access zone [choice TP-54]", gt=0.05)
    path_width: float = number(0.08, "m", "[choice TP-54]", gt=0.02)
    lamp_intensity: float = number(5.0, "m", "its light falls to e^-2 at this distance [choice]", gt=0)
    source_shade: float = number(0.86, "1", "of the source area; all shades are 0.12 apart [choice TP-54]")
    drop_zone_shade: float = number(0.74, "1", "before the cache, source side")
    left_leg_shade: float = number(0.62, "1", "corridor, source side")
    bottom_shade: float = number(0.50, "1", "corridor, bottom")
    right_leg_shade: float = number(0.38, "1", "corridor, nest side")
    pick_zone_shade: float = number(0.26, "1", "before the cache, nest side")
    nest_shade: float = number(0.14, "1", "of the nest area")
    path_shade: float = number(1.0, "1", "of the path, which runs through the corridor only")
    friction: float = number(0.1, "1", "of walls and booths; matters with contact dynamics only [model]", ge=0)

    # Beyond the paper.
    subtasks: int = number(
        2, "1", "areas in a row, a cache between neighbours; 3: as many sub-tasks, width grows [TP-O1]", ge=2, le=3
    )
    middle_width: float = number(0.80, "m", "of the area between two caches [choice]", ge=0.6, le=2)


# Rows: the arena lying on its side.
LANDSCAPE = {
    "width": 2.1,
    "height": 1.6,
    "leg_width": 0.60,
    "bottom_width": 0.40,
    "block_top": 0.95,
}


class SwarmTable(Table):
    """How many robots, how long, how they move, and which of them die."""

    robots: int = number(10, "1", "N [paper]", ge=1, le=60)
    time_cap: float = number(60000.0, "s", "length of a run: 600,000 steps of 0.1 s [paper]", gt=0, le=1e6)
    cycle_time: float = number(0.1, "s", "one step [paper]", ge=0.01, le=1)
    dynamics: Literal["kinematic", "contact"] = number(
        "kinematic", "1", "kinematic: nobody is pushed [paper]; contact: masses, pushing and friction"
    )
    failure_rate: float = number(0.0, "1/s", "rate at which a robot dies; the paper has none", ge=0, le=10)
    log_decisions: bool = number(False, "1", "log every decision with its probability, and every wait (large)")

    @classmethod
    def layout(cls) -> np.dtype:
        """Return the layout with the kind of dynamics as a switch."""
        return np.dtype([*_fields(super().layout()), ("contact", "i8")], align=True)

    def record(self) -> np.recarray:
        """Return the numbers as a record."""
        record = _record(self)
        record[0].contact = self.dynamics == "contact"
        return record


class CacheTable(Table):
    """Interfacing times."""

    interfacing_time: float = number(
        0.0, "s", "Pi, spent in a cache booth to drop and to pick up; 0 to 200 in the paper [paper]", ge=0, le=10000
    )
    taking_extra: float = number(
        0.0, "s", "Pi_2 - Pi_1: picking up takes so much longer [paper: 0]", ge=-10000, le=10000
    )
    second_extra: float = number(
        0.0,
        "s",
        "the second cache takes so much longer than the first, with arena.subtasks 3 [TP-O2]",
        ge=-10000,
        le=10000,
    )
    switch_time: float = number(
        -1.0, "s", "from here on switched_time holds; negative: never; paper: half of the run", ge=-1
    )
    switched_time: float = number(0.0, "s", "Pi after the switch [paper: 0 or 200]", ge=0, le=10000)

    @model_validator(mode="after")
    def no_time_runs_backwards(self) -> "CacheTable":
        """Refuse times that the extra ones make negative."""
        least = min(self.interfacing_time, self.switched_time if self.switch_time >= 0 else math.inf)
        if least + self.taking_extra < 0:
            raise ValueError("taking_extra makes the time of picking up negative")
        if least + self.second_extra + min(0.0, self.taking_extra) < 0:
            raise ValueError(
                f"second_extra {self.second_extra:g} makes a time of the second cache negative: "
                f"at least {-least - min(0.0, self.taking_extra):g}"
            )
        return self


METHODS = ("adaptive", "never", "always")
NEVER_PARTITION, ALWAYS_PARTITION = METHODS.index("never"), METHODS.index("always")
MODES = ("per_draw", "threshold")


class StrategyTable(Table):
    """The method: when to partition, when to give up (equations 1 to 4)."""

    method: Literal["adaptive", "never", "always"] = number(
        "adaptive", "1", "never: P_p = 0; always: P_p = 1 and nobody gives up [paper]"
    )
    alpha: float = number(0.8, "1", "weight of a new measurement, equation 2 [paper]", gt=0, le=1)
    steepness: float = number(5.0, "1", "S, equation 1 [paper]", ge=0, le=1000)
    giveup_steepness: float = number(-0.5, "1", "K, equation 4 [paper]", ge=-1000, lt=0)
    giveup_offset: float = number(-1.0, "1", "O, equation 4 [paper]", ge=-1000, le=1000)
    giveup_draw_period: float = number(
        0.1, "s", "between two draws of P_g: every step, to the letter [choice TP-16, U1]", ge=0.1, le=10000
    )
    giveup_mode: Literal["per_draw", "threshold"] = number(
        "per_draw", "1", "threshold: one number is drawn for each wait, which ends when P_g exceeds it [choice TP-16]"
    )
    estimate_least: float = number(50.0, "s", "first estimates of both sub-tasks: uniform from here [paper]", gt=0)
    estimate_most: float = number(
        100.0, "s", "to here [paper]; that of the whole task: from and to twice as much", gt=0
    )
    least_probability: float = number(1e-12, "1", "P_p is kept so far from 0 and 1 [choice TP-12, U22]", ge=0, le=0.1)

    # Beyond the paper; all off.
    social_weight: float = number(
        0.0, "1", "most that a neighbour's fresh time counts against one's own; 0: nobody talks [TP-O3]", ge=0, le=1
    )
    social_range: float = number(0.5, "m", "robots in line of sight hear each other so far [TP-O3]", gt=0, le=1)
    social_period: float = number(10.0, "s", "between two utterances of a robot [choice]", ge=0.1, le=10000)
    social_age: float = number(600.0, "s", "a time so old counts half of a fresh one [choice]", gt=0)
    steepness_most: float = number(
        0.0, "1", "S = this / (1 + own stay in cache booths / steepness_time); 0: S is fixed; 10 [TP-O4]", ge=0, le=1000
    )
    steepness_time: float = number(50.0, "s", "stay at which S is half of steepness_most [TP-O4]", gt=0)
    exploration_age: float = number(
        0.0, "s", "a time measured longer ago makes a robot try the way that measures it; 0: never [TP-O5]", ge=0
    )
    exploration_share: float = number(0.2, "1", "with at least this probability [choice]", ge=0, le=0.5)
    hierarchical: bool = number(
        False, "1", "every task of a tree decides on its own whether to be cut; needs arena.subtasks 3 [TP-O2]"
    )

    @classmethod
    def layout(cls) -> np.dtype:
        """Return the layout with method and mode as numbers."""
        return np.dtype([*_fields(super().layout()), ("method", "i8"), ("threshold", "i8")], align=True)

    def record(self) -> np.recarray:
        """Return the numbers as a record."""
        record = _record(self)
        record[0].method = METHODS.index(self.method)
        record[0].threshold = MODES.index(self.giveup_mode)
        return record

    @model_validator(mode="after")
    def a_tree_keeps_to_itself(self) -> "StrategyTable":
        """Refuse options that know nothing of the times of a tree of tasks."""
        for name in ("social_weight", "exploration_age"):
            if self.hierarchical and getattr(self, name) > 0:
                raise ValueError(f"hierarchical does not go together with {name} {getattr(self, name):g}: set one to 0")
        return self


class BehaviourTable(Table):
    """How a robot finds its way: the paper is silent on all of it (TP-34, U9, U17)."""

    speed: float = number(0.035, "m/s", "[paper]", gt=0)
    turn_rate: float = number(1.32, "rad/s", "on the spot: both wheels at their limit [TP-61]", gt=0)
    steering_gain: float = number(2.5, "1/s", "turn rate per heading error [choice]", gt=0)
    compass_gain: float = number(0.02, "1", "share of the lamp's direction taken over in a cycle [choice]", ge=0, le=1)

    # obstacles
    obstacle_value: float = number(
        0.20, "1", "proximity up to this is let be: 3 cm off [tuned on t_NP, N = 30]", ge=0, lt=1
    )
    repulsion: float = number(2.0, "1", "weight of obstacles against the way wanted [tuned]", ge=0)
    swerve: float = number(1.5, "1", "weight of going round what is ahead, on a side drawn at random [tuned]", ge=0)
    swerve_cycles: int = number(30, "cycles", "for so long it keeps to that side [tuned]", ge=1)
    side_value: float = number(0.3, "1", "one side is the freer one by at least this [choice]", ge=0)
    mouth_distance: float = number(0.20, "m", "a light nearer than this that is no target repels [choice, U28]", ge=0)
    mouth_repulsion: float = number(1.5, "1", "weight of such a light against the way wanted [choice]", ge=0)
    keep_right: bool = number(False, "1", "always go round on the right: a rule of the road the paper has not [U9]")
    pressed_value: float = number(0.30, "1", "proximity ahead that counts as being stuck [choice]", ge=0)
    pressed_cycles: int = number(80, "cycles", "stuck for so long, it backs off [TP-34]", ge=1)
    escape_cycles: int = number(15, "cycles", "for at least so long, at most twice [TP-34]", ge=1)

    # path
    path_value: float = number(0.93, "1", "ground brighter than this is path", ge=0, le=1)
    path_nudge: float = number(0.35, "rad", "towards the path when it is under one side only [choice]", ge=0)
    path_return: float = number(0.70, "rad", "towards the path when it has been left [choice]", ge=0)
    path_patience: int = number(
        80, "cycles", "without the path before it is looked for on the other side [choice]", ge=1
    )

    # booths
    look_half_width: float = number(
        1.2, "rad", "a robot that looks for a booth turns so far to both sides [choice]", gt=0
    )
    roam_cycles: int = number(20, "cycles", "then it walks for so long, at most twice [choice]", ge=1)
    roam_spread: float = number(1.6, "rad", "to both sides of the way back from the booths [choice]", ge=0, le=3.2)
    arrival_cycles: int = number(
        70, "cycles", "who comes out of the corridor walks on for so long before it looks about [choice]", ge=1
    )
    return_cycles: int = number(30, "cycles", "and who strays back into it, for so long [choice]", ge=1)
    target_gate: float = number(0.08, "m", "a light so near to where the target should be is the target [choice]", gt=0)
    lost_cycles: int = number(10, "cycles", "a target unseen for so long is lost [choice]", ge=1)
    blind_cycles: int = number(3, "cycles", "no robot docks that has not seen its target for longer [choice]", ge=0)
    committed: float = number(0.20, "m", "from here on a docking robot heeds no obstacles [choice]", gt=0)
    inside: float = number(0.085, "m", "a red light nearer than this is that of the own booth [choice]", gt=0)
    bay_least: float = number(0.15, "1", "proximity on both sides of a robot in a bay: at least this [choice]", ge=0)
    bay_sum: float = number(0.90, "1", "and together this: walls 10 cm apart give 1.2 [choice]", ge=0)
    docking_patience: int = number(250, "cycles", "then it backs off and looks again [choice]", ge=1)
    exit_distance: float = number(0.16, "m", "a robot drives straight out of a booth for so long [choice]", gt=0)
    exit_patience: int = number(
        100, "cycles", "from its turn on; then it is out, unless there are still walls on both sides [choice]", ge=0
    )
    exit_value: float = number(0.5, "1", "proximity ahead that makes it wait [choice]", ge=0, le=1)


class PartitioningParameters(BaseModel):
    """All of one trial's numbers but its seed."""

    model_config = ConfigDict(extra="forbid", frozen=True)

    arena: ArenaTable = Field(default_factory=ArenaTable)
    swarm: SwarmTable = Field(default_factory=SwarmTable)
    cache: CacheTable = Field(default_factory=CacheTable)
    strategy: StrategyTable = Field(default_factory=StrategyTable)
    behaviour: BehaviourTable = Field(default_factory=BehaviourTable)
    epuck: Epuck = Field(default_factory=lambda: Epuck.model_validate(PINI_2011))
    sight: EpuckSight = Field(default_factory=EpuckSight)

    @model_validator(mode="after")
    def a_second_cache_stands(self) -> "PartitioningParameters":
        """Refuse what is said of a second cache where there is none."""
        if self.arena.subtasks == 2 and (self.strategy.hierarchical or self.cache.second_extra != 0):
            name = "strategy.hierarchical" if self.strategy.hierarchical else "cache.second_extra"
            raise ValueError(f"{name} needs two caches: set arena.subtasks to 3, or leave it off")
        return self


# The interfacing times of Fig. 7, s: setting k is the k-th.
INTERFACING_TIMES = (0.0, 25.0, 50.0, 75.0, 100.0, 150.0, 200.0)


def partitioning_parameters(
    setting: int | None = None, robots: int | None = None, **groups: Any
) -> PartitioningParameters:
    """Return the parameters of one of the paper's settings.

    Args:
        setting: 0..6, the interfacing times of Fig. 7. None means 0.
        robots: number of robots; None means the paper's ten.
        groups: fields to change, by group: ``strategy={"method": "never"}``.

    Raises:
        ValueError: if a number is out of bounds or the setting does not exist.
    """
    k = 0 if setting is None else setting
    if k not in range(len(INTERFACING_TIMES)):
        raise ValueError(f"setting {setting} does not exist: partitioning has settings 0 to 6")
    tables: dict[str, dict[str, Any]] = {"cache": {"interfacing_time": INTERFACING_TIMES[k]}, "epuck": PINI_2011}
    if robots is not None:
        tables["swarm"] = {"robots": robots}
    for group, values in groups.items():
        tables[group] = {**tables.get(group, {}), **values}
    return PartitioningParameters.model_validate(tables)


def _fields(layout: np.dtype) -> list[Any]:
    return [(name, layout[name]) for name in layout.names or ()]


def _record(table: Table) -> np.recarray:
    """Fill in the fields that hold numbers of the table itself."""
    record = np.zeros(1, table.layout()).view(np.recarray)
    for name, value in table:
        if isinstance(value, bool | int | float):
            record[0][name] = value
    return record

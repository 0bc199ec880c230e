"""Every number of the coverage system, with unit, bounds and reason.

[paper]: Panerati et al., "From Swarms to Stars: Task Coverage in Robot Swarms with Connectivity Constraints", 2018.
[files]: the authors' ARGoS and Buzz files; [notebook]: their Python notebook. ST-..: numbered statements, and choices
where all of them are silent [choice].
"""

import math
from typing import Any, Literal

import numpy as np
from pydantic import BaseModel, ConfigDict, Field, model_validator

from formicarium.robots.footbot import ARMS, LABORATORY_2018, NOTEBOOK_2018, PACKETS, Footbot
from formicarium.systems.coverage.formation import FormationTable
from formicarium.systems.coverage.mission import MissionTable, check_mission
from formicarium.tables import Table, number

PROGRAMMES = ("erupt", "tour", "mission")
VARIANTS = ("faithful", "buzz", "safe")
FORCES = ("corrected", "printed", "smooth")
CHOICES = ("draw", "quota", "blocks")


class SwarmTable(Table):
    """How many robots, where they start, how long."""

    robots: int = number(10, "1", "master and backbone together [files, Figs 4 and 5]", ge=2, le=PACKETS)
    start: Literal["files", "square"] = number(
        "files",
        "1",
        "files: three robots at set places, the rest uniform [files, ST-44]; square: all uniform [notebook]",
    )
    half_side: float = number(1.0, "m", "of the square round the master in which they start [files]", gt=0)
    crowd: int = number(25, "1", "with more robots than these the square grows, so that they fit [choice]", ge=1)
    time_cap: float = number(900.0, "s", "length of a trial [choice ST-60]", gt=0, le=1e6)
    cycle_time: float = number(0.1, "s", "one step [files]", ge=0.01, le=1)
    failure_rate: float = number(0.0, "1/s", "rate at which a robot dies", ge=0, le=10)


class TaskTable(Table):
    """Where the tasks are and what the master does about them."""

    programme: Literal["erupt", "tour", "mission"] = number(
        "erupt",
        "1",
        "erupt: from the first step to the end [files]; tour: flock, erupt, hold, gather [paper III-C]; mission: the "
        "same for each slot of a plan [ST-48]",
    )
    pattern: Literal["star", "random"] = number("star", "1", "star: regular; random: uniform in a square [notebook]")
    count: int = number(1, "1", "T, tasks, an arm each [paper]", ge=1, le=ARMS)
    distance: float = number(15.0 * math.sqrt(2.0), "m", "of a star's tasks from the point of deployment [paper]", gt=0)
    first_direction: float = number(-0.25 * math.pi, "rad", "of the first arm, in the master's frame [files]")
    side: float = number(8.0, "m", "of the square of random tasks, which keep 5 % off its sides [notebook]", gt=0)
    travel: float = number(0.0, "m", "tour: the swarm flocks so far first [choice]", ge=0, le=30)
    travel_direction: float = number(0.0, "rad", "tour: in this direction, in the master's frame [choice]")
    stop: bool = number(True, "1", "arms stop at their tasks [choice ST-43]; off: they stretch on [files]")
    hold_time: float = number(20.0, "s", "tour: tasks are held for so long, all at once [choice]", ge=0)
    erupt_limit: float = number(
        600.0, "s", "then arms that have reached their tasks hold them, in a tour or mission [choice]", gt=0
    )
    attempts: int = number(
        1, "1", "at a slot of a mission, while its tasks were not held all at once [choice ST-72]", ge=1, le=9
    )
    gather_limit: float = number(120.0, "s", "a rendez-vous ends by then, in a tour or mission [choice ST-31]", gt=0)


class BehaviourTable(Table):
    """The navigation controller. Lengths of its own would not fit robots of another range."""

    variant: Literal["faithful", "buzz", "safe"] = number(
        "faithful", "1", "faithful: the paper; buzz: as the authors' files reckon; safe: and links are kept [ST-46]"
    )
    transform: Literal["corrected", "printed"] = number("corrected", "1", "how directions are handed on [ST-36]")
    force: Literal["corrected", "printed", "smooth"] = number(
        "corrected", "1", "equation 2; smooth: gentle near the wanted distance [ST-27, ST-28]"
    )
    depth: float = number(100.0, "m2/s", "eps: 10^6 cm2/s [paper]; 10^9 in the files gives the same", gt=0)
    smooth_rate: float = number(0.5, "1/s", "of the smooth force, per metre off the wanted distance [choice]", gt=0)
    spacing: float = number(2.4, "m", "delta of an eruption: 0.9, 1.2, 2.4 or 2.75 [paper]", gt=0)
    close_spacing: float = number(1.2, "m", "delta of a robot without a reference [files]", gt=0)
    gather_spacing: float = number(0.9, "m", "delta of a rendez-vous [files, ST-31]", gt=0)

    aligned_angle: float = number(
        math.radians(1.8), "rad", "aligned if nearer to the arm's line than this [files]", gt=0
    )
    approach_share: float = number(1.2, "1", "farther from the reference than so many delta: approach [files]", gt=0)
    approach_range: float = number(2.5, "m", "and farther than this, too [files]", gt=0)
    flee_range: float = number(0.25, "m", "nearer to the reference than this: flee [files]", ge=0)
    spiral_most: float = number(
        math.radians(40.0), "rad", "a spiral opens by an angle from 0 to this [choice ST-40]", ge=0
    )
    fresh_cycles: int = number(5, "cycles", "what was heard so long ago still counts [choice ST-34]", ge=0, le=50)
    close_cycles: int = number(50, "cycles", "a robot without a way to the master then turns back [choice 15]", ge=1)
    reached_hops: int = number(
        60, "cycles", "word of a reached task lives for so many hops or cycles [choice ST-43]", ge=1
    )

    silence_cycles: int = number(
        0,
        "cycles",
        "a master of a mission without a newer word for so long is given up, and the lowest number alive follows it; "
        "0: nobody does [paper; choice ST-48: 5 s]",
        ge=0,
    )
    patience_cycles: int = number(
        600, "cycles", "a group of less than half of the swarm waits so long to meet others first [choice ST-48]", ge=1
    )
    placing_share: float = number(
        0.02, "1", "of what a neighbour makes of a robot's place in the map, in each cycle [choice]", gt=0, le=1
    )
    census_cycles: int = number(
        0,
        "cycles",
        "the master reckons with no more robots than it has counted in so long; 0: with all, for ever [choice ST-71]",
        ge=0,
    )
    sweep_cycles: int = number(
        0,
        "cycles",
        "an arm that has not found its task after so long draws in to a fifth of its delta and stretches beyond it, "
        "once in so long, so that a task between two robots is found; 0: never [files]",
        ge=0,
    )
    strays: Literal["close", "return"] = number(
        "close",
        "1",
        "a robot of a known way and no reference: close: draws near to others [files]; return: goes along the way to "
        "the master, where it finds one [choice]",
    )

    arm_choice: Literal["draw", "quota", "blocks"] = number(
        "draw",
        "1",
        "draw: by the tasks' distances [paper]; quota: and corrected by the master [ST-32]; blocks: by number",
    )
    correction_cycles: int = number(50, "cycles", "between two corrections of the arms [choice ST-32]", ge=5)
    agreed_cycles: int = number(
        3, "cycles", "for so long everybody must have been counted, arm by arm the same, to correct [choice]", ge=0
    )
    correction_limit: float = number(60.0, "s", "no corrections after so long in a phase [choice ST-32]", ge=0)

    safe_share: float = number(
        0.92, "1", "safe: no kept link gets longer than this share of r [choice ST-46]", gt=0, le=1
    )
    keep_cycles: int = number(20, "cycles", "safe: who was silent for longer is not kept any more [choice]", ge=1)
    anchor_margin: float = number(0.1, "m", "safe: an anchor is nearer to the master by at least this [choice]", ge=0)
    taut_share: float = number(
        0.9, "1", "safe: a link longer than this share of the longest kept is changed for a shorter one [choice]", gt=0
    )

    cohesion: float = number(0.5, "1/s", "e of equation 3 [choice ST-30]", ge=0)
    agreement: float = number(0.6, "1", "f of equation 3, for velocities [choice ST-30]", ge=0)
    separation: float = number(0.05, "m2/s", "g of equation 3 [choice ST-30]", ge=0)
    separation_range: float = number(0.6, "m", "q of equation 3 [choice ST-30]", ge=0)
    leading: float = number(1.0, "1/s", "weight of the way to the master, or towards it [choice ST-30]", ge=0)
    flocking: Literal["corrected", "printed"] = number(
        "corrected", "1", "printed: separation weakens as robots touch, sums are not divided [ST-30]"
    )
    compact_range: float = number(1.5, "m", "r / 2: the swarm is compact if no gradient is longer [choice ST-30]", gt=0)
    rendezvous: Literal["potential", "flocking"] = number(
        "potential",
        "1",
        "potential: each draws near to whom it hears, so groups can stay apart [paper, ST-31]; flocking: by equation 3 "
        "to the master, which stands [choice]",
    )
    leader_share: float = number(0.6, "1", "of top speed, the master's in flocking [choice ST-30]", gt=0, le=1)
    arrival_range: float = number(0.3, "m", "of the master's odometry at the point of deployment [choice ST-30]", gt=0)

    @classmethod
    def layout(cls) -> np.dtype:
        """Return the layout with the words as numbers."""
        inherited = super().layout()
        fields = [(name, inherited[name]) for name in inherited.names or ()]
        words: list[Any] = [(name, "i8") for name in WORDS]
        return np.dtype([*fields, *words], align=True)

    def record(self) -> np.recarray:
        """Return the numbers as a record, words as their places in WORDS."""
        record = np.zeros(1, self.layout()).view(np.recarray)
        for name, value in self:
            record[0][name] = WORDS[name].index(value) if name in WORDS else value
        return record


WORDS = {
    "variant": VARIANTS,
    "transform": ("corrected", "printed"),
    "force": FORCES,
    "arm_choice": CHOICES,
    "flocking": ("corrected", "printed"),
    "rendezvous": ("potential", "flocking"),
    "strays": ("close", "return"),
}


class FailureTable(Table):
    """Robots that fall silent for good in the midst of a trial (ST-71)."""

    count: int = number(0, "1", "robots that fail [choice ST-71]", ge=0, le=PACKETS)
    aim: Literal["random", "articulation", "master"] = number(
        "random",
        "1",
        "random: any living robot but the master; articulation: one whose loss parts the range graph, as soon as there "
        "is one; master: whoever leads [ST-71]",
    )
    remains: Literal["obstacle", "removed"] = number(
        "obstacle", "1", "obstacle: the body stays where it is; removed: it is taken away [ST-71]"
    )
    earliest: float = number(30.0, "s", "each fails at a random time from here [choice ST-71]", ge=0, le=1e6)
    latest: float = number(300.0, "s", "to here [choice ST-71]", ge=0, le=1e6)

    @model_validator(mode="after")
    def times_fit(self) -> "FailureTable":
        """Refuse a time that ends before it begins."""
        if self.latest < self.earliest:
            raise ValueError(
                f"failures.latest = {self.latest:g} s is before failures.earliest = {self.earliest:g} s: make latest "
                "larger"
            )
        return self


class ObserverTable(Table):
    """What the observers look at, and how often."""

    structure_every: float = number(
        1.0, "s", "between two looks at robots whose loss would part the swarm [ST-69]", gt=0
    )
    spectrum_every: float = number(10.0, "s", "between two values of lambda_2 of the range graph [choice ST-69]", gt=0)


class CoverageParameters(BaseModel):
    """All of one trial's numbers but its seed."""

    model_config = ConfigDict(extra="forbid", frozen=True)

    swarm: SwarmTable = Field(default_factory=SwarmTable)
    tasks: TaskTable = Field(default_factory=TaskTable)
    mission: MissionTable = Field(default_factory=MissionTable)
    behaviour: BehaviourTable = Field(default_factory=BehaviourTable)
    formation: FormationTable = Field(default_factory=FormationTable)
    footbot: Footbot = Field(default_factory=Footbot)
    observer: ObserverTable = Field(default_factory=ObserverTable)
    failures: FailureTable = Field(default_factory=FailureTable)

    @model_validator(mode="after")
    def lengths_fit(self) -> "CoverageParameters":
        """Refuse spacings beyond the radio's range."""
        if self.behaviour.spacing > self.footbot.radio_range:
            raise ValueError(
                f"behaviour.spacing = {self.behaviour.spacing:g} m is more than footbot.radio_range = "
                f"{self.footbot.radio_range:g} m: nobody would hear anybody. Make spacing smaller or radio_range larger"
            )
        return self

    @model_validator(mode="after")
    def tubes_fit(self) -> "CoverageParameters":
        """Refuse a network of arms that have no two neighbours."""
        if self.formation.shape == "network" and self.tasks.count < 3:
            raise ValueError(
                f"tasks.count = {self.tasks.count}: in a network (formation.shape) every arm has one neighbour on each "
                "side. Make tasks.count 3 or more"
            )
        return self

    @model_validator(mode="after")
    def mission_fits(self) -> "CoverageParameters":
        """Refuse a plan that cannot be flown."""
        check_mission(self.mission, self.tasks.programme, self.swarm.robots, self.behaviour.silence_cycles)
        return self

    @model_validator(mode="after")
    def failures_fit(self) -> "CoverageParameters":
        """Refuse more failures than there are robots."""
        if self.failures.count >= self.swarm.robots:
            raise ValueError(
                f"failures.count = {self.failures.count} of swarm.robots = {self.swarm.robots}: at least one must be "
                "left. Make count smaller"
            )
        return self


Groups = dict[str, dict[str, Any]]

# Setting 0 is the one a newcomer sees: all phases, three tasks.
TOUR: Groups = {
    "swarm": {"robots": 16, "time_cap": 900.0},
    "tasks": {"programme": "tour", "count": 3, "distance": 5.0, "travel": 3.0},
    "behaviour": {"arm_choice": "quota"},
}
TABLE_1_DENSE: Groups = {"swarm": {"robots": 11}, "tasks": {"stop": False}, "behaviour": {"spacing": 1.2}}
TABLE_1_SPARSE: Groups = {"swarm": {"robots": 11}, "tasks": {"stop": False}, "behaviour": {"spacing": 2.4}}
FIGURE_4A: Groups = {"swarm": {"time_cap": 180.0}, "tasks": {"stop": False}, "behaviour": {"spacing": 0.9}}
FIGURE_4B: Groups = {"swarm": {"time_cap": 180.0}, "tasks": {"stop": False}, "behaviour": {"spacing": 2.4}}
FIGURE_5: Groups = {
    "swarm": {"robots": 16, "time_cap": 180.0},
    "tasks": {"stop": False, "count": 3},
    "behaviour": {"arm_choice": "quota"},
}
IDEAL: Groups = {
    "swarm": {"robots": 30, "start": "square", "half_side": 0.335, "crowd": 30, "time_cap": 600.0},
    "tasks": {"pattern": "random", "count": 4, "side": 8.0},
    "behaviour": {
        "depth": 0.5,
        "spacing": 0.5,
        "close_spacing": 0.4,  # the same share of the range as 1.2 m of 3 m
        "gather_spacing": 0.3,
        "aligned_angle": 0.08,
        "approach_range": 2.5 / 3.0,
        "flee_range": 0.03,
        "compact_range": 0.5,
    },
    "footbot": NOTEBOOK_2018,
}
LABORATORY: Groups = {
    "swarm": {"robots": 7, "time_cap": 300.0},
    "tasks": {"distance": 3.0 * math.sqrt(2.0)},
    "footbot": LABORATORY_2018,
}
# Arms that branch are corrected for longer, and on single whole counts: a fractal has a place for every robot.
FORMED: dict[str, Any] = {
    "arm_choice": "quota",
    "agreed_cycles": 1,
    "correction_limit": 150.0,
    "variant": "safe",
    "strays": "return",
}
FRACTAL: Groups = {
    "swarm": {"robots": 43, "time_cap": 600.0},
    "tasks": {"stop": False, "count": 3, "distance": 8.0},
    "behaviour": FORMED,
    "formation": {"shape": "fractal"},
}
NETWORK: Groups = {
    "swarm": {"robots": 16, "time_cap": 600.0},
    "tasks": {"stop": False, "count": 3, "distance": 6.0},
    "behaviour": FORMED,
    "formation": {"shape": "network"},
}
SETTINGS = (TOUR, TABLE_1_DENSE, TABLE_1_SPARSE, FIGURE_4A, FIGURE_4B, FIGURE_5, IDEAL, LABORATORY, FRACTAL, NETWORK)


def coverage_parameters(setting: int | None = None, robots: int | None = None, **groups: Any) -> CoverageParameters:
    """Return the parameters of a setting.

    Args:
        setting: 0 a tour of all phases; 1 and 2 Table I with delta 1.2 and 2.4 m; 3 and 4 Fig. 4a and 4b; 5 Fig. 5;
            6 the idealised scenario; 7 the laboratory's stand-in; 8 a fractal of 43 robots; 9 a network of 16.
            None means 0.
        robots: master and backbone together; None means the setting's own.
        groups: fields to change, by group: ``behaviour={"variant": "safe"}``.

    Raises:
        ValueError: if a number is out of bounds or the setting does not exist.
    """
    k = 0 if setting is None else setting
    if k not in range(len(SETTINGS)):
        raise ValueError(f"setting {setting} does not exist: coverage has settings 0 to {len(SETTINGS) - 1}")
    tables = {group: dict(values) for group, values in SETTINGS[k].items()}
    if robots is not None:
        tables.setdefault("swarm", {})["robots"] = robots
    for group, values in groups.items():
        tables[group] = {**tables.get(group, {}), **values}
    return CoverageParameters.model_validate(tables)

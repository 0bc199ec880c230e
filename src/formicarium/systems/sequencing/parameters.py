"""Every number of the sequencing system, with unit, bounds and reason.

[paper]: Garattoni & Birattari, "Autonomous task sequencing in a robot swarm", Science Robotics 3 (2018).
U.., TS-..: numbered choices where the paper is silent. [tuned]: found by calibration, see docs/results/.
"""

import math
from typing import Any, NamedTuple

from pydantic import BaseModel, ConfigDict, Field, model_validator

from formicarium.devices.booth import BoothTable
from formicarium.robots.epuck import Epuck
from formicarium.tables import Table, number
from formicarium.trial.setup import APART, WALL_MARGIN


def degrees(value: float) -> float:
    """Return an angle given in degrees in radians."""
    return math.radians(value)


class ArenaTable(Table):
    """The walls and where the booths stand."""

    tasks: int = number(3, "1", "m, number of tasks and booths [paper]", ge=2, le=4)
    sides: int = number(6, "1", "of the regular polygon; booths stand on every second side [paper]", ge=4, le=8)
    side: float = number(0.9, "m", "length of a side [paper, Table 1]", gt=0.3, le=10)
    tam_offset: float = number(
        0.0,
        "m",
        "how far a booth's mouth stands inside the wall line: 0 flush, 0.12 all inside [choice TS-36]",
        ge=0,
        le=0.12,
    )
    wall_friction: float = number(0.1, "1", "[model]", ge=0)
    turn: float = number(0.0, "rad", "the whole arena is turned by this (for tests)", ge=-100, le=100)
    shift_x: float = number(0.0, "m", "and shifted by this (for tests)", ge=-1000, le=1000)
    shift_y: float = number(0.0, "m", "and this (for tests)", ge=-1000, le=1000)

    @model_validator(mode="after")
    def booths_fit(self) -> "ArenaTable":
        """Require two sides a booth."""
        if self.sides != 2 * self.tasks:
            raise ValueError(f"sides must be twice the number of tasks: {self.tasks} tasks need {2 * self.tasks} sides")
        return self


class SwarmTable(Table):
    """How many robots, how long, and which of them die."""

    robots: int = number(20, "1", "N [paper, Table 1]", ge=1, le=255)
    time_cap: float = number(2400.0, "s", "TC, the trial ends here at the latest [paper, Table 1]", gt=0, le=1e6)
    sequences: int = number(10, "1", "the trial ends when so many are complete [paper]", ge=1, le=100_000)
    idle_limit: float = number(
        0.0,
        "s",
        "a trial in which nobody has been a runner for so long is ended and counts as run to its cap: chain members "
        "stay what they are, so nobody will do a task any more; 0: never [TS-145]",
        ge=0,
        le=1e6,
    )
    stall_limit: float = number(
        0.0,
        "s",
        "a trial whose complete chain has done no sequence, nor gone on with its search, for so long is ended and "
        "counts as run to its cap; 0: never [TS-145]",
        ge=0,
        le=1e6,
    )
    failure_rate: float = number(
        0.0, "1/s", "rate at which a robot dies; the paper's ten robot runs: 1 / 43,600 s [TS-149]", ge=0, le=10
    )
    deaths: tuple[tuple[int, float], ...] = number(
        (), "s", "robots that die, as [[number 1 to N, seconds], ...] [TS-149, U31]"
    )
    log_messages: bool = number(False, "1", "log every packet sent (large)")
    log_states: bool = number(False, "1", "log every change of a robot's state (large)")

    @model_validator(mode="after")
    def deaths_are_of_robots(self) -> "SwarmTable":
        """Let only robots die that there are, at times that exist."""
        for robot, seconds in self.deaths:
            if not 1 <= robot <= self.robots or not 0 <= seconds <= 1e6:
                raise ValueError(f"deaths: [{robot}, {seconds}] is not [robot 1 to {self.robots}, seconds 0 to 1e6]")
        return self


class BehaviourTable(Table):
    """The controller's numbers: the same for every robot, variant and setting (TS-3)."""

    tasks: int = number(3, "1", "m, how far the robots count [paper]", ge=2, le=4)
    mark: int = number(
        1,
        "1",
        "I: every task gets a verdict, guardians learn; II: only a sequence does, they search [paper]",
        ge=1,
        le=2,
    )

    # random walk
    walk_speed: float = number(0.08, "m/s", "U2", gt=0)
    walk_turn_probability: float = number(0.01, "1/cycle", "U2", ge=0, le=1)
    walk_turn_least: float = number(degrees(30), "rad", "U2", ge=0)
    walk_turn_most: float = number(degrees(150), "rad", "U2", ge=0)
    obstacle_value: float = number(
        0.15, "1", "proximity at which a walking robot turns; U2 says 0.1, noise is 0.05", ge=0
    )
    turn_rate: float = number(2.0, "rad/s", "of turns on the spot", gt=0)
    steering_gain: float = number(3.0, "1/s", "turn rate per heading error", gt=0)

    # runner
    unattended_after: int = number(
        20, "cycles", "a task whose guardian was not heard for so long is unattended TS-92", ge=1
    )
    attended_within: float = number(
        0.35, "m", "nor is a task unattended while a guardian's light is this near [choice]", ge=0
    )
    unattended_watch: int = number(5, "cycles", "and its booth must have been in sight for so long [choice]", ge=0)
    follow_speed: float = number(0.05, "m/s", "U3 [tuned on chain time]", gt=0)
    follow_distance: float = number(0.11, "m", "d-bar, kept to the reference point TS-98", gt=0)
    radial_gain: float = number(1.5, "1", "TS-96", gt=0)
    literal_line: bool = number(False, "1", "do not clamp the foot of the perpendicular to the segment TS-97")
    repulsion_value: float = number(0.3, "1", "proximity above which a following robot is pushed off U44", ge=0)
    repulsion_weight: float = number(0.5, "1", "U44", ge=0)
    member_clearance: float = number(
        0.085, "m", "a runner does not drive at a chain member nearer than this [choice]", ge=0
    )
    queue_value: float = number(
        0.5,
        "1",
        "proximity ahead at which a runner beside a guardian waits: a queue that pushes displaces it [choice]",
        ge=0,
    )
    queue_patience: int = number(600, "cycles", "but no longer than this: who stands ahead may be dead [choice]", ge=0)
    guardian_vicinity: float = number(0.25, "m", "a runner this near to a guardian is beside it [choice]", ge=0)
    lost_after: int = number(20, "cycles", "a runner that sees no chain for so long walks at random U34", ge=1)
    decide_distance: float = number(0.30, "m", "a runner heeds the guardian within this TS-100", gt=0)
    advert_memory: int = number(10, "cycles", "an advertisement counts for so long [choice]", ge=1)
    advert_gate: float = number(0.5, "rad", "bearing difference at which packet and light are one robot [probe]", gt=0)
    approach_speed: float = number(0.04, "m/s", "into the booth U24 [probe]", gt=0)
    approach_patience: int = number(200, "cycles", "then a runner gives up TS-107", ge=1)
    lights_lost_after: int = number(25, "cycles", "an approach whose lights are dark for so long is over [probe]", ge=1)
    straight_within: float = number(0.10, "m", "of the lights a robot drives straight on [probe]", gt=0)
    settle_time: int = number(
        10, "cycles", "a robot at the lights' place presses on so long after they went out [choice]", ge=1
    )
    exchange_patience: int = number(100, "cycles", "a robot in the bay waits so long for the verdict [choice]", ge=1)
    retry_pause: int = number(30, "cycles", "before it enters again after a failed exchange U30", ge=0)
    retries: int = number(3, "1", "U30", ge=0)
    leave_distance: float = number(0.10, "m", "a visitor drives so far from the middle of the bay U26", gt=0)
    exit_distance: float = number(0.25, "m", "a future guardian drives so far from the middle of the bay [paper]", gt=0)
    lights_depth: float = number(0.035, "m", "of a booth's lights behind its middle [model]", ge=0)
    exit_patience: int = number(
        600, "cycles", "who is blocked on its way out for so long stays where it is, or goes on [choice]", ge=1
    )
    notify_patience: int = number(300, "cycles", "a runner repeats its notification at most so long [probe]", ge=1)
    notify_least: int = number(30, "cycles", "and at least so long U54", ge=0)
    notification_gate: float = number(0.45, "m", "a guardian hears notifications within this [choice, T15]", gt=0)

    step_memory: int = number(
        3000, "cycles", "a runner that has not met its M4PI for so long starts its sequence again TS-128", ge=1
    )

    # inhibition
    inhibition_distance: float = number(0.40, "m", "TS-106", ge=0)
    inhibition_ahead: float = number(
        degrees(90),
        "rad",
        "only what is ahead inhibits: who is leaving clears the way by going on [choice]",
        ge=0,
    )
    inhibition_memory: int = number(
        30, "cycles", "inhibited robots resume after so long without a message TS-106", ge=1
    )
    inhibition_leave: float = number(0.8, "1", "probability to leave instead; TS-106 says 0.2 [tuned]", ge=0, le=1)
    inhibition_clearance: float = number(0.25, "m", "an inhibited robot backs off to this TS-106", ge=0)
    inhibition_echo: int = number(10, "cycles", "a guardian repeats an inhibition for so long [choice]", ge=0)

    # joining the chain
    join_distance: float = number(0.25, "m", "a runner answers an invitation within this TS-82", gt=0)
    request_patience: int = number(30, "cycles", "TS-82", ge=1)
    refuse_time: int = number(
        100, "cycles", "then it ignores invitations, booths, or an inhibited place for so long TS-82", ge=0
    )
    offer_patience: int = number(30, "cycles", "TS-82", ge=1)
    sector_half_width: float = number(degrees(30), "rad", "of the invited sector U10", gt=0)
    sector_tolerance: float = number(
        degrees(25), "rad", "a request must come from the sector, give or take this [probe]", ge=0
    )

    # chain members
    spacing: float = number(0.18, "m", "wanted between members; the paper prints 0.15, see TS-38 [tuned]", gt=0)
    spacing_tolerance: float = number(0.05, "m", "[paper]", gt=0)
    alignment_tolerance: float = number(degrees(10), "rad", "[paper]", gt=0)
    mending_share: float = number(
        0.15,
        "1",
        "a link out of tolerance mends its errors down to this share of the tolerances: else every link keeps "
        "nearly 10 degrees and a long branch curls up [tuned]",
        gt=0,
        le=1,
    )
    separate_tolerances: bool = number(
        False, "1", "a link mends only the error that is out of tolerance, not both [choice]"
    )
    member_speed: float = number(0.04, "m/s", "largest speed of links and tails TS-74", gt=0)
    track_gate: float = number(
        0.07, "m", "a blob this near to where a neighbour should be is that neighbour [probe]", gt=0
    )
    track_gain: float = number(0.35, "1", "share of the new sighting in a neighbour's place [probe]", gt=0, le=1)
    track_refind: int = number(5, "cycles", "a neighbour unseen so long is looked for by its packets [probe]", ge=1)
    light_patience: int = number(
        10,
        "cycles",
        "Mark II: so long without an answer or another branch's tail, then a light ends an offer [choice, C18]",
        ge=0,
    )
    track_lost: int = number(
        20, "cycles", "a link that has not seen a neighbour for so long stands still [choice]", ge=1
    )
    refind_gate: float = number(degrees(20), "rad", "bearing gate between packet and blob TS-73", gt=0)

    # tail
    position_band: float = number(0.02, "m", "dead band of the tail's distance servo [probe]", ge=0)
    position_hold: int = number(10, "cycles", "in place so long before it invites TS-77", ge=0)
    sweep_idle: int = number(60, "cycles", "without a request, then the branch sweeps U12 [tuned]", ge=1)
    sweep_angle: float = number(
        degrees(4),
        "rad",
        "by which the branch turns before it pauses: a short one is not to overshoot [choice, for U13]",
        gt=0,
    )
    sweep_burst: int = number(
        15, "cycles", "but no longer than this, or the tip of a long branch curls up [tuned, U13]", ge=1
    )
    sweep_pause: int = number(40, "cycles", "U13", ge=0)
    sweep_pause_per_link: int = number(
        5, "cycles", "and so much more for every link of the branch, which have to realign [tuned, U13]", ge=0
    )
    sweep_speed: float = number(0.025, "m/s", "U13", gt=0)
    dock_ahead: float = number(degrees(100), "rad", "a guardian counts within this of the branch direction TS-86", gt=0)
    dock_gaps: float = number(0.40, "m", "if both gaps add up to more, recruit one more U21", gt=0)
    pull_patience: int = number(
        50, "cycles", "Mark II: for so long it pulls the branch forward before it recruits [choice, TS-87]", ge=0
    )
    dock_band: float = number(0.03, "m", "tolerance of the gaps while docking: twice the camera's noise [choice]", gt=0)
    dock_hold: int = number(10, "cycles", "aligned so long, then it hands over U20", ge=0)
    dock_patience: int = number(200, "cycles", "or it hands over anyway [probe]", ge=1)
    cnd_monotone: bool = number(True, "1", "a late notification does not lower CND TS-60")


class PhysicsTable(Table):
    """The flat world's solver."""

    cycle_time: float = number(0.1, "s", "control period [paper]", ge=0.01, le=1)
    substeps: int = number(10, "1", "physics steps a cycle [model]", ge=1, le=100)
    iterations: int = number(10, "1", "of the contact solver [model]", ge=1, le=100)


class SequencingParameters(BaseModel):
    """All of one trial's numbers but its seed."""

    model_config = ConfigDict(extra="forbid", frozen=True)

    arena: ArenaTable = Field(default_factory=ArenaTable)
    swarm: SwarmTable = Field(default_factory=SwarmTable)
    epuck: Epuck = Field(default_factory=Epuck)
    booth: BoothTable = Field(default_factory=BoothTable)
    behaviour: BehaviourTable = Field(default_factory=BehaviourTable)
    physics: PhysicsTable = Field(default_factory=PhysicsTable)

    @model_validator(mode="after")
    def same_tasks(self) -> "SequencingParameters":
        """Let the robots count as far as there are booths and expect the feedback that the booths give."""
        if self.behaviour.tasks != self.arena.tasks:
            raise ValueError(
                f"behaviour.tasks is {self.behaviour.tasks} but arena.tasks is {self.arena.tasks}: they must be equal"
            )
        if self.booth.delayed_feedback != (self.behaviour.mark == 2):
            raise ValueError("booth.delayed_feedback goes with behaviour.mark 2, and only with it")
        return self

    @model_validator(mode="after")
    def robots_fit(self) -> "SequencingParameters":
        """Refuse more robots than random placing can find room for (jamming density of discs, 0.547)."""
        inset = 0.5 * self.arena.side / math.tan(math.pi / self.arena.sides) - WALL_MARGIN
        area = self.arena.sides * max(0.0, inset) ** 2 * math.tan(math.pi / self.arena.sides)
        room = int(0.5 * area / (math.pi * (0.5 * APART) ** 2))
        if self.swarm.robots > room:
            raise ValueError(
                f"swarm.robots is {self.swarm.robots}, but an arena with sides of {self.arena.side:.2f} m has room "
                f"for {room} at the start: fewer robots, a larger arena.side or a higher --setting"
            )
        return self


class Variant(NamedTuple):
    """What tells the paper's four systems apart, and their settings 0..4 (Table 1).

    Side = base * sqrt(2)^k unrounded (TS-34); robots and time caps as printed (contradiction C2).
    """

    name: str
    tasks: int
    mark: int  # 1: every task gets a verdict; 2: only a whole sequence does
    side: float  # m, of the smallest arena
    robots: tuple[int, ...]
    time_caps: tuple[float, ...]  # s


HEXAGON_SIDE = 0.9
OCTAGON_SIDE = 0.66
LONG = (100_000.0,) * 5
MARK_I3_ROBOTS = (20, 28, 40, 57, 80)
MARK_I3_TIME_CAPS = (2400.0, 3400.0, 4800.0, 6800.0, 9600.0)
MARK_I3 = Variant("mark-i3", 3, 1, HEXAGON_SIDE, MARK_I3_ROBOTS, MARK_I3_TIME_CAPS)
MARK_I4 = Variant("mark-i4", 4, 1, OCTAGON_SIDE, (22, 31, 44, 62, 88), LONG)
MARK_II3 = Variant("mark-ii3", 3, 2, HEXAGON_SIDE, (25, 35, 50, 70, 100), LONG)
MARK_II4 = Variant("mark-ii4", 4, 2, OCTAGON_SIDE, (27, 38, 54, 76, 108), LONG)


def configured(
    variant: Variant, setting: int | None = None, robots: int | None = None, **groups: Any
) -> SequencingParameters:
    """Return the parameters of a variant in one of the paper's settings.

    Args:
        variant: one of the four.
        setting: 0..4, the row of Table 1; each doubles the area. None means 0.
        robots: number of robots; None means the paper's default for the setting.
        groups: fields to change, by group: ``behaviour={"spacing": 0.15}``.

    Raises:
        ValueError: if a number is out of bounds or the setting does not exist.
    """
    k = 0 if setting is None else setting
    if k not in range(len(variant.robots)):
        raise ValueError(
            f"setting {setting} does not exist: {variant.name} has settings 0 to {len(variant.robots) - 1}"
        )
    tables: dict[str, dict[str, Any]] = {
        "arena": {"tasks": variant.tasks, "sides": 2 * variant.tasks, "side": variant.side * math.sqrt(2.0) ** k},
        "swarm": {"robots": variant.robots[k] if robots is None else robots, "time_cap": variant.time_caps[k]},
        "booth": {"delayed_feedback": variant.mark == 2},
        "behaviour": {"tasks": variant.tasks, "mark": variant.mark},
    }
    for group, fields in groups.items():
        tables[group] = {**tables.get(group, {}), **fields}
    return SequencingParameters.model_validate(tables)


def mark_i3_parameters(setting: int | None = None, robots: int | None = None, **groups: Any) -> SequencingParameters:
    """Return the parameters of Mark I3, as ``configured`` does."""
    return configured(MARK_I3, setting, robots, **groups)


def mark_i4_parameters(setting: int | None = None, robots: int | None = None, **groups: Any) -> SequencingParameters:
    """Return the parameters of Mark I4, as ``configured`` does."""
    return configured(MARK_I4, setting, robots, **groups)


def mark_ii3_parameters(setting: int | None = None, robots: int | None = None, **groups: Any) -> SequencingParameters:
    """Return the parameters of Mark II3, as ``configured`` does."""
    return configured(MARK_II3, setting, robots, **groups)


def mark_ii4_parameters(setting: int | None = None, robots: int | None = None, **groups: Any) -> SequencingParameters:
    """Return the parameters of Mark II4, as ``configured`` does."""
    return configured(MARK_II4, setting, robots, **groups)

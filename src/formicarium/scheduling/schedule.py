"""What a solver answers: slots in order, each with a deployment point and arms, and how good that is proven to be."""

from collections.abc import Sequence
from typing import Any, NamedTuple

from formicarium.scheduling.instance import Instance
from formicarium.scheduling.reach import Reach


class Arm(NamedTuple):
    """A way from the master to a task."""

    task: str
    relays: int  # w: robots that only pass messages on, over all paths together


class Slot(NamedTuple):
    """Tasks that are done at the same time around one deployment point."""

    x: float  # Theta, m
    y: float
    duration: float  # of its longest task
    arms: tuple[Arm, ...]


class Schedule(NamedTuple):
    """Slots in the order in which the swarm does them."""

    slots: tuple[Slot, ...]

    @property
    def time(self) -> float:
        """Completion time, (4): the sum of the slots, without travel and eruption."""
        return sum(slot.duration for slot in self.slots)

    @property
    def trip(self) -> float:
        """Way between the deployment points, along the axes, in metres (first factor of (14))."""
        steps = zip(self.slots, self.slots[1:])
        return sum(abs(b.x - a.x) + abs(b.y - a.y) for a, b in steps)

    @property
    def relays(self) -> int:
        """Relays of all arms of all slots."""
        return sum(arm.relays for slot in self.slots for arm in slot.arms)


class Answer(NamedTuple):
    """A schedule, or none yet, with what is proven about the best there can be."""

    objective: str  # "time" or "travel"
    schedule: Schedule | None
    value: float  # of the schedule, in its unit of time or in metres times robots; infinite without one
    bound: float  # no schedule has a smaller value
    seconds: float  # that the work took, s
    proof: str  # which part of the solver made the bound
    ended: str  # "proven", "time limit", "gave up" (what it knows is tried, as far as time allows) or "interrupted"
    time_limit: float | None = None  # Lambda, within which "travel" had to stay: the completion time
    time_bound: float = 0.0  # no schedule has a smaller completion time

    @property
    def gap(self) -> float:
        """Relative distance of value and bound, (value - bound) / value."""
        if self.value <= self.bound or self.value == 0.0:
            return 0.0
        return (self.value - self.bound) / self.value if self.value < float("inf") else float("inf")

    @property
    def excess(self) -> float:
        """How far above the best the value may be at most, as a share of the best; infinite without a bound."""
        if self.value == self.bound:
            return 0.0
        return self.value / self.bound - 1.0 if self.bound > 0.0 else float("inf")

    @property
    def excess_in_words(self) -> str:
        """How good the value is known to be."""
        return f"at most {self.excess:.2%} above the best" if self.bound > 0.0 else "no bound is known yet"

    @property
    def proven(self) -> bool:
        """Whether the schedule is the best there is."""
        return self.ended == "proven"


def first_trip(instance: Instance, schedule: Schedule) -> float:
    """Return the way from the start to the first deployment point, along the axes, m; (14) does not charge it."""
    if not schedule.slots:
        return 0.0
    first = schedule.slots[0]
    return abs(first.x - instance.start[0]) + abs(first.y - instance.start[1])


def travel_cost(instance: Instance, schedule: Schedule, charge_first: bool) -> float:
    """Return the dislocation of a schedule, (14): |N| times the trip plus the length of all arms, m."""
    trip = schedule.trip + (first_trip(instance, schedule) if charge_first else 0.0)
    return instance.robots * trip + instance.spacing / instance.paths * schedule.relays


def as_plain(instance: Instance, answer: Answer, reach: Reach, charge_first: bool) -> dict[str, Any]:
    """Return an answer as plain values, as the JSON file holds it."""
    schedule = answer.schedule
    slots: Sequence[Slot] = schedule.slots if schedule else ()
    return {
        "instance": instance.name,
        "objective": answer.objective,
        "reach": reach.name.lower(),
        "first_hop_charged": charge_first,
        "value": answer.value if schedule else None,
        "lower_bound": answer.bound,
        "gap": answer.gap if schedule else None,
        "proven": answer.proven,
        "proof": answer.proof,
        "ended": answer.ended,
        "seconds": round(answer.seconds, 3),
        "completion_time": schedule.time if schedule else None,
        "completion_time_bound": answer.time_bound,
        "trip_m": schedule.trip if schedule else None,
        "first_trip_m": first_trip(instance, schedule) if schedule else None,
        "relays": schedule.relays if schedule else None,
        "slots": [
            {"x": s.x, "y": s.y, "duration": s.duration, "arms": [arm._asdict() for arm in s.arms]} for s in slots
        ],
    }

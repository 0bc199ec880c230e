"""The checker refuses what cannot be carried out: each fault alone is found."""

import numpy as np
import pytest

from formicarium.scheduling.checker import check
from formicarium.scheduling.instance import Instance, Task, Team
from formicarium.scheduling.schedule import Arm, Schedule, Slot

TEAMS = (Team(6), Team(2, frozenset({"dig"})))
TASKS = (
    Task("near", 1.0, 0.0, 2, 3.0),
    Task("far", 4.0, 0.0, 1, 1.0),
    Task("pit", 0.0, 2.0, 2, 1.0, frozenset({"dig"})),
)
INSTANCE = Instance("three", TEAMS, TASKS, (0.0, 0.0, 5.0, 5.0), (0.0, 0.0), (("far", "pit"),))
FIRST = Slot(1.0, 0.0, 3.0, (Arm("near", 0), Arm("far", 2)))
SECOND = Slot(0.0, 1.0, 1.0, (Arm("pit", 0),))
GOOD = Schedule((FIRST, SECOND))


def faults(*slots, instance=INSTANCE, reach="euclid"):
    return " / ".join(check(instance, Schedule(slots), reach).faults)


def test_a_good_schedule_is_accepted_and_added_up():
    verdict = check(INSTANCE, GOOD, "euclid")
    assert verdict.faults == ()
    assert (verdict.time, verdict.trip, verdict.first_trip, verdict.relays) == (4.0, 2.0, 1.0, 2)


@pytest.mark.parametrize(
    "slots, said",
    [
        ((FIRST,), "pit is never done"),
        ((FIRST, SECOND, SECOND), "pit is done 2 times"),
        ((SECOND, FIRST), "far is not done before pit"),
        ((FIRST._replace(arms=(Arm("near", 0), Arm("far", 1))), SECOND), "far is out of reach"),
        ((FIRST._replace(arms=(Arm("near", 3), Arm("far", 2))), SECOND), "8 robots are needed"),
        ((FIRST._replace(duration=2.0), SECOND), "lasts 2.0"),
        ((FIRST, SECOND._replace(x=-1.0)), "outside the region"),
        ((FIRST, SECOND, Slot(0.0, 0.0, 0.0, ())), "slot 3 is empty"),
    ],
)
def test_each_fault_is_named(slots, said):
    assert said in faults(*slots)


def test_capabilities_are_counted_robot_by_robot():
    """Two diggers cannot dig at two pits at once, whatever the number of robots."""
    two = INSTANCE._replace(tasks=(*TASKS[:2], TASKS[2], TASKS[2]._replace(name="pit 2", y=0.5)), priorities=())
    both = Slot(0.0, 1.0, 1.0, (Arm("pit", 0), Arm("pit 2", 0)))
    assert "2 robots with the right capabilities are lacking" in faults(FIRST, both, instance=two)


def test_the_printed_octagon_reaches_farther_than_the_radio():
    """At 22.5 degrees the octagon around the circle allows 1.08 hops with one (the paper's (7) to (9))."""
    lone = Instance("one", (Team(3),), (Task("t", 1.0, 0.414, 1),), (0.0, 0.0, 2.0, 2.0), (0.0, 0.0))
    slot = Slot(0.0, 0.0, 1.0, (Arm("t", 0),))
    assert faults(slot, instance=lone, reach="printed") == ""
    assert "out of reach" in faults(slot, instance=lone, reach="euclid")
    assert check(lone, Schedule((slot,)), "printed").over_radio == 1


@pytest.mark.parametrize("reach", ["EUCLID", "circle", None])
def test_an_unknown_reach_is_refused(reach):
    with pytest.raises(ValueError, match="must be one of printed, inscribed, euclid"):
        check(INSTANCE, GOOD, reach)
    with pytest.raises(ValueError, match="time_limit"):
        check(INSTANCE, GOOD, "euclid", float("nan"))


@pytest.mark.parametrize("wrong", [FIRST._replace(x=float("nan")), FIRST._replace(duration=float("inf")),
                                   FIRST._replace(x=None), FIRST._replace(y="1"),
                                   FIRST._replace(arms=(Arm("near", True), Arm("far", 2))),
                                   FIRST._replace(arms=(Arm("near", "0"), Arm("far", 2.5)))])  # fmt: skip
def test_what_is_no_number_is_a_fault(wrong):
    assert "slot 1: " in faults(wrong, SECOND)


def test_numbers_of_numpy_are_numbers():
    """Of 64 bits, in which a far arm counted in nanometres would overflow."""
    arms = tuple(arm._replace(relays=np.int64(arm.relays)) for arm in FIRST.arms)
    assert not check(INSTANCE, Schedule((FIRST._replace(x=np.float64(FIRST.x), arms=arms), SECOND)), "printed").faults


def test_thousands_of_robots_are_counted():
    crowd = INSTANCE._replace(teams=(Team(3000), Team(2000, frozenset({"dig"}))), priorities=())
    crowd = crowd._replace(tasks=(Task("near", 1.0, 0.0, 2400, 3.0), TASKS[1], TASKS[2]._replace(robots=2001)))
    said = faults(FIRST._replace(arms=(Arm("near", 0), Arm("far", 2))), SECOND, instance=crowd)
    assert said == "slot 2: 1 robots with the right capabilities are lacking"

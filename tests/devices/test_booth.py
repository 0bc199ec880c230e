"""The booth: who is in it, how one gets in, and what is said inside (TS-20 to TS-30)."""

import math

import numpy as np
import pytest

from devices.bay import FREE, HALF, Bay, leave, visit
from formicarium.devices.booth import BAY_HALF_WIDTH
from formicarium.robots.infrared import CLAIM, FAILURE, HEARD_HIGH, HEARD_LOW, HIGH_HALF, LOW_HALF, SUCCESS, WORKING
from formicarium.robots.records import SILENCE, Colour

# light barriers


def sweep(bay, depths):
    """Return at which depths a robot that is moved along the axis counts as present."""
    seen = []
    for depth in depths:
        bay.put(0, depth)
        bay.serve()
        seen.append(bay.occupied)
    return np.array(seen)


def test_presence_begins_when_the_front_barrier_is_free_and_the_back_one_blocked():
    depths = np.arange(-0.12, 0.0011, 0.0005)
    present = sweep(Bay((FREE, 0)), depths)
    assert depths[present].min() == pytest.approx(-0.017, abs=6e-4)  # front barrier -0.052, radius 0.035
    assert present[depths > -0.0165].all()


def test_presence_ends_when_both_barriers_are_free_and_not_before():
    depths = np.arange(0.001, -0.12, -0.0005)
    present = sweep(Bay((FREE, 0)), depths)
    assert depths[present].min() == pytest.approx(-0.087, abs=6e-4)
    assert present[depths > -0.0865].all()


def test_a_robot_that_stops_half_way_in_is_not_present():
    bay = Bay((FREE, 0))
    assert not sweep(bay, [-0.08, -0.05, -0.03, -0.02, -0.02, -0.05, -0.1]).any()


def test_a_robot_beside_or_behind_the_booth_interrupts_nothing():
    bay = Bay((FREE, 0))
    for side in (-0.2, -0.0955, 0.0955, 0.2):
        for depth in np.arange(-0.1, 0.1, 0.005):
            bay.put(0, depth, side)
            bay.serve()
            assert not bay.occupied
    assert not sweep(bay, [0.0955, 0.12]).any()


# lights


def test_lights_show_the_task_unless_a_robot_is_inside():
    bay = Bay((FREE, 0), colour=Colour.GREEN)
    bay.serve()
    assert bay.lights.colour.tolist() == [Colour.GREEN] * 3
    bay.put(0, 0.0)
    bay.serve()
    assert bay.occupied and not (bay.lights.colour != Colour.OFF).any()
    leave(bay)
    assert bay.lights.colour.tolist() == [Colour.GREEN] * 3


# the way in


def inside(track):
    return (np.abs(track[:, 0]) < HALF) & (np.abs(track[:, 1]) < HALF)


@pytest.mark.parametrize("degrees", range(0, 360, 10))
def test_a_robot_gets_in_by_the_mouth_or_not_at_all(degrees):
    angle = math.radians(degrees)
    bay = Bay((FREE, 0))
    bay.put(0, 0.25 * math.cos(angle), 0.25 * math.sin(angle), angle + math.pi)
    track = bay.drive(0, 0.12, 60)
    entries = np.flatnonzero(inside(track)[1:] & ~inside(track)[:-1])
    for cycle in entries:
        assert track[cycle, 0] <= -HALF and abs(track[cycle + 1, 1]) < BAY_HALF_WIDTH
    if degrees == 180:
        assert len(entries) == 1
    if abs(degrees - 180) > 60:
        assert len(entries) == 0


@pytest.mark.parametrize("side", [-0.012, 0.0, 0.005, 0.014])
def test_a_robot_that_drives_in_is_stopped_by_the_back_wall_and_present(side):
    bay = Bay((-0.2, side))
    track = bay.drive(0, 0.05, 80)
    bay.serve()
    assert track[-1, 0] == pytest.approx(0.001, abs=0.0005)
    assert bay.occupied and bay.booths[0].visitor == 0


def test_a_second_robot_cannot_get_in():
    bay = Bay((0.0, 0.0), (-0.25, 0.01))
    bay.serve()
    track = bay.drive(1, 0.12, 200)
    assert not inside(track).any()
    bay.serve()
    assert bay.occupied and bay.booths[0].visitor == 0
    assert bay.place(0)[0] < 0.002  # and the first is not pushed through the wall


# the exchange


def test_the_exchange_goes_step_by_step():
    bay = Bay((FREE, 0), identity=0xA7, task_time=5.0)
    bay.put(0, 0.0)
    assert bay.serve() == SILENCE  # nobody has said anything
    bay.say(HIGH_HALF | 0xA)
    assert [bay.serve(), bay.serve()] == [SILENCE, HEARD_HIGH]
    bay.say(LOW_HALF | 0x7)
    assert [bay.serve(), bay.serve()] == [SILENCE, HEARD_LOW]
    bay.say(CLAIM | 1)
    assert [bay.serve(), bay.serve()] == [SILENCE, WORKING]
    assert bay.coordinator[0].done.sum() == 0
    rest = [bay.serve() for _ in range(60)]
    assert rest.index(SUCCESS) + 7 == 50
    assert set(rest[: rest.index(SUCCESS)]) == {SILENCE, WORKING}
    assert bay.coordinator[0].done[0xA7] == 1 and bay.coordinator[0].done.sum() == 1


@pytest.mark.parametrize("period, cycles", [(0.1, 1), (0.2, 2), (0.5, 5)])
def test_the_booth_sends_a_byte_once_a_period(period, cycles):
    heard = np.array(visit(Bay((FREE, 0), byte_period=period)))
    assert np.flatnonzero(heard != SILENCE).tolist() == list(range(0, 80, cycles))


@pytest.mark.parametrize("task_time", [1.0, 3.0, 5.0, 7.0])
def test_the_verdict_comes_when_the_task_time_is_over_and_not_before(task_time):
    heard = visit(Bay((FREE, 0), task_time=task_time))
    assert heard.index(SUCCESS) == round(10 * task_time)
    assert FAILURE not in heard


def test_who_leaves_before_the_task_time_has_done_nothing():
    bay = Bay((FREE, 0))
    assert SUCCESS not in visit(bay, cycles=49)
    leave(bay)
    assert not bay.occupied and bay.booths[0].visitor == -1
    assert bay.coordinator[0].done.sum() == 0 and bay.booths[0].judged == 0


def test_one_visit_is_one_execution_however_long_it_lasts():
    bay = Bay((FREE, 0))
    visit(bay, cycles=400)
    assert bay.coordinator[0].done[0xA7] == 1 and bay.coordinator[0].faults == 0


def test_who_has_not_claimed_a_task_gets_no_verdict():
    bay = Bay((0.0, 0.0))
    bay.say(CLAIM | 1)  # without an identity
    assert {bay.serve() for _ in range(100)} == {SILENCE}
    bay.say(HIGH_HALF | 0xA)
    assert {bay.serve() for _ in range(100)} == {SILENCE, HEARD_HIGH}
    assert bay.coordinator[0].done.sum() == 0 and bay.booths[0].judged == 0


def test_a_late_claim_is_judged_at_once_for_the_time_is_over():
    bay = Bay((FREE, 0))
    visit(bay, cycles=0)
    for _ in range(100):
        bay.serve()
    assert visit(bay, cycles=8)[-2:].count(SUCCESS) == 1


def test_a_visit_begins_anew_when_the_robot_has_left():
    bay = Bay((FREE, 0))
    visit(bay)
    leave(bay)
    bay.put(0, 0.0)
    bay.say(CLAIM | 2)  # as if identity and task were still known
    assert {bay.serve() for _ in range(80)} == {SILENCE}


def test_after_leaving_a_robot_hears_nothing():
    bay = Bay((FREE, 0))
    assert visit(bay)[-2] == SUCCESS or visit(bay)[-1] == SUCCESS
    leave(bay)
    assert {bay.serve() for _ in range(10)} == {SILENCE}


def test_only_the_robot_in_the_bay_is_heard():
    bay = Bay((0.0, 0.0), (-0.08, 0.0))
    bay.say(HIGH_HALF | 0xA, i=1)
    assert {bay.serve() for _ in range(20)} == {SILENCE}
    assert bay.robots[1].infrared_heard == SILENCE


def test_a_mute_visit_gets_no_answer_and_is_no_execution():
    bay = Bay((FREE, 0), exchange_failure=1.0)
    assert set(visit(bay, cycles=200)) == {SILENCE}
    assert bay.booths[0].mute == 1 and bay.booths[0].judged == 0
    assert bay.coordinator[0].done.sum() == 0
    assert bay.occupied and not bay.lit  # it was there all the same


def test_one_visit_in_fifty_is_mute():
    bay = Bay((FREE, 0), exchange_failure=0.02)
    mute = []
    for _ in range(6000):
        bay.put(0, 0.0)
        bay.serve()
        mute.append(bay.booths[0].mute)
        bay.put(0, FREE)
        bay.serve()
    assert np.mean(mute) == pytest.approx(0.02, abs=4 * math.sqrt(0.02 * 0.98 / 6000))

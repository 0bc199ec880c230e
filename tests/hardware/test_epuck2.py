"""The driver of the e-puck2 against a robot that speaks the published protocol; none of it has met hardware."""

import sys
import time

import numpy as np
import pytest

if sys.platform == "win32":
    pytest.skip("no pseudo-terminals", allow_module_level=True)

from formicarium.commands.layout.own_swarm.behaviour import MEMORY, decide
from formicarium.commands.layout.own_swarm.parameters import Parameters
from formicarium.control.moves import drive as wheels
from formicarium.hardware.driving import drive
from formicarium.hardware.epuck2 import EPuck2, GarbledAnswer
from formicarium.robots.all_senses import READING
from formicarium.robots.records import COMMAND, SILENCE, Colour
from hardware.emulated import EmulatedEPuck2, OnSerial, OnTcp


@pytest.fixture(params=["wifi", "serial"])
def met(request):
    """Return (the emulated robot, a driver that has it on the line)."""
    robot = EmulatedEPuck2()
    if request.param == "wifi":
        end = OnTcp(robot)
        driver = EPuck2.over_wifi("127.0.0.1", 42, end.port, patience=0.5)
    else:
        end = OnSerial(robot)
        driver = EPuck2.over_serial(end.port, 42, patience=0.5)
    yield robot, driver
    driver.line.close()
    end.close()


def record(layout):
    made = np.zeros(1, layout).view(np.recarray)[0]
    if "infrared" in layout.names:
        made.infrared = SILENCE
    return made


def sensed(driver):
    reading = record(READING)
    driver.sense(reading)
    return reading


def test_raw_values_become_a_reading(met):
    robot, driver = met
    robot.proximity = [0, 4095, 2048, 0, 0, 0, 0, 5000]
    robot.ambient, robot.ground = [4095, 0, 1024, 4095, 4095, 4095, 4095, 4095], [0, 1023, 512]
    reading = sensed(driver)
    assert (reading.identity, reading.cycle, reading.infrared) == (42, 0, SILENCE)
    assert reading.proximity == pytest.approx([0, 1, 0.5, 0, 0, 0, 0, 1], abs=1e-3)
    assert reading.light == pytest.approx([0, 1, 0.75, 0, 0, 0, 0, 0], abs=1e-3)
    assert reading.ground == pytest.approx([0, 1, 0.5], abs=1e-3)
    assert (reading.blob_count, reading.packet_count, reading.left_steps) == (0, 0, 0)
    assert sensed(driver).cycle == 1


def test_wheel_steps_go_on_where_the_counter_goes_round(met):
    robot, driver = met
    robot.position = [32_000.0, -32_000.0]
    assert sensed(driver).left_steps == 0
    for k in range(1, 4):
        robot.position = [32_000.0 + 10_000 * k, -32_000.0 - 20_000 * k]
        reading = sensed(driver)
        assert (reading.left_steps, reading.right_steps) == (10_000 * k, -20_000 * k)


@pytest.mark.parametrize(("speed", "steps"), [(0.0, 0), (0.05, 388), (-0.05, -388), (1.0, 932), (-1.0, -932)])
def test_a_speed_at_the_rim_is_so_many_steps_a_second(met, speed, steps):
    """1,000 steps are a turn, 2 pi 0.0205 m; the e-puck's wheels run at most 0.12 m/s."""
    robot, driver = met
    command = record(COMMAND)
    command.left, command.right = speed, -speed
    driver.act(command)
    assert robot.speeds == (steps, -steps)


def test_colours_are_shown_and_what_it_cannot_do_is_counted(met):
    robot, driver = met
    command = record(COMMAND)
    command.colour = Colour.ORANGE
    driver.act(command)
    assert robot.lights == [(100, 40, 0)] * 4 and not driver.ignored.total()
    command.enabled[3], command.infrared = 1, 0x20
    driver.act(command)
    assert driver.ignored == {"radio": 1, "infrared": 1}
    for field, value, words in (
        ("left", np.nan, "wheel speeds nan and 0.0 m/s"),
        ("colour", 9, "colour = 9: must be 0"),
    ):
        spoilt = record(COMMAND)
        spoilt[field] = value
        with pytest.raises(ValueError, match=f"robot 42: {words}"):
            driver.act(spoilt)


def test_a_behaviour_drives_it_and_the_context_stops_it(met):
    robot, driver = met
    robot.proximity[7] = 4095  # left of the front
    seen = []

    def turn_away(reading, memory, command, speed):
        memory["count"] += 1
        wheels(command, speed, 4.0 * (reading.proximity[0] - reading.proximity[7]), 0.053)
        command.colour = Colour.GREEN

    memory = np.zeros(1, [("count", "i8")])[0]
    with driver:
        done = drive(
            driver, turn_away, memory, 0.05, cycles=5, cycle_time=0.05, look=lambda r, c: seen.append(int(r.left_steps))
        )
        assert robot.speeds[0] > robot.speeds[1]  # away to the right
        assert robot.lights == [(0, 100, 0)] * 4
    assert done.cycles == memory["count"] == len(seen) == 5 and np.all(np.diff(seen) > 0)
    until = time.monotonic() + 2.0
    while robot.speeds != (0, 0) and time.monotonic() < until:
        time.sleep(0.01)
    assert robot.speeds == (0, 0) and robot.lights == [(0, 0, 0)] * 4


def test_what_is_laid_out_drives_it_as_the_guide_says(met):
    """Nobody is heard, so it walks; something near on the left makes it turn to the right."""
    robot, driver = met
    parameters = Parameters()
    tables = (parameters.behaviour.record()[0], parameters.epuck.record()[0], 0.1)
    memory = record(MEMORY)
    drive(driver, decide, memory, *tables, cycles=1, cycle_time=0.01)
    assert robot.speeds == (621, 621)  # 0.08 m/s
    robot.proximity[7] = 4095
    drive(driver, decide, memory, *tables, cycles=1, cycle_time=0.01)
    assert robot.speeds == (411, -411) and memory.role == 0  # 2 rad/s half a wheel distance from the middle
    assert driver.ignored["radio"] == 2


def test_cycles_that_end_late_are_counted(met):
    _, driver = met
    done = drive(driver, lambda *_: time.sleep(0.03), None, cycles=3, cycle_time=0.01)
    assert done.late == done.cycles == 3 and 0.02 < done.latest < 0.5
    with pytest.raises(ValueError, match="cycle_time = 0: must be seconds above 0"):
        drive(driver, lambda *_: None, None, cycles=3, cycle_time=0)


def test_who_does_not_answer_is_told_from_who_has_hung_up(met):
    robot, driver = met
    sensed(driver)
    robot.silent_after = 1
    with pytest.raises(TimeoutError, match=r"0 of \d+ bytes have come within 0.5 s"):
        sensed(driver)
    robot.hang_up_after = 1
    with pytest.raises(ConnectionError, match="hung up after 0 of"):
        sensed(driver)


def test_another_packet_is_no_reading():
    robot = EmulatedEPuck2()
    end = OnTcp(robot)
    driver = EPuck2.over_wifi("127.0.0.1", 7, end.port)
    robot.babbles_after = 0
    with pytest.raises(GarbledAnswer, match="robot 7 answers with packet 0x03"):
        sensed(driver)
    driver.line.close()
    end.close()


def test_an_answer_in_small_pieces_is_one_answer():
    robot = EmulatedEPuck2()
    robot.dribbles, robot.ground = True, [1023, 0, 1023]
    end = OnTcp(robot)
    with EPuck2.over_wifi("127.0.0.1", 7, end.port) as driver:
        assert sensed(driver).ground.tolist() == [1.0, 0.0, 1.0]
    end.close()


def test_identities_are_those_of_robots(met):
    _, driver = met
    with pytest.raises(ValueError, match="identity = 0: must be 1 to 255"):
        EPuck2(driver.line, driver.framing, 0)

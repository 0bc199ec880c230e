"""A behaviour on a real robot, with a clock on the wall: sense, decide, act, wait for the next cycle."""

import time
from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

from formicarium.hardware.epuck2 import EPuck2
from formicarium.robots.all_senses import READING
from formicarium.robots.records import COMMAND, SILENCE


class Driven(NamedTuple):
    """How a behaviour kept its time."""

    cycles: int  # that have passed
    late: int  # of them ended after their time
    latest: float  # s, by how much the worst


def drive(
    robot: EPuck2,
    decide: Callable[..., None],
    memory: Any,
    *tables: Any,
    cycles: int,
    cycle_time: float = 0.1,
    look: Callable[[Any, Any], None] | None = None,
) -> Driven:
    """Let a behaviour command a robot for so many control cycles.

    The order is the simulator's: what is decided from a Reading is done before the next one is taken, so a cycle is two
    exchanges with the robot. A late cycle delays those after it; none is left out.

    Args:
        robot: to be commanded.
        decide: called as decide(reading, memory, command, *tables), as the simulator does.
        memory: of the behaviour, one record, changed in place.
        tables: what the behaviour is told before the robot is switched on.
        cycles: that pass.
        cycle_time: s.
        look: called after each decision with (reading, command), for logs.

    Raises:
        ValueError: if cycle_time is not above 0 s, or a command is no number.
        TimeoutError, ConnectionError: if the robot does not answer; it may still be moving then.
    """
    if not cycle_time > 0:
        raise ValueError(f"cycle_time = {cycle_time!r}: must be seconds above 0")
    reading, command = np.zeros(1, READING).view(np.recarray)[0], np.zeros(1, COMMAND).view(np.recarray)[0]
    command.infrared = SILENCE
    due, late, latest = time.monotonic(), 0, 0.0
    for _ in range(cycles):
        robot.sense(reading)
        decide(reading, memory, command, *tables)
        robot.act(command)
        if look is not None:
            look(reading, command)
        due += cycle_time
        left = due - time.monotonic()
        if left > 0:
            time.sleep(left)
        else:
            late, latest, due = late + 1, max(latest, -left), due - left
    return Driven(cycles, late, latest)

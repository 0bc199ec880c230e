"""One cycle of one robot: walk until enough others are near, rest, and sometimes leave."""

from enum import IntEnum

import numpy as np
from formicarium.compiled import compiled
from formicarium.control.moves import drive, stop
from formicarium.control.speech import be_quiet, broadcast
from formicarium.robots.records import Colour
from formicarium.streams import advanced, uniform


class Role(IntEnum):
    """What a robot is at."""

    WALKING = 0
    RESTING = 1


# What a robot remembers. Everything starts at zero, but for draws.
MEMORY = np.dtype(
    [
        ("role", "i8"),  # Role
        ("draws", "u8"),  # its own random stream
        ("turn_until", "i8"),  # cycle
        ("turn_side", "f8"),  # 1 left, -1 right
    ],
    align=True,
)


@compiled
def decide(reading, memory, command, table, epuck, cycle_time):
    """Read, remember, decide.

    Args:
        reading: READING record of formicarium.robots.all_senses, what the robot senses now.
        memory: MEMORY record, changed in place.
        command: COMMAND record of formicarium.robots.records, written.
        table: record of the numbers in Behaviour.
        epuck: record of the robot's own table.
        cycle_time: seconds.
    """
    be_quiet(command)
    command.payload[0, 0] = reading.identity  # four bytes to say what one likes
    broadcast(command)
    neighbours = near(reading, table.near)
    if memory.role == Role.WALKING:
        walk(reading, memory, command, table, epuck, cycle_time)
        if chance(memory, table.stay * neighbours * cycle_time):
            memory.role = Role.RESTING
    else:
        stop(command)
        command.colour = Colour.GREEN
        if chance(memory, table.leave / (1.0 + neighbours) ** 2 * cycle_time):
            memory.role = Role.WALKING


@compiled
def near(reading, distance):
    """Return how many robots are heard from nearer than ``distance`` m."""
    count = 0
    for k in range(reading.packet_count):
        if reading.packets[k].distance < distance:
            count += 1
    return count


@compiled
def walk(reading, memory, command, table, epuck, cycle_time):
    """Drive straight on, and turn for a random while where something is ahead."""
    right = reading.proximity[0] + reading.proximity[1]
    left = reading.proximity[6] + reading.proximity[7]
    if left + right > 0.5 and reading.cycle >= memory.turn_until:
        memory.draws = advanced(memory.draws)
        memory.turn_until = reading.cycle + int((0.5 + uniform(memory.draws)) / cycle_time)
        memory.turn_side = -1.0 if left > right else 1.0
    if reading.cycle < memory.turn_until:
        drive(command, 0.0, memory.turn_side * table.turn_rate, epuck.wheel_distance)
    else:
        drive(command, table.speed, 0.0, epuck.wheel_distance)


@compiled
def chance(memory, probability):
    """Draw: true with this probability."""
    memory.draws = advanced(memory.draws)
    return uniform(memory.draws) < probability

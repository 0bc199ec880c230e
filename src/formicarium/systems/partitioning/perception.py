"""What a robot makes of its readings: where it is by the floor, which way it faces by the lamp, what it sees."""

import math

import numpy as np

from formicarium.angles import wrapped
from formicarium.compiled import compiled
from formicarium.control.odometry import carry, measure
from formicarium.robots.epuck import PROXIMITY_COSINES, PROXIMITY_SINES
from formicarium.systems.partitioning.memory import Ground

ARCS = np.array([33.5, 36.5, 50.0, 60.0, 60.0, 50.0, 36.5, 33.5])  # degrees, of the sensors at PROXIMITY_ANGLES


@compiled
def perceive(reading, memory, table, chart, epuck):
    """Bring odometry, ground, path, lamp and heading up to date with this cycle's readings."""
    measure(memory.odometer, reading, epuck)
    carry(memory.target, memory.odometer)
    memory.compass = wrapped(memory.compass + memory.odometer.turn)
    feel_ground(reading, memory, table, chart)
    find_lamp(reading, memory)
    keep_heading(memory, table, chart)


@compiled
def feel_ground(reading, memory, table, chart):
    """Tell where the robot is by the sensors that are not on the path, and on which side the path is.

    Where all three sensors are on the path, or two disagree, the robot is where it was: at a border, two shades do not
    make a third.
    """
    off_path = 0
    place = -1
    for k in range(len(reading.ground)):
        if reading.ground[k] < table.path_value:
            off_path += 1
            here = nearest_shade(reading.ground[k], chart)
            place = here if off_path == 1 or here == place else len(chart.shades)
    if 0 <= place < len(chart.shades):
        memory.ground = place
    if off_path < len(reading.ground):
        memory.path_seen = reading.cycle
        left = reading.ground[0] >= table.path_value
        right = reading.ground[len(reading.ground) - 1] >= table.path_value
        if left != right:
            memory.path_side = 1 if left else -1
        elif left:
            memory.path_side = 0


@compiled
def nearest_shade(value, chart):
    """Return the place whose shade is nearest to a ground sensor's value."""
    best = 0
    for place in range(1, len(chart.shades)):
        if math.fabs(chart.shades[place] - value) < math.fabs(chart.shades[best] - value):
            best = place
    return best


@compiled
def find_lamp(reading, memory):
    """Take the lamp to be where the light sensors' readings, as vectors, add up to.

    Each counts by the arc it stands for, half the way to its neighbours: the sensors are denser ahead.
    """
    x = 0.0
    y = 0.0
    for k in range(len(reading.light)):
        x += ARCS[k] * reading.light[k] * PROXIMITY_COSINES[k]
        y += ARCS[k] * reading.light[k] * PROXIMITY_SINES[k]
    memory.lamp = math.atan2(y, x)


@compiled
def keep_heading(memory, table, chart):
    """Correct the reckoned heading by the lamp where its direction is known: in both areas."""
    place = memory.ground
    if place < 0 or place == Ground.LEFT_LEG or place == Ground.BOTTOM or place == Ground.RIGHT_LEG:
        return
    if place == Ground.MIDDLE_LEG or place == Ground.CROSSING:
        return
    by_lamp = chart.lamps[place] - memory.lamp
    if memory.oriented == 0:
        memory.compass = wrapped(by_lamp)
        memory.oriented = 1
    memory.compass = wrapped(memory.compass + table.compass_gain * wrapped(by_lamp - memory.compass))


@compiled
def nearest_blob(reading, colour):
    """Return the number of the nearest light of a colour in view, -1 if there is none."""
    best = -1
    for k in range(reading.blob_count):
        if reading.blobs[k].colour == colour and (best < 0 or reading.blobs[k].distance < reading.blobs[best].distance):
            best = k
    return best

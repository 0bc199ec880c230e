"""Every robot and every sensor errs on its own (T29), and repeats its errors when the trial is repeated."""

import math

import numpy as np

from formicarium.physics.world import chain
from formicarium.robots.epuck import PROXIMITY_ANGLES
from formicarium.robots.records import Colour
from robots.stage import Stage

ROBOTS = 5
CYCLES = 1500


def errors(seed=1, cycles=CYCLES):
    """Return what five equally placed robots read of everything, one row a sensor, one column a cycle.

    Each stands before a wall and has its own partner, lit and speaking, that the other four cannot perceive.
    """
    places = [(0.0, 2.0 * k) for k in range(ROBOTS)] + [(0.3, 2.0 * k) for k in range(ROBOTS)]
    headings = [math.pi - PROXIMITY_ANGLES[0]] * ROBOTS + [0.0] * ROBOTS
    stage = Stage(places, headings, chain([(-0.055, -1), (-0.055, 20)]), seed=seed, radio_loss=0.0, camera_miss=0.0)
    for k in range(ROBOTS):
        stage.say(ROBOTS + k, [0, 0, 0, 0])
        stage.commands[ROBOTS + k].colour = Colour.CYAN
    rows = []
    for cycle in range(cycles):
        for k in range(ROBOTS):
            packet, blob, drive = stage.hear(k, cycle)[0], stage.look(k, cycle)[0], stage.wheels(0.05, 0.05, k, cycle)
            rows.append([packet.distance, packet.bearing, blob.distance, blob.bearing, stage.feel(k, cycle)[0], *drive])
    return np.array(rows).reshape(cycles, -1).T


def test_no_two_robots_and_no_two_sensors_err_alike():
    rows = errors()
    likeness = np.corrcoef(rows) - np.eye(len(rows))
    assert len(rows) == 7 * ROBOTS
    assert np.abs(likeness).max() < 5 / math.sqrt(CYCLES)
    late = np.corrcoef(rows[:, 1:], rows[:, :-1])[: len(rows), len(rows) :]  # this cycle's against the last one's
    assert np.abs(late).max() < 5 / math.sqrt(CYCLES)


def test_the_same_seed_errs_alike_and_another_does_not():
    assert np.array_equal(errors(3, 20), errors(3, 20))
    assert not np.isclose(errors(3, 20), errors(4, 20)).any()

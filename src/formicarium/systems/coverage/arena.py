"""An open floor with tasks on it. The paper's arena is 30 m wide and has no walls (ST-23)."""

import math
from typing import NamedTuple

import numpy as np

from formicarium.physics.records import records
from formicarium.robots.footbot import BEACON
from formicarium.streams import generator
from formicarium.systems.coverage.parameters import CoverageParameters

HALF_SIDE = 15.0  # m, of the paper's arena
KEPT_OFF = 0.05  # share of the side that random tasks keep off the edge [notebook]
VIEW = 1.5  # m, shown round whatever is there


class Arena(NamedTuple):
    """Where things are, in the world's frame: the master starts at the origin and heads along x."""

    point: tuple[float, float]  # m, point of deployment
    beacons: np.recarray  # BEACON (T,)
    corners: np.ndarray  # (4, 2) m, of what is shown


def make_arena(p: CoverageParameters, seed: int) -> Arena:
    """Return the tasks of a trial; only a random layout depends on the seed."""
    t = p.tasks
    travel = t.travel if t.programme == "tour" else 0.0
    point = (travel * math.cos(t.travel_direction), travel * math.sin(t.travel_direction))
    beacons = records(BEACON, t.count)
    draws = generator(seed, "tasks")
    for k, beacon in enumerate(beacons):
        if t.pattern == "random":
            beacon.x, beacon.y = (draws.uniform(KEPT_OFF, 1.0 - KEPT_OFF, 2) - 0.5) * t.side
        else:
            way = t.first_direction + 2.0 * math.pi * k / t.count
            beacon.x, beacon.y = point[0] + t.distance * math.cos(way), point[1] + t.distance * math.sin(way)
        beacon.arm = k + 1
    half = start_half_side(p)
    xs, ys = [*beacons.x, -half, half, point[0]], [*beacons.y, -half, half, point[1]]
    left, right, bottom, top = min(xs) - VIEW, max(xs) + VIEW, min(ys) - VIEW, max(ys) + VIEW
    return Arena(point, beacons, np.array([(left, bottom), (right, bottom), (right, top), (left, top)]))


def start_half_side(p: CoverageParameters) -> float:
    """Return half the side of the square in which robots start, larger for a crowd (m)."""
    return p.swarm.half_side * math.sqrt(max(1.0, p.swarm.robots / p.swarm.crowd))


def circle(x: float, y: float, radius: float, corners: int = 24) -> np.ndarray:
    """Return an outline to draw round a place (m)."""
    angles = np.linspace(0.0, 2.0 * math.pi, corners, endpoint=False)
    return np.column_stack([x + radius * np.cos(angles), y + radius * np.sin(angles)])

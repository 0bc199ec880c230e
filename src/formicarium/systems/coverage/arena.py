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


class Site(NamedTuple):
    """Where the arms of one slot begin, and the places of its tasks among the beacons."""

    point: tuple[float, float]  # m, point of deployment
    tasks: range


class Arena(NamedTuple):
    """Where things are, in the world's frame: the master starts at the origin and heads along x."""

    sites: tuple[Site, ...]  # one a slot
    beacons: np.recarray  # BEACON (T,), slot by slot
    corners: np.ndarray  # (4, 2) m, of what is shown


def make_arena(p: CoverageParameters, seed: int) -> Arena:
    """Return the tasks of a trial; only a random layout depends on the seed."""
    if p.tasks.programme == "mission":
        return planned_arena(p)
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
        beacon.task = k + 1
    sites = (Site(point, range(t.count)),)
    return Arena(sites, beacons, view_of(p, sites, beacons))


def planned_arena(p: CoverageParameters) -> Arena:
    """Return the tasks of a mission, numbered slot by slot from 1."""
    beacons = records(BEACON, len(p.mission.tasks))
    for k, (beacon, task) in enumerate(zip(beacons, p.mission.tasks, strict=True)):
        beacon.x, beacon.y, beacon.task = task.x, task.y, k + 1
    sites: list[Site] = []
    for slot in p.mission.slots:
        first = sites[-1].tasks.stop if sites else 0
        sites.append(Site((slot.x, slot.y), range(first, first + len(slot.tasks))))
    return Arena(tuple(sites), beacons, view_of(p, tuple(sites), beacons))


def view_of(p: CoverageParameters, sites: tuple[Site, ...], beacons: np.recarray) -> np.ndarray:
    """Return the corners (4, 2) of what is shown: start, points of deployment and tasks (m)."""
    half = start_half_side(p)
    xs = [*beacons.x, -half, half, *(site.point[0] for site in sites)]
    ys = [*beacons.y, -half, half, *(site.point[1] for site in sites)]
    left, right, bottom, top = min(xs) - VIEW, max(xs) + VIEW, min(ys) - VIEW, max(ys) + VIEW
    return np.array([(left, bottom), (right, bottom), (right, top), (left, top)])


def start_half_side(p: CoverageParameters) -> float:
    """Return half the side of the square in which robots start, larger for a crowd (m)."""
    return p.swarm.half_side * math.sqrt(max(1.0, p.swarm.robots / p.swarm.crowd))


def circle(x: float, y: float, radius: float, corners: int = 24) -> np.ndarray:
    """Return an outline to draw round a place (m)."""
    angles = np.linspace(0.0, 2.0 * math.pi, corners, endpoint=False)
    return np.column_stack([x + radius * np.cos(angles), y + radius * np.sin(angles)])

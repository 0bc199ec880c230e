"""Setting up a trial: robots in their places, identities and random streams handed out."""

from typing import NamedTuple

import numpy as np

from formicarium.physics.records import records
from formicarium.physics.world import make_bodies
from formicarium.robots.records import ROBOT, SILENCE
from formicarium.streams import generator, stream
from formicarium.tables import Table

IDENTITIES = 255  # robots carry one byte, 0 means nobody
PLACING_ATTEMPTS = 20_000
NEVER_DIES = 10**12  # cycles
APART = 0.08  # m, least distance between two robots at the start (U42)
WALL_MARGIN = 0.06  # m, and between a robot and a wall


class NoRoom(ValueError):
    """The robots do not fit into the arena."""


class Crew(NamedTuple):
    """The robots of a trial: their bodies and their records, at the same places of both arrays."""

    bodies: np.recarray  # BODY (N,)
    robots: np.recarray  # ROBOT (N,)


def inside_convex(corners: np.ndarray, x: float, y: float, margin: float) -> bool:
    """Tell whether (x, y) is inside a counter-clockwise convex polygon, ``margin`` metres from its sides."""
    following = np.roll(corners, -1, axis=0)
    along = following - corners
    lengths = np.hypot(along[:, 0], along[:, 1])
    distances = (along[:, 0] * (y - corners[:, 1]) - along[:, 1] * (x - corners[:, 0])) / lengths
    return bool(distances.min() >= margin)


def random_places(
    count: int,
    corners: np.ndarray,
    keep_off: np.ndarray,
    off: float,
    seed: int,
    apart: float = APART,
    margin: float = WALL_MARGIN,
) -> np.ndarray:
    """Return ``count`` places (x, y, heading), uniform, ``apart`` from each other and ``margin`` from walls (U42).

    No place is within ``off`` metres of the points ``keep_off`` (K, 2).

    Raises:
        NoRoom: if they do not fit.
    """
    draws = generator(seed, "layout")
    low, high = corners.min(axis=0), corners.max(axis=0)
    places: list[tuple[float, float, float]] = []
    for _ in range(PLACING_ATTEMPTS):
        if len(places) == count:
            break
        x, y = draws.uniform(low, high)
        taken = any((x - a) ** 2 + (y - b) ** 2 < apart**2 for a, b, _ in places)
        near = any((x - a) ** 2 + (y - b) ** 2 < off**2 for a, b in keep_off)
        if not taken and not near and inside_convex(corners, x, y, margin):
            places.append((x, y, draws.uniform(-np.pi, np.pi)))
    if len(places) < count:
        raise NoRoom(f"{count} robots do not fit into the arena: there is room for about {len(places)}")
    return np.array(places).reshape(count, 3)


def make_crew(
    places: np.ndarray,
    epuck: Table,
    seed: int,
    failure_rate: float,
    cycle_time: float,
    deaths: tuple[tuple[int, float], ...] = (),
    storage: np.ndarray | None = None,
) -> Crew:
    """Return the robots at their places, with identities, noise streams and times of death.

    Args:
        places: (N, 3) x, y, heading.
        epuck: the robot's table, with radius, mass, inertia and limits of its drive.
        seed: of the trial.
        failure_rate: deaths per robot and second, 0 for none.
        cycle_time: seconds.
        deaths: (number of the robot, 1..N; seconds) of robots that die at a set time.
        storage: where robot k is kept, a permutation of 0..N-1. Nothing but the order in memory depends on it.
    """
    count = len(places)
    draws = generator(seed, "identities")
    identities = draws.permutation(np.arange(1, IDENTITIES + 1))[:count]
    lives = generator(seed, "failures").exponential(1.0, count)
    bodies = make_bodies(count)
    robots = records(ROBOT, count)
    where = np.arange(count) if storage is None else storage
    for key in range(count):
        body, robot = bodies[where[key]], robots[where[key]]
        body.x, body.y, body.heading = places[key]
        body.key = key
        for name in ("radius", "mass", "inertia", "force_limit", "torque_limit"):
            body[name] = getattr(epuck, name)
        robot.identity = identities[key]
        robot.key = key
        robot.alive = 1
        robot.dies_at = int(min(lives[key] / failure_rate / cycle_time, NEVER_DIES)) if failure_rate > 0 else -1
        robot.noise = stream(seed, "noise", key)
        robot.infrared_heard = SILENCE
    for number, seconds in deaths:
        robots[where[number - 1]].dies_at = round(seconds / cycle_time)
    return Crew(bodies, robots)

"""Film: what is seen of a trial from outside, taken by compiled code while it runs, so that looking costs little."""

from typing import Any, NamedTuple

import numpy as np

from formicarium.compiled import compiled
from formicarium.physics.records import records
from formicarium.robots.records import Colour
from formicarium.trial.record import Frames, Scene

NOWHERE = -1  # no place in a structure

# One robot at one moment.
SHOT = np.dtype(
    [
        ("x", "f8"),  # m
        ("y", "f8"),  # m
        ("heading", "f8"),  # rad, not wrapped
        ("role", "i8"),  # index into Scene.roles
        ("carried", "i8"),  # a small number the system wants shown on the robot
        ("colour", "i8"),  # Colour of its lights
        ("place", "i8"),  # number of its place in a structure of robots (a chain), NOWHERE if in none
        ("after", "i8"),  # number of the place it is joined to, NOWHERE for none
    ],
    align=True,
)


class Film(NamedTuple):
    """Room for F moments of N robots and B devices; robots in the order of their storage."""

    cycle: np.ndarray  # (F,)
    shots: np.recarray  # SHOT (F, N)
    lit: np.ndarray  # (F, B), as in Frames
    taken: np.ndarray  # (1,), moments taken so far


def make_film(length: int, robots: int, scene: Scene) -> Film:
    """Return an empty film of a scene."""
    devices = len(scene.devices)
    return Film(
        np.zeros(length, "i8"), records(SHOT, (length, robots)), np.zeros((length, devices), "i8"), np.zeros(1, "i8")
    )


@compiled
def shoot_robots(state, film):
    """Take the bodies of all robots; role, carried, colour and places are left to the system."""
    moment = film.taken[0]
    film.cycle[moment] = state.clock[0].cycle
    for i in range(len(state.robots)):
        body = state.world.bodies[i]
        shot = film.shots[moment, i]
        shot.x = body.x
        shot.y = body.y
        shot.heading = body.heading
        shot.colour = Colour.OFF
        shot.place = NOWHERE
        shot.after = NOWHERE
    film.taken[0] = moment + 1


def frames_of(film: Film, identity: np.ndarray) -> Frames:
    """Return what a film shows; ``identity`` (N,) are its robots, in the order of their storage."""
    order = np.argsort(identity)
    count = int(film.taken[0])
    shots = np.asarray(film.shots)[:count]
    column: dict[str, Any] = {name: shots[name][:, order] for name in SHOT.names or ()}
    x, y, heading = (column[name].astype("f4") for name in ("x", "y", "heading"))
    return Frames(
        cycle=film.cycle[:count].copy(),
        x=x,
        y=y,
        heading=heading,
        role=column["role"].astype("i1"),
        carried=column["carried"].astype("i1"),
        lit=film.lit[:count].astype("i1"),
        identity=np.asarray(identity)[order].astype("i8"),
        colour=column["colour"].astype("i1"),
        joined=joined(column["place"], column["after"]),
    )


def joined(place: np.ndarray, after: np.ndarray) -> np.ndarray:
    """Return for every robot the column of the one it is joined to, -1 for none; places (F, N)."""
    result = np.full(place.shape, -1, "i2")
    moment, robot = np.nonzero(after != NOWHERE)
    same = place[moment] == after[moment, robot][:, None]
    result[moment, robot] = np.where(same.any(axis=1), same.argmax(axis=1), -1)
    return result

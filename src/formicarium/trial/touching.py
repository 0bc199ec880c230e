"""What a person may do to the robots of any trial: move one, kill one."""

from typing import Any

import numpy as np

from formicarium.physics.grid import find_neighbours
from formicarium.trial.watching import Impossible, Intervention


def touch_robot(state: Any, intervention: Intervention) -> None:
    """Move or kill a robot.

    Raises:
        Impossible: if there is no such robot, it is dead, or there is no room for it.
    """
    found = np.nonzero(np.asarray(state.robots["identity"]) == intervention.subject)[0]
    if not len(found):
        raise Impossible(f"there is no robot {intervention.subject}")
    i = int(found[0])
    if intervention.deed == "kill":
        if state.robots["alive"][i] == 0:
            raise Impossible(f"robot {intervention.subject} is dead already")
        state.robots["dies_at"][i] = state.clock["cycle"][0]
    elif intervention.deed == "move":
        check_room(state.world, i, intervention.x, intervention.y)
        body = state.world.bodies[i]
        body.x, body.y = intervention.x, intervention.y
        body.speed_x = body.speed_y = body.turn_rate = 0.0
        find_neighbours(state.world)
    else:
        raise Impossible(f"nobody can {intervention.deed!r} a robot")


def check_room(world: Any, i: int, x: float, y: float) -> None:
    """Check that body ``i`` can stand at (x, y): inside the walls, clear of scenery and of all other bodies.

    Raises:
        Impossible: if it cannot.
    """
    bodies, segments = np.asarray(world.bodies), np.asarray(world.segments)
    radius = float(bodies["radius"][i])
    gaps = np.hypot(bodies["x"] - x, bodies["y"] - y) - bodies["radius"] - radius
    if (np.delete(gaps, i) < 0.0).any():
        raise Impossible("another robot stands there")
    ax, ay, bx, by = (segments[name] for name in ("ax", "ay", "bx", "by"))
    along = np.clip(((x - ax) * (bx - ax) + (y - ay) * (by - ay)) / ((bx - ax) ** 2 + (by - ay) ** 2), 0.0, 1.0)
    if (np.hypot(ax + along * (bx - ax) - x, ay + along * (by - ay) - y) < radius).any():
        raise Impossible("a wall is in the way")
    # A ray along x leaves the outline of the arena an odd number of times from inside, that of a box an even one.
    with np.errstate(divide="ignore", invalid="ignore"):
        crossed = ((ay > y) != (by > y)) & (x < ax + (y - ay) / (by - ay) * (bx - ax))
    for group in np.unique(segments["group"]):
        inside = int(crossed[segments["group"] == group].sum()) % 2 == 1
        if inside != (group == 0):
            raise Impossible("that is outside the arena" if group == 0 else "that is inside a wall")

"""A Scene as plain values, for files and pages."""

from collections.abc import Mapping
from typing import Any

import numpy as np

from formicarium.trial.record import Polygon, Scene


def scene_content(scene: Scene) -> dict[str, Any]:
    """Return a scene as lists, numbers and texts."""
    return {
        "polygons": [[polygon.points.tolist(), polygon.colour] for polygon in scene.polygons],
        "radius": scene.radius,
        "roles": list(scene.roles),
        "cycle_time": scene.cycle_time,
        "ranges": [list(named) for named in scene.ranges],
        "load": scene.load,
        "number": scene.number,
    }


def scene_from(content: Mapping[str, Any]) -> Scene:
    """Return the scene that was written; scenes of older files have no ranges and no load."""
    polygons = tuple(Polygon(np.array(points, float), colour) for points, colour in content["polygons"])
    ranges = tuple((str(name), float(reach)) for name, reach in content.get("ranges", []))
    words = {name: str(content[name]) for name in ("load", "number") if name in content}
    return Scene(polygons, content["radius"], tuple(content["roles"]), content["cycle_time"], ranges, **words)

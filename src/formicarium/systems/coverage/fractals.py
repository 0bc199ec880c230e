"""How well arms that branch match their design, measured from outside at the end of a trial (ST-75)."""

import math
from typing import Any

import numpy as np

from formicarium.angles import wrapped
from formicarium.systems.coverage.branches import DIGIT, level_of, swing_of
from formicarium.systems.coverage.parameters import CoverageParameters

SAMPLE = 0.02  # m, between points that stand for a link
PIXEL = 0.1  # m, of areas
SIZES = 10  # of boxes
SHIFTS = 4  # of the boxes' grid along each axis; counts are means over them
DECADE = 1.0  # of scale, that a dimension wants at least

Place = tuple[int, int, int]  # arm, branch, place
Points = dict[Place, np.ndarray]


def fractal_columns(parameters: CoverageParameters, state: Any) -> dict[str, int | float | None]:
    """Return the columns of a fractal's outcome row: lengths in m, angles in degrees, areas in m2."""
    formation, delta = state.charts[0].formation, parameters.behaviour.spacing
    arms = parameters.tasks.count
    points = placed(state)
    wanted = [(arm, branch) for arm in range(1, arms + 1) for branch in branches_of(formation)]
    full = [key for key in wanted if is_full(points, *key, formation)]
    vectors = {key: points[*key, formation.branch_robots] - points[root_of(*key, formation)] for key in full}
    row: dict[str, int | float | None] = {
        "branches": len(wanted),
        "branches_full": len(full),
        "places_filled": share_filled(points, formation, arms),
        "settled_s": round((int(state.memories.place_since.max()) + 1) * parameters.swarm.cycle_time, 6),
    }
    for level in range(1, formation.depth + 1):
        row[f"ratio_{level}"] = ratio(vectors, level)
    turns = [
        wrapped(direction(vectors[key]) - direction(vectors[parent]) - swing_of(key[1] % DIGIT, formation))
        for key in full
        if key[1] > 0 and (parent := (key[0], key[1] // DIGIT)) in vectors
    ]
    row["angle_off"] = math.degrees(float(np.mean(np.abs(turns)))) if turns else None
    links = links_of(state)
    least = delta * formation.ratio**formation.depth
    row |= {
        "decades": decades(links, least),
        "dimension": dimension(links, least),
        "dimension_design": dimension(design(formation, delta, arms), least),
    }
    bodies = np.column_stack([state.world.bodies.x, state.world.bodies.y])
    row["area_in_range_m2"] = area(bodies, parameters.footbot.radio_range)
    return row


def placed(state: Any) -> Points:
    """Return where the living robots with a place stand, the master's in every arm; of two in one place the first."""
    found: Points = {}
    for body, robot, memory in zip(state.world.bodies, state.robots, state.memories, strict=True):
        point = np.array([body.x, body.y])
        if memory.master == 1:
            found[0, 0, 0] = point
        elif robot.alive == 1 and memory.place > 0:
            found.setdefault((int(memory.arm), int(memory.branch), int(memory.place)), point)
    return found


def branches_of(formation: Any) -> list[int]:
    """Return the numbers of all branches of one arm, the stem's first."""
    found, level = [0], [0]
    for _ in range(int(formation.depth)):
        level = [branch * DIGIT + child for branch in level for child in range(1, int(formation.branches) + 1)]
        found += level
    return found


def root_of(arm: int, branch: int, formation: Any) -> Place:
    """Return the place in which a branch begins."""
    return (arm, branch // DIGIT, int(formation.branch_robots)) if branch else (0, 0, 0)


def is_full(points: Points, arm: int, branch: int, formation: Any) -> bool:
    """Tell whether a branch has a robot in each of its places, and one in its root."""
    places = [(arm, branch, place) for place in range(1, int(formation.branch_robots) + 1)]
    return all(place in points for place in (root_of(arm, branch, formation), *places))


def share_filled(points: Points, formation: Any, arms: int) -> float:
    """Return which share of the design's places has a robot."""
    size = int(formation.branch_robots)
    wanted = {(a, b, p) for a in range(1, arms + 1) for b in branches_of(formation) for p in range(1, size + 1)}
    return len(wanted & set(points)) / len(wanted)


def ratio(vectors: dict[tuple[int, int], np.ndarray], level: int) -> float | None:
    """Return the mean length of the full branches of a level over that of the level before."""
    lengths = [
        [float(np.hypot(*vector)) for (_, branch), vector in vectors.items() if level_of(branch) == one]
        for one in (level - 1, level)
    ]
    return float(np.mean(lengths[1]) / np.mean(lengths[0])) if all(lengths) else None


def direction(vector: np.ndarray) -> float:
    """Return the direction of a vector, rad."""
    return math.atan2(vector[1], vector[0])


def links_of(state: Any) -> np.ndarray:
    """Return (L, 2, 2) both ends (m) of the links from living robots to those that they align with."""
    bodies = {int(robot.identity): (body.x, body.y) for robot, body in zip(state.robots, state.world.bodies)}
    return np.array(
        [
            (bodies[int(robot.identity)], bodies[int(memory.reference)])
            for robot, memory in zip(state.robots, state.memories, strict=True)
            if robot.alive == 1 and int(memory.reference) in bodies
        ]
    ).reshape(-1, 2, 2)


def design(formation: Any, delta: float, arms: int) -> np.ndarray:
    """Return (L, 2, 2) the branches of the design, exactly as asked for (m)."""
    found = []
    for arm in range(arms):
        ends: dict[int, tuple[float, float]] = {}
        for branch in branches_of(formation):
            length = formation.branch_robots * delta * formation.ratio ** level_of(branch)
            way = 2.0 * math.pi * arm / arms + swing_of(branch, formation)
            start = ends[branch // DIGIT] if branch else (0.0, 0.0)
            ends[branch] = (start[0] + length * math.cos(way), start[1] + length * math.sin(way))
            found.append((start, ends[branch]))
    return np.array(found)


def sampled(links: np.ndarray) -> np.ndarray:
    """Return (P, 2) points along links (m)."""
    parts = []
    for start, end in links:
        count = max(2, math.ceil(float(np.hypot(*(end - start))) / SAMPLE) + 1)
        parts.append(start + np.linspace(0.0, 1.0, count)[:, None] * (end - start))
    return np.concatenate(parts)


def widest(links: np.ndarray) -> float:
    """Return the size of the largest boxes, half the figure's extent (m)."""
    ends = links.reshape(-1, 2)
    return 0.5 * float((ends.max(axis=0) - ends.min(axis=0)).max())


def decades(links: np.ndarray, least: float) -> float:
    """Return over how many decades boxes are counted: from the shortest link of the design to half the extent."""
    return math.log10(widest(links) / least) if len(links) else 0.0


def dimension(links: np.ndarray, least: float) -> float | None:
    """Return the box-counting dimension: minus the slope of log(boxes) over log(size), least squares.

    Sizes go from ``least`` (m) to half the figure's extent: below its shortest link it is but a line.
    """
    if not len(links) or widest(links) <= least:
        return None
    points = sampled(links)
    sizes = np.geomspace(least, widest(links), SIZES)
    counts = [np.mean([boxes(points, size, i, j) for i in range(SHIFTS) for j in range(SHIFTS)]) for size in sizes]
    return float(-np.polyfit(np.log(sizes), np.log(counts), 1)[0])


def boxes(points: np.ndarray, size: float, i: int, j: int) -> int:
    """Return in how many boxes points lie, with the grid shifted by i and j quarters of a box."""
    cells = np.floor(points / size + np.array([i, j]) / SHIFTS).astype(np.int64)
    return len(np.unique(cells, axis=0))


def area(points: np.ndarray, reach: float) -> float:
    """Return the area within ``reach`` (m) of any point (m2), on a grid."""
    low, high = points.min(axis=0) - reach, points.max(axis=0) + reach
    xs, ys = (np.arange(low[k] + 0.5 * PIXEL, high[k], PIXEL) for k in (0, 1))
    near = np.zeros((len(xs), len(ys)), bool)
    for x, y in points:
        near |= (xs[:, None] - x) ** 2 + (ys[None, :] - y) ** 2 <= reach * reach
    return float(near.sum()) * PIXEL * PIXEL

"""What a network of arms and tubes costs and what it is worth, measured from outside at the end of a trial (ST-74)."""

from typing import Any

import numpy as np
from scipy.sparse.csgraph import minimum_spanning_tree

from formicarium.connectivity.exact import articulation_nodes, is_connected
from formicarium.systems.coverage.branches import neighbour_of
from formicarium.systems.coverage.parameters import CoverageParameters
from formicarium.systems.coverage.tubes import flux_of

Tube = tuple[int, int]  # arm and side


def network_columns(parameters: CoverageParameters, state: Any) -> dict[str, int | float | None]:
    """Return the columns of a network's outcome row: lengths in m, shares of the robots other than the master."""
    living = [int(i) for i in np.flatnonzero(np.asarray(state.robots.alive) == 1)]
    points = np.column_stack([state.world.bodies.x, state.world.bodies.y])
    memories = np.asarray(state.memories)
    tubes = joined_tubes(state, living)
    stems = [i for i in living if in_stem(memories[i], state)]
    used = [*stems, *(i for i in living if tube_of(memories[i]) in tubes)]
    length = length_of(state, points, used, tubes)
    tips = [i for i in stems if memories[i]["place"] == state.charts[0].formation.branch_robots]
    tree = spanning_length(points[[state.survey[0].master, *tips]])
    row: dict[str, int | float | None] = {
        "tips": len(tips),
        "arms_joined": len({frozenset((arm, tubes[arm, side])) for arm, side in tubes}),
        "robots_used": len(used),
        "robots_spare": len(living) - 1 - len(used),
        "network_m": length,
        "tree_m": tree,
        "length_over_tree": length / tree if tree > 0.0 else None,
        "withered": int(memories["withered"].sum()),
    }
    ranged = np.hypot(*(points[:, None] - points).transpose(2, 0, 1)) <= parameters.footbot.radio_range
    np.fill_diagonal(ranged, False)
    for name, graph in (("range", ranged), ("sight", np.asarray(state.sight) == 1)):
        own = graph[np.ix_(living, living)]
        row[f"survived_{name}"], row[f"master_spared_{name}"] = survived(own, living.index(state.survey[0].master))
    return row


def tube_of(memory: Any) -> Tube:
    """Return the tube of a robot; its side is 0 if it is in none."""
    return int(memory["arm"]), int(memory["branch"])


def in_stem(memory: Any, state: Any) -> bool:
    """Tell whether a robot belongs to an arm and is not to spare."""
    return memory["branch"] == 0 and 0 < memory["place"] <= state.charts[0].formation.branch_robots


def joined_tubes(state: Any, living: list[int]) -> dict[Tube, int]:
    """Return the tubes through which something flows, and the arm that each leads to."""
    found = {}
    for i in living:
        memory = state.memories[i]
        if memory.branch > 0 and flux_of(memory.arms, memory.arm_count) > 0.0:
            found[tube_of(memory)] = int(neighbour_of(memory, memory.arm, memory.branch))
    return found


def length_of(state: Any, points: np.ndarray, used: list[int], tubes: dict[Tube, int]) -> float:
    """Return the length of all links between robots of the network (m): to whom each aligns with, and to far ends."""
    place = {int(robot.identity): i for i, robot in enumerate(state.robots)}
    memories = np.asarray(state.memories)
    pairs = {frozenset((int(i), place[r])) for i in used if (r := int(memories[i]["reference"])) in place}
    for (arm, side), other in tubes.items():
        row = [i for i in used if tube_of(memories[i]) == (arm, side)]
        ends = [i for i in used if memories[i]["arm"] == other and leads_back(memories[i], arm, tubes)]
        if row and ends:
            gaps = np.hypot(*(points[row][:, None] - points[ends]).transpose(2, 0, 1))
            near, far = np.unravel_index(int(gaps.argmin()), gaps.shape)
            pairs.add(frozenset((int(row[near]), int(ends[far]))))
    ends_of = [tuple(pair) for pair in pairs if len(pair) == 2]
    return float(sum(np.hypot(*(points[a] - points[b])) for a, b in ends_of))


def leads_back(memory: Any, arm: int, tubes: dict[Tube, int]) -> bool:
    """Tell whether a robot of another arm can be the far end of a tube from ``arm``: of the stem, or of a tube back."""
    return memory["branch"] == 0 or tubes.get(tube_of(memory)) == arm


def spanning_length(points: np.ndarray) -> float:
    """Return the length of the shortest tree that joins points (m)."""
    gaps = np.hypot(*(points[:, None] - points).transpose(2, 0, 1))
    return float(minimum_spanning_tree(gaps).sum())


def survived(graph: np.ndarray, master: int) -> tuple[float, int]:
    """Return the share of robots whose loss leaves the others connected, the master apart, and whether its own does.

    A graph that is in parts survives nothing.
    """
    if len(graph) < 3 or not is_connected(graph):
        return 0.0, 0
    cut = articulation_nodes(graph)
    others = int(cut.sum()) - int(cut[master])
    return 1.0 - others / (len(graph) - 1), int(not cut[master])

"""What the runs of missions say: how many are done, in what time by phase, and how far arms get for each robot."""

import math
from collections.abc import Sequence
from typing import Any

import numpy as np

from formicarium.statistics.intervals import wilson
from formicarium.studies.chart import Chart, Panel, Stack
from formicarium.studies.prominences import Row, finite, median, picked

PHASES = ("flock", "erupt", "hold", "gather")
COLUMNS = (
    *("map", "condition", "seed", "mission_done", "tasks_done", "tasks", "mission_s", "duration_s", "planned_s"),
    *("flock_s", "erupt_s", "hold_s", "gather_s", "lost_share_range", "first_loss_range_s", "longest_loss_range_s"),
    *("lost_share_sight", "lost_share_heard", "died", "followed", "planned_anew", "bytes_most", "sources"),
)  # of a run, that its table holds
LOW = 5.0  # percentile of the reach of arms that a plan may count with (ST-56)


def mission_rows(rows: Sequence[Row]) -> list[dict[str, Any]]:
    """Return a table, a row for each map and condition, and one over all maps for each condition."""
    conditions = list(dict.fromkeys(row["condition"] for row in rows))
    maps = list(dict.fromkeys(row["map"] for row in rows))
    cells = [(c, m, picked(rows, map=m, condition=c)) for c in conditions for m in (*maps, "all")]
    return [{"condition": c, "map": m, **summed_up(own or picked(rows, condition=c))} for c, m, own in cells]


def summed_up(cell: Sequence[Row]) -> dict[str, Any]:
    """Return the numbers of one cell; a mission that is not done counts as infinitely late, never as absent."""
    done = wilson(sum(row["mission_done"] for row in cell), len(cell))
    whole = wilson(sum(row["lost_share_range"] == 0.0 for row in cell), len(cell))
    struck = [row for row in cell if row["died"]]
    return {
        "runs": len(cell),
        "done": done.successes,
        "done_low": round(done.low, 3),
        "done_high": round(done.high, 3),
        "tasks_done": sum(row["tasks_done"] for row in cell),
        "tasks": sum(row["tasks"] for row in cell),
        "struck": len(struck),
        "struck_done": sum(row["mission_done"] for row in struck),
        "mission_s": finite(median(cell, "mission_s")),
        "planned_s": finite(float(np.mean([row["planned_s"] for row in cell]))),
        **{f"{name}_s": round(float(np.mean([row[f"{name}_s"] for row in cell])), 1) for name in PHASES},
        "whole": whole.successes,
        "whole_low": round(whole.low, 3),
        "whole_high": round(whole.high, 3),
        "lost_share_most": max(row["lost_share_range"] for row in cell),
        "longest_loss_most_s": max(row["longest_loss_range_s"] for row in cell),
        "followed": sum(row.get("followed") or 0 for row in cell),
        "planned_anew": sum(row.get("planned_anew") or 0 for row in cell),
        "bytes_most": max(row["bytes_most"] for row in cell),
    }


def figure_missions(rows: Sequence[Row]) -> Chart:
    """Mean time by phase of every condition, a panel a map, with the plan's time as an upright line's place."""
    panels = []
    for name in dict.fromkeys(row["map"] for row in rows):
        own = picked(rows, map=name)
        stacks = [
            Stack(c, [float(np.mean([row[f"{phase}_s"] for row in picked(own, condition=c)])) for phase in PHASES])
            for c in dict.fromkeys(row["condition"] for row in own)
        ]
        planned = sorted({float(row["planned_s"]) for row in own})
        title = f"{name}: {' or '.join(f'{seconds:g}' for seconds in planned)} s planned"
        panels.append(Panel(title, "", "mean time (s)", stacks=stacks))
    return Chart("figure-missions", "Whole missions: where the time goes", f"{len(rows)} runs", panels, keys=PHASES)


def reach_rows(rows: Sequence[Row]) -> list[dict[str, Any]]:
    """Return the greatest connected length of an arm for each of its robots, in metres, by variant and arms.

    A team of 20 in n arms has 20 / n robots an arm, the first arms one more.
    """
    table = []
    for variant in sorted({row["variant"] for row in rows}):
        for arms in sorted({row["tasks"] for row in rows}):
            own = picked(rows, variant=variant, tasks=arms)
            reach = [
                row[f"length_{k + 1}_m"] / robots_of(row["robots"] - 1, arms, k) for row in own for k in range(arms)
            ]
            low, middle = np.percentile(reach, [LOW, 50.0])
            table.append(
                {
                    "variant": variant,
                    "arms": arms,
                    "runs": len(own),
                    "reach_p5_m": round(float(low), 3),
                    "reach_median_m": round(float(middle), 3),
                    "reach_least_m": round(min(reach), 3),
                }
            )
    return table


def robots_of(backbone: int, arms: int, k: int) -> int:
    """Return how many robots arm ``k`` is to have (ST-32)."""
    return math.floor(backbone / arms) + (k < backbone % arms)

"""The tables of the partitioning study that are no statements, as lines of Markdown."""

from collections.abc import Sequence

import numpy as np

from formicarium.statistics.means import mean_of
from formicarium.studies.foraging import METHODS, SWITCH, TIMES, Row, column, consistent, picked

OBJECTS = "objects_per_robot"
# How often P_g is drawn, as a reader is told, and what picks the runs.
READINGS = {
    "every 0.1 s (to the letter)": {"strategy__giveup_draw_period": 0.1},
    "every 1 s": {"strategy__giveup_draw_period": 1.0},
    "every 10 s": {"strategy__giveup_draw_period": 10.0},
    "every 30 s": {"strategy__giveup_draw_period": 30.0},
    "every 60 s": {"strategy__giveup_draw_period": 60.0},
}
THRESHOLD = "one threshold a wait"
# Interfacing time (s) and time of the change (s), by the head of the column.
COURSES = {"Π 0": (0.0, -1.0), "Π 50": (50.0, -1.0), "Π 200": (200.0, -1.0), "200 to 0 at half time": (200.0, SWITCH)}


def runs_of(campaigns: dict[str, Sequence[Row]]) -> list[str]:
    """Return how many runs of each campaign there are, how many are left out, and the sources that made them."""
    lines = ["| campaign | runs | left out | sources |", "|---|---|---|---|"]
    for name, rows in campaigns.items():
        sources = ", ".join(sorted({str(row.get("sources", "")) for row in rows}))
        lines.append(f"| {name} | {len(rows)} | {len(rows) - len(consistent(rows))} | {sources} |")
    return lines


def performance(rows: Sequence[Row]) -> list[str]:
    """Return objects per robot at every interfacing time (Fig. 7)."""
    lines = [f"| Π (s) | {' | '.join(METHODS)} | left out ({', '.join(METHODS)}) |", "|---" * (len(METHODS) + 2) + "|"]
    for time in TIMES:
        cells = [picked(rows, method=method, interfacing_time_s=time) for method in METHODS]
        if any(cells):
            out = ", ".join(_left_out(cell) for cell in cells)
            lines.append(f"| {time:g} | {' | '.join(_objects(cell) for cell in cells)} | {out} |")
    return lines


def giving_up(drawn: Sequence[Row], threshold: Sequence[Row]) -> list[str]:
    """Return objects per robot and the share of actions that used the cache, for each reading of giving up."""
    lines = [f"| draw of P_g | {' | '.join(COURSES)} |", "|---" * (len(COURSES) + 1) + "|"]
    readings = {name: picked(drawn, **chosen) for name, chosen in READINGS.items()} | {THRESHOLD: list(threshold)}
    for name, chosen in readings.items():
        cells = [picked(chosen, interfacing_time_s=t, cache__switch_time=change) for t, change in COURSES.values()]
        if any(cells):
            lines.append(f"| {name} | {' | '.join(_objects_and_share(cell) for cell in cells)} |")
    return lines


def sizes(rows: Sequence[Row]) -> list[str]:
    """Return objects per robot for every size of the swarm (Fig. 11)."""
    lines = [f"| robots | Π (s) | {' | '.join(METHODS)} | left out ({', '.join(METHODS)}) |"]
    lines += ["|---" * (len(METHODS) + 3) + "|"]
    for time in sorted({row["interfacing_time_s"] for row in rows}):
        for robots in sorted({row["robots"] for row in rows}):
            cells = [picked(rows, method=method, interfacing_time_s=time, robots=robots) for method in METHODS]
            if any(cells):
                out = ", ".join(_left_out(cell) for cell in cells)
                lines.append(f"| {robots} | {time:g} | {' | '.join(_objects(cell) for cell in cells)} | {out} |")
    return lines


def _left_out(cell: Sequence[Row]) -> str:
    return f"{len(cell) - len(consistent(cell))}/{len(cell)}"


def _objects(cell: Sequence[Row]) -> str:
    """Write the mean over the clean runs with its interval; over all runs, in italics, if none is clean."""
    if not cell:
        return ""
    kept = consistent(cell)
    mean = mean_of(column(kept or cell, OBJECTS))
    words = f"{mean.value:.0f}" + (f" ({mean.low:.0f} to {mean.high:.0f})" if mean.number > 1 else "")
    return words if kept else f"*{words}*"


def _objects_and_share(cell: Sequence[Row]) -> str:
    if not cell:
        return ""
    return f"{_objects(cell)}, {100 * np.mean(column(consistent(cell) or cell, 'share_used')):.0f} %"

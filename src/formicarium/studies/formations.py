"""What became of arms that branch and of networks, cell by cell (ST-74, ST-75)."""

from collections.abc import Sequence
from typing import Any

import numpy as np

from formicarium.studies.prominences import Row, never_parted

# Columns of the rows, and what they are called in a report.
FRACTAL = {
    "branches_full": "branches with all their robots",
    "places_filled": "places of the design filled",
    "ratio_1": "length ratio, first branching",
    "ratio_2": "second branching",
    "ratio_3": "third branching",
    "angle_off": "off the design's angle (degrees)",
    "dimension": "box-counting dimension",
    "dimension_design": "of the design",
    "decades": "decades of scale",
    "area_in_range_m2": "area in radio range (m²)",
    "settled_s": "last change of a place (s)",
    "bytes_most": "longest message (bytes)",
}
NETWORK = {
    "tips": "arms with a tip",
    "arms_joined": "pairs of arms joined",
    "robots_used": "robots in the network",
    "robots_spare": "robots to spare",
    "network_m": "length (m)",
    "length_over_tree": "length / shortest tree",
    "survived_range": "single failures survived, in range",
    "survived_sight": "single failures survived, in sight",
    "master_spared_range": "the master's, in range",
    "unreached_range": "robots cut off at the end",
    "withered": "robots that left a tube",
    "bytes_most": "longest message (bytes)",
}


def cells_of(rows: Sequence[Row], factors: Sequence[str], columns: dict[str, str]) -> list[dict[str, Any]]:
    """Return a row a cell: its factors, its runs, how many never parted, and of each column median, least and most."""
    keys = list(dict.fromkeys(tuple(row.get(name) for name in factors) for row in rows))
    table = []
    for key in keys:
        cell = [row for row in rows if tuple(row.get(name) for name in factors) == key]
        numbers: dict[str, Any] = dict(zip(factors, key, strict=True))
        numbers |= {
            "runs": len(cell),
            "never_parted": never_parted(cell),
            "lost_share_most": max(row["lost_share_range"] for row in cell),
            "longest_loss_most_s": max(row["longest_loss_range_s"] for row in cell),
        }
        for name in columns:
            found = [float(row[name]) for row in cell if row.get(name) is not None]
            numbers[f"{name}_runs"] = len(found)
            for word, pick in (("median", np.median), ("least", np.min), ("most", np.max)):
                numbers[f"{name}_{word}"] = float(pick(found)) if found else None
        table.append(numbers)
    return table


def report(cells: Sequence[dict[str, Any]], factors: Sequence[str], columns: dict[str, str], title: str) -> str:
    """Return a table in Markdown, a column a cell: medians, and least to most in brackets."""
    lines = [f"# {title}", "", "Medians over runs; least to most in brackets. -: in no run.", ""]
    for name in (*factors, "runs", "never_parted"):
        lines.append(f"| {name.replace('_', ' ')} | " + " | ".join(_short(cell[name]) for cell in cells) + " |")
        if len(lines) == 5:
            lines.append("|---" * (len(cells) + 1) + "|")
    worst = " | ".join(f"{_short(100 * c['lost_share_most'])} %, {_short(c['longest_loss_most_s'])} s" for c in cells)
    lines.append(f"| most time parted, longest | {worst} |")
    for name, words in columns.items():
        if any(cell[f"{name}_runs"] for cell in cells):
            lines.append(f"| {words} | " + " | ".join(_spread(cell, name) for cell in cells) + " |")
    return "\n".join(lines) + "\n"


def _spread(cell: dict[str, Any], name: str) -> str:
    if not cell[f"{name}_runs"]:
        return "-"
    middle, low, high = (_short(cell[f"{name}_{word}"]) for word in ("median", "least", "most"))
    few = "" if cell[f"{name}_runs"] == cell["runs"] else f", {cell[f'{name}_runs']} runs"
    return f"{middle} ({low} to {high}{few})"


def _short(value: Any) -> str:
    return f"{value:.3g}" if isinstance(value, float) else str(value)

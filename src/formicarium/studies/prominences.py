"""The coverage study's runs, picked and summed up: Table I beside the paper's, and what the other campaigns say."""

import csv
import math
from collections.abc import Iterable, Mapping, Sequence
from importlib import resources
from typing import Any, NamedTuple

import numpy as np

from formicarium.statistics.intervals import wilson

Row = Mapping[str, Any]
TARGETS = ("2r2", "3r2", "5r2", "10r2", "15r2")
FACTOR = 3.0  # within which a latency counts as the paper's (ST-62)


class Published(NamedTuple):
    """A cell of the paper's Table I."""

    spacing: float  # m
    backbone: int
    target: str
    latency: float | None  # s, None where the paper says it is not reached
    length: float | None  # m, the bracket


def table_1() -> list[Published]:
    """Return the paper's Table I."""
    text = resources.files("formicarium.systems.coverage.published").joinpath("table_1.csv").read_text()
    rows = csv.DictReader(line for line in text.splitlines() if not line.startswith("#"))
    return [
        Published(
            float(row["spacing_m"]),
            int(row["backbone"]),
            row["target"],
            float(row["latency_s"]) if row["latency_s"] else None,
            float(row["length_m"]) if row["length_m"] else None,
        )
        for row in rows
    ]


def picked(rows: Iterable[Row], **wanted: Any) -> list[Row]:
    """Return the rows whose columns have these values; "footbot__radius" stands for "footbot.radius"."""
    return [row for row in rows if all(row.get(name.replace("__", ".")) == value for name, value in wanted.items())]


def median(rows: Iterable[Row], name: str) -> float:
    """Return the median of a column over all runs; a run without a value counts as infinitely late, never as absent."""
    values = [math.inf if row[name] is None else float(row[name]) for row in rows]
    return float(np.median(values)) if values else math.nan


def reached(rows: Sequence[Row], target: str) -> int:
    """Return how many runs reached a target."""
    return sum(row[f"latency_{target}_s"] is not None for row in rows)


def never_parted(rows: Sequence[Row], graph: str = "range") -> int:
    """Return how many runs kept a graph whole at every step."""
    return sum(row[f"losses_{graph}"] == 0 for row in rows)


def verdict(cell: Published, rows: Sequence[Row]) -> str:
    """Say how a cell of ours compares: reached or not as in the paper, and the latency within a factor of three."""
    if not rows:
        return "no runs"
    mostly = reached(rows, cell.target) > 0.5 * len(rows)
    if cell.latency is None:
        return "reached here alone" if mostly else "as in the paper"
    if not mostly:
        return "reached in the paper alone"
    ratio = median(rows, f"latency_{cell.target}_s") / cell.latency
    return "as in the paper" if 1.0 / FACTOR <= ratio <= FACTOR else f"{1.0 / ratio:.1f} times sooner"


def table_1_rows(rows: Sequence[Row]) -> list[dict[str, Any]]:
    """Return Table I, the paper's and ours side by side, a row a cell; latencies are medians over all runs."""
    table = []
    for cell in table_1():
        own = picked(rows, spacing_m=cell.spacing, robots=cell.backbone + 1)
        table.append(
            {
                "spacing_m": cell.spacing,
                "backbone": cell.backbone,
                "target": cell.target,
                "paper_s": cell.latency,
                "runs": len(own),
                "reached": reached(own, cell.target),
                "median_s": finite(median(own, f"latency_{cell.target}_s")),
                "paper_length_m": cell.length,
                "verdict": verdict(cell, own),
            }
        )
    return table


def cells_of(rows: Sequence[Row], factors: Sequence[str]) -> list[dict[str, Any]]:
    """Return a table of cells: factors, runs, lengths, latencies, densities, losses."""
    keys = list(dict.fromkeys(tuple(row.get(name) for name in factors) for row in rows))
    return [
        dict(zip(factors, key, strict=True)) | summed_up([r for r in rows if tuple(r.get(n) for n in factors) == key])
        for key in keys
    ]


def summed_up(cell: Sequence[Row]) -> dict[str, Any]:
    """Return the numbers of one cell; medians unless the name says otherwise."""
    whole = wilson(never_parted(cell), len(cell))
    numbers: dict[str, Any] = {
        "runs": len(cell),
        "never_parted": whole.successes,
        "never_parted_low": round(whole.low, 4),
        "never_parted_high": round(whole.high, 4),
        "never_parted_sight": never_parted(cell, "sight"),
        "never_parted_heard": never_parted(cell, "heard"),
        "lost_share_mean": float(np.mean([row["lost_share_range"] for row in cell])),
        "lost_share_most": max(row["lost_share_range"] for row in cell),
        "longest_loss_most_s": max(row["longest_loss_range_s"] for row in cell),
        "first_loss_least_s": min(
            (row["first_loss_range_s"] for row in cell if row["first_loss_range_s"] is not None), default=None
        ),
    }
    for target in TARGETS:
        numbers[f"reached_{target}"] = reached(cell, target)
        numbers[f"latency_{target}_s"] = finite(median(cell, f"latency_{target}_s"))
    for name in ("length_m", "length_600_m", "length_end_m", "length_any_m", "density_m", "density_end_m"):
        numbers[name] = finite(median(cell, name))
    for name in ("tasks_covered", "tasks_covered_end"):
        numbers[f"{name}_mean"] = float(np.mean([row[name] for row in cell]))
    numbers["held"] = sum(row["held"] for row in cell)
    numbers["eruption_s"] = finite(float(np.median([eruption_of(row) for row in cell])))
    for name in ("firm_share", "cut_robots_mean", "lambda_2_least", "lambda_2_mean", "flips_per_robot_minute"):
        numbers[name] = finite(median(cell, name))
    long = [row for row in cell if row["long_arm_looks"]]
    numbers["long_arm_runs"] = len(long)
    numbers["long_arm_firm_share"] = finite(median(long, "long_arm_firm_share")) if long else None
    numbers["bytes_most"] = max(row["bytes_most"] for row in cell)
    return numbers


def eruption_of(row: Row) -> float:
    """Return how long a tour's arms took to reach all tasks (s); infinitely long if they were not held then."""
    return float(row["hold_called_s"]) - float(row["erupt_called_s"]) if row["held"] else math.inf


def finite(value: float) -> float | None:
    """Return a number as it stands in a table, None if there is none."""
    return value if math.isfinite(value) else None

"""What ``tune`` does: successive halving on tuning seeds, then the best against the default on held-back ones.

Every round is a campaign in one folder, so that an interrupted search goes on. All points meet the same seeds.
Unreached times are penalised as is usual in algorithm configuration (PAR2: twice the cap).
"""

import math
from typing import Any, NamedTuple

import numpy as np
from scipy.stats import mannwhitneyu, qmc

from formicarium.commands.calls.results import Results
from formicarium.commands.calls.running import run_campaign
from formicarium.commands.errors import UserError
from formicarium.commands.fields import NamedField, find_field, parted, value_of_text
from formicarium.commands.known import find_system
from formicarium.commands.summary import END
from formicarium.systems.registry import System

PENALTY = 2.0  # times the length of a run, for a time that was not reached
KEPT = 0.5  # share of the points that stay after a round
Point = dict[str, Any]  # path of a parameter -> value


class Search(NamedTuple):
    """What a person asked for; see ``tune`` for the meaning."""

    system: str
    over: tuple[str, ...]
    target: str
    most: bool = False
    points: int = 16
    seeds: int = 4
    held_back: int = 20
    first_seed: int = 1_000_000
    settings: tuple[str, ...] = ()
    out: str | None = None
    workers: int | None = None


class Verdict(NamedTuple):
    """The best point against the default, on seeds that the search has not seen."""

    best: Point
    default: Point
    scores: tuple[float, float]  # of best and default: means over the held-back seeds
    p_value: float  # Mann and Whitney, two-sided
    rounds: int
    runs: int


def tune_system(search: Search) -> int:
    """Tune and print; return the exit code."""
    verdict = tuned(search)
    word = "greater" if search.most else "smaller"
    for name in verdict.best:
        print(f"{name:32} {verdict.best[name]:<12.5g} default {verdict.default[name]:.5g}")
    print(
        f"\n{search.target} on {search.held_back} held-back seeds ({word} is better): "
        f"{verdict.scores[0]:.4g}, default {verdict.scores[1]:.4g}, p = {verdict.p_value:.2g} (Mann-Whitney)\n"
        f"{verdict.runs} runs, {verdict.rounds} rounds of search; every run is in {_folder(search)}"
    )
    if verdict.best == verdict.default:
        print("The search has found nothing better than the default.")
    else:
        options = " ".join(f"--set {name}={value!r}" for name, value in verdict.best.items())
        print(f"use them  formicarium run {search.system} {options}")
    return 0


def tuned(search: Search) -> Verdict:
    """Search, and compare with the default on held-back seeds.

    Raises:
        UserError: if a number, a range or the target does not exist.
    """
    system = find_system(search.system)
    if min(search.points, search.seeds, search.held_back) < 2:
        raise UserError("--points, --seeds and --held-back: at least 2 of each")
    ranges = [_range(system, text) for text in search.over]
    default = _default(system, ranges)
    points, count, rounds, runs = spread(ranges, search.points - 1), search.seeds, 0, 0
    points.insert(0, default)
    while len(points) > 1:
        found = _run(search, points, count, search.first_seed, f"round {rounds + 1}")
        order = np.argsort([score(search, system, rows) for rows in found], kind="stable")
        runs += count * len(points)
        points = [points[k] for k in order[: max(1, math.ceil(len(points) * KEPT) if len(points) > 2 else 1)]]
        count, rounds = count * 2, rounds + 1
    compared = [points[0], default] if points[0] != default else [default]
    held = _run(search, compared, search.held_back, search.first_seed + count, "held back")
    values = [outcomes(search, system, rows) for rows in held]
    runs += search.held_back * len(compared)
    p_value = float(mannwhitneyu(values[0], values[-1]).pvalue) if len(compared) > 1 else 1.0
    return Verdict(points[0], default, (float(np.mean(values[0])), float(np.mean(values[-1]))), p_value, rounds, runs)


def spread(ranges: list[tuple[NamedField, float, float]], count: int) -> list[Point]:
    """Return points spread evenly over the ranges (Halton's sequence)."""
    drawn = qmc.Halton(len(ranges), scramble=False).random(count + 1)[1:]  # the first is a corner
    points = []
    for place in drawn:
        values = {field.path: low + share * (high - low) for (field, low, high), share in zip(ranges, place)}
        whole = {field.path for field, _, _ in ranges if field.info.annotation is int}
        points.append({name: round(value) if name in whole else float(value) for name, value in values.items()})
    return points


def outcomes(search: Search, system: System, rows: list[dict[str, Any]]) -> list[float]:
    """Return the target of every row; times that were not reached are penalised."""
    times = search.target in system.targets.columns or search.target.startswith("time_")
    values = []
    for row in rows:
        value = row.get(search.target)
        if value is None and times:
            value = PENALTY * float(row[END])
        if not isinstance(value, int | float):
            raise UserError(f"--target {search.target}: is {value!r} in a run with seed {row['seed']}, no number")
        values.append(float(value))
    return values


def score(search: Search, system: System, rows: list[dict[str, Any]]) -> float:
    """Return what the search makes small."""
    mean = float(np.mean(outcomes(search, system, rows)))
    return -mean if search.most else mean


def _run(search: Search, points: list[Point], count: int, first_seed: int, name: str) -> list[list[dict[str, Any]]]:
    design: dict[str, Any] = {
        "name": "tune",
        "system": search.system,
        "replicates": count,
        "rows": points,
        "first_seed": first_seed,
    }
    if search.settings:
        model = find_system(search.system).parameters
        texts = [parted(setting) for setting in search.settings]
        fields = [find_field(model, name, f"--set {name}") for name, _ in texts]
        design["set"] = {field.path: value_of_text(field, text) for field, (_, text) in zip(fields, texts)}
    print(f"{name}: {len(points)} points, {count} seeds from {first_seed}", flush=True)
    results: Results = run_campaign(design, out=_folder(search), workers=search.workers)
    rows = results.table.to_pylist()
    if rows and search.target not in rows[0]:
        raise UserError(f"--target {search.target}: no such column; there are {', '.join(rows[0])}")
    return [[row for row in rows if row["cell"] == number] for number in sorted({row["cell"] for row in rows})]


def _folder(search: Search) -> str:
    return search.out or f"formicarium-results/tune-{search.system.replace(':', '-')}"


def _range(system: System, text: str) -> tuple[NamedField, float, float]:
    name, equals, limits = text.partition("=")
    low, colon, high = limits.partition(":")
    try:
        bounds = float(low), float(high)
    except ValueError:
        bounds = (0.0, 0.0)
    if not (equals and colon and all(map(math.isfinite, bounds)) and bounds[0] < bounds[1]):
        raise UserError(f"--over {text}: expected NAME=LOW:HIGH, for example {name}=0.1:0.5")
    field = find_field(system.parameters, name, f"--over {name}")
    for bound in (low, high):
        value_of_text(field, bound)
    return field, *bounds


def _default(system: System, ranges: list[tuple[NamedField, float, float]]) -> Point:
    content = system.configure().model_dump()
    point = {}
    for field, _, _ in ranges:
        value: Any = content
        for part in field.path.split("."):
            value = value[part]
        point[field.path] = value
    return point

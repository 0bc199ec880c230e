"""Two sets of runs against each other: matched by cell, tested by target."""

import json
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, NamedTuple

from formicarium.campaigns import table
from formicarium.campaigns.files import read_json
from formicarium.campaigns.table import Row
from formicarium.commands.errors import UserError, near
from formicarium.commands.known import find_system
from formicarium.commands.summary import END
from formicarium.statistics.compare import fisher, log_rank
from formicarium.statistics.effects import Effect, hazard_ratio, holm, median_ratio, odds_ratio, risk_difference
from formicarium.systems.registry import System


class Runs(NamedTuple):
    """The runs of a folder."""

    folder: Path
    system: str
    factors: tuple[str, ...]  # columns that tell cells apart
    rows: list[Row]


class Compared(NamedTuple):
    """One target of one pair of cells."""

    cell: Mapping[str, Any]  # the factors that both cells share
    target: str
    reached: tuple[int, int]
    runs: tuple[int, int]
    difference: Effect  # of the shares, A minus B
    odds: Effect  # of A over those of B
    fisher_p: float
    hazard: Effect  # rate of A over that of B
    medians: Effect  # median of A over that of B
    log_rank_p: float
    fisher_holm: float = 1.0
    log_rank_holm: float = 1.0

    def flat(self) -> dict[str, Any]:
        """Return it as a row of a table."""
        row: dict[str, Any] = {**self.cell, "target": self.target}
        for letter, reached, runs in zip("ab", self.reached, self.runs):
            row |= {f"{letter}.reached": reached, f"{letter}.runs": runs}
        for name in ("difference", "odds", "hazard", "medians"):
            effect = getattr(self, name)
            row |= {name: effect.value, f"{name}.low": effect.low, f"{name}.high": effect.high}
        names = ("fisher_p", "fisher_holm", "log_rank_p", "log_rank_holm")
        return row | {name: getattr(self, name) for name in names}


def runs_in(folder: Path, chosen: Sequence[str]) -> Runs:
    """Read the table of a campaign that was collected, or of a set of runs, and choose rows by "name=value".

    Raises:
        UserError: if there is no table, or nothing in it fits.
        StoreError: if a file is damaged.
    """
    path = folder / "runs.parquet"
    if not path.exists():
        raise UserError(f"{path} is not there: collect the campaign first (formicarium campaign collect DESIGN)")
    rows: list[Row] = table.read(path).to_pylist()
    if (folder / "campaign.json").exists():
        manifest = read_json(folder / "campaign.json")
        design = manifest.get("design", {})
        factors = [*(design.get("rows") or [{}])[0], *design.get("factors", {})]
    else:
        manifest, factors = read_json(folder / "configuration.json"), []
    shown = [f"factor.{name}" if rows and f"factor.{name}" in rows[0] else name for name in factors]
    names = [name for name in shown if rows and name in rows[0]]
    for choice in chosen:
        name, equals, text = choice.partition("=")
        if not equals or (rows and name not in rows[0]):
            close = near(name, rows[0] if rows else ())
            raise UserError(f"{choice!r}: expected NAME=VALUE with a column of {path}.{close}")
        rows = [row for row in rows if _fits(row[name], text)]
        names = [factor for factor in names if factor != name]
        if not rows:
            raise UserError(f"{path} has no run with {choice}")
    if not rows:
        raise UserError(f"{path} has no rows")
    return Runs(folder, str(manifest.get("system")), tuple(names), rows)


def _fits(value: Any, text: str) -> bool:
    try:
        return str(value) == text or value == json.loads(text)
    except ValueError:
        return False


def system_of(one: Runs, other: Runs) -> System:
    """Return the system whose targets are compared: that of either set.

    Raises:
        UserError: if neither is known here.
    """
    try:
        return find_system(one.system)
    except UserError:
        return find_system(other.system)


def matched(one: Runs, other: Runs) -> list[tuple[dict[str, Any], list[Row], list[Row]]]:
    """Pair the cells of two sets by the factors that are columns of both; one cell on each side always is a pair.

    Raises:
        UserError: if a cell fits several of the other set, or none fits.
    """
    factors = dict.fromkeys([*one.factors, *other.factors])
    shared = [name for name in factors if name in one.rows[0] and name in other.rows[0]]
    sides = []
    for runs, option in ((one, "--a"), (other, "--b")):
        cells: dict[str, list[Row]] = {}
        for row in runs.rows:
            cells.setdefault(json.dumps([row[name] for name in shared], default=str), []).append(row)
        rest = [name for name in runs.factors if name not in shared]
        for rows in cells.values():
            for name in rest:
                values = sorted({str(row[name]) for row in rows})
                if len(values) > 1:
                    raise UserError(
                        f"{runs.folder} varies {name} ({', '.join(values[:5])}), the other does not: "
                        f"choose with {option} {name}={values[0]}"
                    )
        sides.append(cells)
    pairs = [
        ({name: rows[0][name] for name in shared}, rows, sides[1][key])
        for key, rows in sides[0].items()
        if key in sides[1]
    ]
    if not pairs and len(sides[0]) == len(sides[1]) == 1:
        pairs = [({}, one.rows, other.rows)]
    if not pairs:
        raise UserError(
            f"no cell of {one.folder} has the same {', '.join(shared)} as one of {other.folder}: "
            "choose with --a and --b"
        )
    return pairs


def comparisons(
    system: System, pairs: Sequence[tuple[Mapping[str, Any], Sequence[Row], Sequence[Row]]]
) -> list[Compared]:
    """Test every target of every pair of cells."""
    found = [
        _compared(cell, label, column, one, other, system.targets.published_cap)
        for cell, one, other in pairs
        for column, label in system.targets.columns.items()
    ]
    fishers, log_ranks = holm([row.fisher_p for row in found]), holm([row.log_rank_p for row in found])
    return [row._replace(fisher_holm=one, log_rank_holm=two) for row, one, two in zip(found, fishers, log_ranks)]


def _compared(
    cell: Mapping[str, Any], label: str, column: str, one: Sequence[Row], other: Sequence[Row], cap: float
) -> Compared:
    times: list[list[float | None]] = [[_time(row.get(column)) for row in rows] for rows in (one, other)]
    ends = [[_time(row.get(END)) or cap for row in rows] for rows in (one, other)]
    reached = tuple(sum(time is not None for time in side) for side in times)
    counts = (reached[0], len(one), reached[1], len(other))
    both = (times[0], ends[0], times[1], ends[1])
    return Compared(
        cell,
        label,
        (reached[0], reached[1]),
        (len(one), len(other)),
        risk_difference(*counts),
        odds_ratio(*counts),
        fisher(*counts).p_value,
        hazard_ratio(*both),
        median_ratio(*both),
        log_rank(*both).p_value,
    )


def _time(value: object) -> float | None:
    return float(value) if isinstance(value, int | float) else None

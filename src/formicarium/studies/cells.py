"""The cells of the paper's Table 1 with the runs that are there."""

import statistics
from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from typing import Any, NamedTuple

from formicarium.statistics.intervals import wilson
from formicarium.statistics.runtimes import RunTimes, run_times
from formicarium.systems.sequencing.parameters import MARK_I3_ROBOTS

LEVELS = (-20, -10, 0, 20, 40, 60, 80, 100)  # percent more robots than the default of a setting
TARGETS = {"time_1_s": 1, "time_5_s": 5, "time_10_s": 10}  # column of an outcome -> sequences
GOAL = "time_10_s"
PAPER_SUCCESS = (27, 30)  # ten sequences by the cap: simulated, 20 robots, setting 0

Row = Mapping[str, Any]


def level_of(setting: int, robots: int) -> int:
    """Return the column of Table 1 that a number of robots belongs to, percent above the default."""
    more = 100.0 * (robots / MARK_I3_ROBOTS[setting] - 1.0)
    return min(LEVELS, key=lambda level: abs(level - more))


def level_name(level: int) -> str:
    """Return a level as Table 1 heads its columns."""
    return f"{level:+d} %" if level else "default"


class StudyCell(NamedTuple):
    """Runs of one number of robots in one arena; there may be none yet."""

    setting: int
    side: float  # of the arena, m
    robots: int
    cap: float  # s, the end of a run that does not succeed
    runs: Sequence[Row] = ()

    @property
    def level(self) -> int:
        """Percent more robots than the default of the setting, as in Table 1."""
        return level_of(self.setting, self.robots)

    def times(self, column: str = GOAL) -> RunTimes:
        """Return the distribution of the time to a target; there must be runs."""
        return run_times([row[column] for row in self.runs], [row["duration_s"] or self.cap for row in self.runs])

    def reached(self, time: float, column: str = GOAL) -> int:
        """Count the runs that reached a target strictly before a time (TS-146)."""
        return sum(row[column] is not None and row[column] < time for row in self.runs)

    @property
    def successes(self) -> int:
        """Runs that did ten sequences before the cap."""
        return self.reached(self.cap)

    def succeeded(self, row: Row) -> bool:
        """Tell whether a run did ten sequences before the cap."""
        return row[GOAL] is not None and row[GOAL] < self.cap

    def members(self, column: str = "members", *, successful: bool = False) -> list[float]:
        """Return chain members run by run: at the end, or at completion where a chain was completed."""
        chosen = [row for row in self.runs if self.succeeded(row)] if successful else self.runs
        return [float(row[column]) for row in chosen if row[column] is not None]


def table_of(cells: Iterable[StudyCell]) -> list[dict[str, Any]]:
    """Return a row a cell: success with Wilson's interval, medians (infinite: not reached), members, causes."""
    rows = []
    for cell in cells:
        row: dict[str, Any] = {"setting": cell.setting, "side_m": round(cell.side, 4), "robots": cell.robots}
        row |= {"level": level_name(cell.level), "cap_s": cell.cap, "runs": len(cell.runs)}
        share = wilson(cell.successes, len(cell.runs)) if cell.runs else None
        row |= {"successes": cell.successes, "low": share and share.low, "high": share and share.high}
        for column in ("time_chain_s", *TARGETS):
            row[f"median_{column}"] = cell.times(column).median if cell.runs else None
        for column in ("members", "members_at_completion"):
            values = cell.members(column)
            row[f"{column}_mean"] = statistics.fmean(values) if values else None
            row[f"{column}_sd"] = statistics.stdev(values) if len(values) > 1 else None
        causes = Counter(str(run["cause"]) for run in cell.runs if run["cause"])
        row["causes"] = "; ".join(f"{count} {cause}" for cause, count in causes.most_common())
        rows.append(row)
    return rows


def by_setting(cells: Iterable[StudyCell]) -> dict[int, dict[int, StudyCell]]:
    """Return setting -> level -> cell, of the cells that have runs."""
    found: dict[int, dict[int, StudyCell]] = {}
    for cell in cells:
        if cell.runs:
            found.setdefault(cell.setting, {})[cell.level] = cell
    return found

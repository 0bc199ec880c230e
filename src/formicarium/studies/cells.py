"""The cells of the paper's Table 1, of all four variants, with the runs that are there."""

from collections.abc import Iterable, Mapping, Sequence
from typing import Any, NamedTuple

from formicarium.statistics.runtimes import RunTimes, run_times
from formicarium.systems.sequencing.parameters import MARK_I3, MARK_I4, MARK_II3, MARK_II4

VARIANTS = {variant.name: variant for variant in (MARK_I3, MARK_I4, MARK_II3, MARK_II4)}
NAMES = {"mark-i3": "Mark I3", "mark-i4": "Mark I4", "mark-ii3": "Mark II3", "mark-ii4": "Mark II4"}
LEVELS = (-20, -10, 0, 20, 40, 60, 80, 100)  # percent more robots than the default of a setting
TARGETS = {"time_1_s": 1, "time_5_s": 5, "time_10_s": 10}  # column of an outcome -> sequences
GOAL = "time_10_s"
# Runs with ten sequences by the cap and runs, as the paper says: simulated, default robots, setting 0 (R2 to R5)
PAPER = {"mark-i3": (27, 30), "mark-i4": (27, 30), "mark-ii3": (24, 30), "mark-ii4": (20, 30)}
PAPER_ROBOTS = (9, 10)  # the same of Mark I3 on e-pucks (R1)

Row = Mapping[str, Any]


def level_of(variant: str, setting: int, robots: int) -> int:
    """Return the column of Table 1 that a number of robots belongs to, percent above the default."""
    more = 100.0 * (robots / VARIANTS[variant].robots[setting] - 1.0)
    return min(LEVELS, key=lambda level: abs(level - more))


def level_name(level: int) -> str:
    """Return a level as Table 1 heads its columns."""
    return f"{level:+d} %" if level else "default"


class StudyCell(NamedTuple):
    """Runs of one variant with one number of robots in one arena; there may be none yet."""

    variant: str
    setting: int
    side: float  # of the arena, m
    robots: int
    cap: float  # s, the end of a run that does not succeed
    runs: Sequence[Row] = ()

    @property
    def level(self) -> int:
        """Percent more robots than the default of the setting, as in Table 1."""
        return level_of(self.variant, self.setting, self.robots)

    def times(self, column: str = GOAL) -> RunTimes:
        """Return the distribution of the time to a target; there must be runs."""
        return run_times([row[column] for row in self.runs], self.ends)

    @property
    def ends(self) -> list[float]:
        """When each run ended; one that was ended early counts as run to its cap (TS-145)."""
        return [row["duration_s"] or self.cap for row in self.runs]

    def reached(self, time: float, column: str = GOAL) -> int:
        """Count the runs that reached a target strictly before a time (TS-146)."""
        return sum(row[column] is not None and row[column] < time for row in self.runs)

    @property
    def successes(self) -> int:
        """Runs that did ten sequences before the cap."""
        return self.reached(self.cap)

    @property
    def counts(self) -> tuple[int, int]:
        """Successes and runs."""
        return self.successes, len(self.runs)

    def succeeded(self, row: Row) -> bool:
        """Tell whether a run did ten sequences before the cap."""
        return row[GOAL] is not None and row[GOAL] < self.cap

    def members(self, column: str = "members", *, successful: bool = False) -> list[float]:
        """Return chain members run by run: at the end, or at completion where a chain was completed."""
        chosen = [row for row in self.runs if self.succeeded(row)] if successful else self.runs
        return [float(row[column]) for row in chosen if row[column] is not None]

    @property
    def links_of_branches(self) -> list[float]:
        """Return the links of every branch of every run in which the loop was closed (Mark II)."""
        closed = [row["branch_links"] for row in self.runs if row["time_chain_s"] is not None]
        return [float(links) for text in closed for links in str(text).split()]


Study = dict[str, dict[int, dict[int, StudyCell]]]  # variant -> setting -> level -> cell


def grid(cells: Iterable[StudyCell], least: int = 1) -> Study:
    """Return the cells that have so many runs, by variant, setting and level."""
    found: Study = {variant: {} for variant in VARIANTS}
    for cell in cells:
        if len(cell.runs) >= least:
            found[cell.variant].setdefault(cell.setting, {})[cell.level] = cell
    return found


def pooled(cells: Iterable[StudyCell]) -> tuple[int, int]:
    """Return successes and runs of several cells together."""
    counts = [cell.counts for cell in cells]
    return sum(one for one, _ in counts), sum(runs for _, runs in counts)

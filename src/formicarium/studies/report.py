"""The paper's study beside ours: verdicts, cells, causes of failure, checks and figures, as a document."""

import math
from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from statistics import fmean

from formicarium.studies.cells import LEVELS, NAMES, VARIANTS, StudyCell, grid, level_name
from formicarium.studies.claims import Claim, claims
from formicarium.studies.document import Block, Grid, Heading, Picture, Text
from formicarium.studies.tables import causes, table_s3
from formicarium.studies.traps import Check
from formicarium.studies.verdicts import LEAST_RUNS

HOW = (
    "Level 5 %. Where a statement is tested in several settings or on several targets, the p-values are adjusted "
    "together (Holm). Compatible: these runs do not contradict the paper, which is less than proving it right. Better "
    "and worse are meant for the swarm: a verdict of better says that ours does something clearly better than the "
    "paper's, which is a difference too. Every statement has one test, fixed from its wording before the listed runs "
    "of Marks I4, II3 and II4 were made; what the paper leaves open (linear, about the same, reliably) has a number of "
    "ours, given in the finding."
)
POOLED = (
    "Settings are pooled where the paper speaks of all of them at once (R11, R12, R14, R15: one difference in success "
    "over the settings that have runs on both sides); all cells of a variant are pooled in R18 (runs with a first "
    "sequence), in R20, and in the derived checks of the search, because the correct order is drawn from the "
    "seed whatever N and arena."
)
VERDICT = {True: "passed", False: "FAILED", None: "not complete yet"}


def report(
    cells: Sequence[StudyCell],
    published: Mapping[str, Sequence[float]],
    checks: Iterable[Check] = (),
    pictures: Iterable[Picture] = (),
) -> list[Block]:
    """Return the whole report; parts without runs say so or are left out."""
    found = claims(cells)
    verdicts = ", ".join(f"{count} {verdict}" for verdict, count in Counter(c.verdict for c in found).most_common())
    blocks: list[Block] = [
        Heading("Task sequencing: the paper's study and ours", 1),
        Text("Garattoni & Birattari, Autonomous task sequencing in a robot swarm, Science Robotics 3 (2018)."),
        _standing(cells),
        Heading("What the paper says, tested"),
        Text(f"{verdicts}. Cells with {LEAST_RUNS} runs or more are tested."),
        _verdicts(found),
        Text(HOW),
        Text(POOLED),
    ]
    base = grid(cells)["mark-i3"].get(0, {}).get(0)
    blocks += _table_s3(published, base) if base else []
    for variant, levels in grid(cells).items():
        blocks += _successes(variant, [cell for cell in cells if cell.variant == variant]) if levels else []
    blocks += _causes(cells)
    traps = [[check.number, check.statement, check.finding, VERDICT[check.passed]] for check in checks]
    if traps:
        blocks += [Heading("Checks on what is stored"), Grid(("trap", "check", "found", ""), traps)]
    figures = list(pictures)
    return [*blocks, *([Heading("Figures")] if figures else []), *figures]


def _standing(cells: Sequence[StudyCell]) -> Grid:
    rows = []
    for variant, name in NAMES.items():
        own = [cell for cell in cells if cell.variant == variant]
        sources = sorted({run["sources"] for cell in own for run in cell.runs})
        early = sum(run.get("hopeless_s") is not None for cell in own for run in cell.runs)
        runs = sum(len(cell.runs) for cell in own)
        there = f"{sum(bool(cell.runs) for cell in own)} of {len(own)}"
        rows.append([name, str(runs), there, str(early), ", ".join(sources) or "none"])
    return Grid(("variant", "runs", "cells with runs", "ended early (failures)", "sources"), rows)


def _verdicts(found: Sequence[Claim]) -> Grid:
    return Grid(("", "the paper", "ours", "verdict"), [[c.number, c.statement, c.finding, c.verdict] for c in found])


def _table_s3(published: Mapping[str, Sequence[float]], base: StudyCell) -> list[Block]:
    columns = {"time_chain_s": "chain", "time_1_s": "1", "time_5_s": "5", "time_10_s": "10"}
    heads = ["run", *(f"{who} {label}" for who in ("e-pucks", "ours") for label in columns.values())]
    rows = [
        [row["run"], *(_seconds(row[f"{who}{column}"]) for who in ("paper_", "") for column in columns)]
        for row in table_s3(published, base)
    ]
    said = f"Times in seconds, a dash: not by 2,400 s. Ours are the first ten by seed, medians of all {len(base.runs)}."
    return [Heading("Table S3 beside ours"), Text(said), Grid(heads, rows)]


def _seconds(time: float | None) -> str:
    return "" if time is None else f"{time:,.0f}" if math.isfinite(time) else "–"


def _successes(variant: str, cells: Sequence[StudyCell]) -> list[Block]:
    own = grid(cells)[variant]
    rows = []
    for setting in range(len(VARIANTS[variant].robots)):
        found = (own.get(setting, {}).get(level) for level in LEVELS)
        rows.append([str(setting), *(_success(cell) for cell in found)])
    text = "Runs with ten sequences by the cap, of those done; in brackets the mean number of chain members at the end."
    return [Heading(NAMES[variant]), Text(text), Grid(["setting", *map(level_name, LEVELS)], rows)]


def _success(cell: StudyCell | None) -> str:
    return f"{cell.successes}/{len(cell.runs)} ({fmean(cell.members()):.1f})" if cell else ""


def _causes(cells: Iterable[StudyCell]) -> list[Block]:
    rows = []
    for cell in cells:
        if found := causes(cell.runs):
            early = sum(run.get("hopeless_s") is not None for run in cell.runs)
            named = "; ".join(f"{count} {cause}" for cause, count in found.most_common())
            where = [NAMES[cell.variant], str(cell.setting), str(cell.robots), level_name(cell.level)]
            rows.append([*where, f"{len(cell.runs) - cell.successes}/{len(cell.runs)}", str(early), named])
    if not rows:
        return []
    heads = ("variant", "setting", "robots", "level", "failed", "ended early", "causes, from the event logs")
    return [Heading("Why runs failed"), Grid(heads, rows)]

"""How a study could cheat, T23 to T26, looked for in what is stored and in one run of so many done again."""

from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np

from formicarium.robots.epuck import Epuck
from formicarium.studies.cells import NAMES, TARGETS, VARIANTS, Row, StudyCell
from formicarium.studies.tables import RESULTS
from formicarium.systems.sequencing.log import EventKind
from formicarium.systems.sequencing.memory import Role

NOISES = tuple(name for name in Epuck.model_fields if name.endswith(("noise", "floor", "loss", "miss")))
FINE = ("executions", "failures", "packets_heard", "blobs_dropped")  # columns that any difference shows in
RUNS = 30  # of a cell, in the paper
Parameters = Mapping[str, Mapping[str, Any]]


class Again(NamedTuple):
    """A stored run and the same run once more, with its log."""

    stored: Row
    row: Row
    events: np.ndarray  # EVENT
    cycle_time: float  # s


class Stored(NamedTuple):
    """What is stored of one variant."""

    variant: str
    cells: Sequence[StudyCell]
    seeds: Sequence[Sequence[int]]  # of each cell, as listed in the design
    parameters: Sequence[Parameters]  # of each cell, as hashed into the identity of its rows
    crashed: int = 0  # runs that ended with an error and have no row
    again: Sequence[Again] = ()
    noisier: Sequence[tuple[Row, Row]] = ()  # a stored row, the same with all noise doubled
    control: Sequence[Row] = ()  # runs that had been ended early, run on to the cap


class Check(NamedTuple):
    """A trap with what was found."""

    number: str
    statement: str
    finding: str
    passed: bool | None  # None: nothing to look at yet


def checks(stored: Stored) -> list[Check]:
    """Look for every trap in the runs of one variant."""
    name = NAMES[stored.variant]
    there = [run for cell in stored.cells for run in cell.runs]
    tests = (
        ("T23", "noise is on in every run, as in every other cell", noise_is_on(stored)),
        ("T23", "doubled noise changes the result", noise_matters(stored)),
        ("T24", "seeds as committed, all of them, caps as printed, failures counted", seeds_and_caps(stored)),
        ("T24", "a run done again gives the stored row; its times come from its log", rows_again(stored)),
        ("T25", "a run that was ended early is a failure at its cap", early_ends(stored)),
        ("T25", "none of those would have succeeded (TS-145)", early_ends_run_on(stored)),
        ("T26", "members are guardians, links and tails, also by the log of roles", members(stored)),
    )
    return [
        Check(f"{number} {name}", said, *(found if there else ("no runs yet", None))) for number, said, found in tests
    ]


Found = tuple[str, bool | None]


def noise_is_on(stored: Stored) -> Found:
    """T23: the noise in the parameters of every cell with runs is the table's, and not zero; controllers are equal."""
    used = [own for own, cell in zip(stored.parameters, stored.cells) if cell.runs]
    usual = Epuck()
    off = {
        f"{noise} = {own['epuck'][noise]}"
        for own in used
        for noise in NOISES
        if own["epuck"][noise] != getattr(usual, noise) or own["epuck"][noise] <= 0
    }
    controllers = {repr(sorted(own["behaviour"].items())) for own in used}
    finding = f"{len(NOISES)} kinds of noise in {len(used)} configurations, {len(controllers)} controller"
    return (f"{finding}; {', '.join(sorted(off))}" if off else finding), not off and len(controllers) == 1


def noise_matters(stored: Stored) -> Found:
    """T23: a run with all noise doubled is another run."""
    if not stored.noisier:
        return "not run yet", None
    same = sum(_results(one) == _results(two) for one, two in stored.noisier)
    return f"{same} of {len(stored.noisier)} rows stayed the same", same == 0


def seeds_and_caps(stored: Stored) -> Found:
    """T24: every cell has the listed seeds and no others, and the cap of Table 1."""
    full = foreign = caps = 0
    for cell, listed in zip(stored.cells, stored.seeds):
        seeds = [run["seed"] for run in cell.runs]
        full += len(seeds) == RUNS and sorted(seeds) == sorted(listed)
        foreign += len(set(seeds) - set(listed)) + len(seeds) - len(set(seeds))
        caps += cell.cap == VARIANTS[cell.variant].time_caps[cell.setting]
    runs, wanted = sum(len(cell.runs) for cell in stored.cells), sum(map(len, stored.seeds))
    failures = sum(not cell.succeeded(run) for cell in stored.cells for run in cell.runs)
    finding = (
        f"{runs} of {wanted} listed runs ({failures} of them failures), {full} of {len(stored.cells)} cells complete, "
        f"{foreign} other seeds, {stored.crashed} crashed, {caps} caps as printed"
    )
    sound = not foreign and not stored.crashed and caps == len(stored.cells)
    return finding, (None if sound and full < len(stored.cells) else sound)


def rows_again(stored: Stored) -> Found:
    """T24: the same row, with times that are those of the sequences in the log."""
    if not stored.again:
        return "not run yet", None
    same = sum(_results(run.stored) == _results(run.row) for run in stored.again)
    timed = sum(
        all(run.stored[column] == _time_of(run, count) for column, count in TARGETS.items()) for run in stored.again
    )
    finding = f"{same} of {len(stored.again)} rows the same, times of {timed} recomputed from the log"
    return finding, same == timed == len(stored.again)


def early_ends(stored: Stored) -> Found:
    """T25: no success, no time of the tenth sequence, and the cap as its duration."""
    ended = [(cell, run) for cell in stored.cells for run in cell.runs if run.get("hopeless_s") is not None]
    wrong = sum(bool(run["success"]) or cell.succeeded(run) or run["duration_s"] < cell.cap for cell, run in ended)
    return f"{len(ended)} runs were ended early, {wrong} of them not counted as failures at the cap", wrong == 0


def early_ends_run_on(stored: Stored) -> Found:
    """T25: the sample of them that was run on to the cap has no success."""
    if not any(run.get("hopeless_s") is not None for cell in stored.cells for run in cell.runs):
        return "no run was ended early", True
    if not stored.control:
        return "not run yet", None
    lucky = sum(bool(run["success"]) for run in stored.control)
    return f"{lucky} successes in {len(stored.control)} of them run on to the cap", lucky == 0


def members(stored: Stored) -> Found:
    """T26: the roles of a row add up to its members, and the log of roles gives the same number."""
    wrong = sum(
        run["members"] != run["guardians"] + run["links"] + run["tails"]
        for cell in stored.cells
        for run in cell.runs
        if "guardians" in run
    )
    logged = sum(members_of(run.events) == run.stored["members"] for run in stored.again)
    finding = f"{wrong} rows that do not add up; by the log {logged} of {len(stored.again)} runs done again"
    sound = wrong == 0 and logged == len(stored.again)
    return finding, (None if sound and not stored.again else sound)


def members_of(events: np.ndarray) -> int:
    """Count the living members of the chain at the end from the log of roles and deaths alone."""
    roles: dict[int, int] = {}
    for event in events[np.isin(events["kind"], (EventKind.ROLE, EventKind.DIED))]:
        roles[int(event["robot"])] = Role.RUNNER if event["kind"] == EventKind.DIED else int(event["value"])
    return sum(role != Role.RUNNER for role in roles.values())


def _results(row: Row) -> list[Any]:
    return [row.get(name) for name in (*RESULTS, *FINE)]


def _time_of(run: Again, count: int) -> float | None:
    done = run.events[(run.events["kind"] == EventKind.SEQUENCE) & (run.events["value"] == count)]
    return round(float(done["cycle"][0] + 1) * run.cycle_time, 6) if len(done) else None

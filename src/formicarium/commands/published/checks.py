"""One run of so many again: with its log, with doubled noise, and to the cap where it was ended early (T23 to T26)."""

import hashlib
from pathlib import Path
from typing import Any

from formicarium.campaigns import table
from formicarium.campaigns.ledger import Ledger
from formicarium.commands.campaign.sitting import Request, perform
from formicarium.commands.campaign.study import Overrides, Study, study_of
from formicarium.commands.published import store
from formicarium.commands.tables import trial_of
from formicarium.robots.epuck import Epuck
from formicarium.studies.cells import Row, StudyCell
from formicarium.studies.traps import NOISES, Again, Stored

AGAIN, NOISE, CONTROL = "again", "doubled-noise", "to-the-cap"
DOUBLED = {f"epuck.{name}": 2.0 * getattr(Epuck(), name) for name in NOISES}


def run_checks(studies: list[Study], one_in: int, workers: int | None) -> int:
    """Run one in so many of the stored runs again, drawn by a hash of the seed; return 0 if every run is done."""
    code = 0
    for study in studies:
        for content in _contents(study, one_in):
            again = study_of(content, content["name"], _folder(study, content["name"]), Overrides(settings=store.MORE))
            code = max(code, perform(again, Request(workers=workers)))
    return code


def drawn(seed: int, one_in: int) -> bool:
    """Tell whether a run is in the sample: decided by its seed alone."""
    return int.from_bytes(hashlib.blake2b(str(seed).encode(), digest_size=8).digest()) % one_in == 0


def stored(study: Study, cells: list[StudyCell], sources: str | None) -> Stored:
    """Return what is stored of a campaign, for ``traps.checks``."""
    mine = {_key(run): run for cell in cells for run in cell.runs}
    again, noisier = [], []
    for run, events in _again(study, AGAIN, sources, events=True):
        if _key(run) in mine:
            trial = trial_of(run, events, None, study.system.kinds)
            again.append(Again(mine[_key(run)], run, trial.events, trial.scene.cycle_time))
    for run, _ in _again(study, NOISE, sources):
        if _key(run) in mine:
            noisier.append((mine[_key(run)], run))
    control = [run for run, _ in _again(study, CONTROL, sources)]
    seeds = [job.cell.seeds for job in study.jobs]
    parameters = [job.configuration.parameters for job in study.jobs]
    keys = {key for job in study.jobs for key in job.keys}
    crashed = len(Ledger(study.folder).failures() & keys)
    return Stored(study.system.name, cells, seeds, parameters, crashed, again, noisier, control)


def _contents(study: Study, one_in: int) -> list[dict[str, Any]]:
    rows = [row for row in store.tidy_rows(study) if drawn(row["seed"], one_in)]
    early = [row for row in rows if row.get("hopeless_s") is not None]
    fixed = dict(study.design.fixed)
    return [
        content
        for content in (
            _content(study, AGAIN, rows, fixed) | {"keep": ["events"]},
            _content(study, NOISE, rows, fixed | DOUBLED),
            _content(study, CONTROL, early, fixed | {"swarm.idle_limit": 0.0, "swarm.stall_limit": 0.0}),
        )
        if content["rows"]
    ]


def _content(study: Study, kind: str, rows: list[dict], fixed: dict[str, Any]) -> dict[str, Any]:
    chosen = [{"setting": row["setting"], "robots": row["robots"], "first_seed": row["seed"]} for row in rows]
    name = f"{study.design.name}-{kind}"
    return {"name": name, "system": study.design.system, "replicates": 1, "set": fixed, "rows": chosen}


def _again(study: Study, kind: str, sources: str | None, *, events: bool = False) -> list[tuple[dict, Any]]:
    folder = Path(_folder(study, f"{study.design.name}-{kind}"))
    ledger = Ledger(folder)
    if ledger.manifest is None:
        return []
    found = study_of(ledger.manifest["design"], str(folder), str(folder), Overrides(sources=sources))
    rows = store.tidy_rows(found)
    if not events:
        return [(row, None) for row in rows]
    paths = [ledger.table_path("events", (row["identity"], row["seed"])) for row in rows]
    return [(row, table.read(path)) for row, path in zip(rows, paths) if path.exists()]


def _folder(study: Study, name: str) -> str:
    return str(study.folder.parent / name)


def _key(row: Row) -> tuple[int, int, int]:
    return row["setting"], row["robots"], row["seed"]

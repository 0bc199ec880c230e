"""Trials, sets and campaigns from Python: the same runs, folders and identities as the command line's."""

import os
import sys
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

from pydantic import BaseModel

from formicarium.campaigns import runner
from formicarium.campaigns.coordinator import run_campaign as run_jobs
from formicarium.campaigns.ledger import Ledger
from formicarium.campaigns.provenance import session
from formicarium.campaigns.store import Store
from formicarium.campaigns.tidy import tidy
from formicarium.campaigns.workers import Processes
from formicarium.campaigns.writer import Writer
from formicarium.commands.calls.results import Results
from formicarium.commands.campaign.study import open_study, study_of
from formicarium.commands.errors import UserError
from formicarium.commands.fields import find_field, with_values
from formicarium.commands.folders import results_folder
from formicarium.commands.known import find_system, parameters_of
from formicarium.commands.session import LIBRARIES
from formicarium.commands.tables import EVERY
from formicarium.commands.work import configuration_of, function_of
from formicarium.sources import PACKAGE
from formicarium.trial.record import Trial


def parameters(
    system: str, *, setting: int | None = None, robots: int | None = None, changes: Mapping[str, Any] | None = None
) -> BaseModel:
    """Return all numbers of a system, SI units; ``formicarium describe SYSTEM`` lists them.

    Args:
        system: a name of ``system_names()``, or "module:object".
        setting: a published setting, by its number.
        robots: number of robots.
        changes: name -> value; the last part of a name is enough where it is unique ("spacing").

    Raises:
        UserError: if a name or a value is not allowed; says which and what is.
    """
    found = find_system(system)
    chosen = parameters_of(found, setting, robots, ())
    values = {find_field(found.parameters, name, f"changes[{name!r}]").path: v for name, v in (changes or {}).items()}
    return with_values(chosen, values)


def run_trial(
    system: str, seed: int = 1, *, parameters: BaseModel | None = None, frames_every: float | None = None
) -> Trial:
    """Run one trial in this process and keep nothing on disk.

    Args:
        system: a name of ``system_names()``, or "module:object".
        seed: decides everything that is random.
        parameters: all its numbers; the defaults if None.
        frames_every: seconds between two frames; no frames if None.

    Returns:
        ``outcome``: a row, name -> number or text, times in seconds; ``events``: (E,) records of cycle, kind, robot,
        subject, value, detail; ``frames``: x, y (m) and heading (rad) of shape (F, N), or None; ``scene``.

    Raises:
        UserError: if there is no such system.
        Explained: if a behaviour of one's own fails; names file, line, robot and cycle.
    """
    found = find_system(system)
    return found.run(parameters or found.configure(), seed, frames_every=frames_every)


def run_set(
    system: str,
    seeds: Iterable[int],
    *,
    parameters: BaseModel | None = None,
    out: str | Path | None = None,
    workers: int | None = None,
    frames_every: float | None = None,
) -> Results:
    """Run a system for every seed that the folder lacks, and return all of them.

    A program that uses several workers must do so under ``if __name__ == "__main__":``.

    Args:
        system: a name of ``system_names()``, or "module:object".
        seeds: of the runs.
        parameters: all its numbers; the defaults if None.
        out: folder of the results, as ``formicarium run --out``; a new one in formicarium-results if None.
        workers: processes that share the runs, one a core if None. Results do not depend on it.
        frames_every: seconds between two frames; no frames if None.

    Raises:
        UserError: if there is no such system.
        StoreError: if the folder is of other parameters or sources, or a file is damaged.
        RuntimeError: if a run fails; the others are kept, and the same call tries it again.
    """
    found = find_system(system)
    chosen = parameters or found.configure()
    wanted = sorted({int(seed) for seed in seeds})
    if not wanted or wanted[0] < 0:
        raise UserError(f"seeds {wanted}: at least one whole number, none below 0")
    configuration = configuration_of(found, chosen)
    folder = Path(out) if out is not None else results_folder(found.name, configuration.identity)
    every = dict.fromkeys(wanted, frames_every) if frames_every is not None else {}
    function = function_of(system, chosen, every, configuration.sources)
    tables = {"events": {}, **({"frames": {EVERY: str(frames_every)}} if frames_every is not None else {})}
    with Store(folder, configuration) as store:
        if len(store.rows_of(wanted)) < len(wanted):
            store.note(session(sys.argv, PACKAGE, LIBRARIES))
        report = runner.run_set(function, wanted, store, workers=workers, wanted=lambda seed: tables)
    if report.failures:
        seed, reason = next(iter(report.failures.items()))
        raise RuntimeError(f"{len(report.failures)} of {len(wanted)} runs failed; seed {seed}:\n{reason}")
    return Results.of_set(folder, found, wanted)


def run_campaign(
    design: str | Path | Mapping[str, Any], *, out: str | Path | None = None, workers: int | None = None
) -> Results:
    """Run every cell of a design that its folder lacks, and return one tidy table of all runs.

    Args:
        design: a file (TOML, YAML, Python), or its content: name, system, replicates, factors, set.
        out: folder of the results; formicarium-results/NAME if None.
        workers: processes that share the runs, one a core if None. Results do not depend on it.

    Raises:
        DesignError, UserError: if the design cannot be run; names the key and the value.
        StoreError: if the folder cannot be used.
        RuntimeError: if a run fails; the others are kept. ``formicarium campaign run --retry`` tries again.
    """
    place = None if out is None else str(out)
    study = study_of(design, "design", place) if isinstance(design, Mapping) else open_study(str(design), place)
    ledger = Ledger(study.folder)
    with Writer(ledger, study.manifest, study.jobs) as writer:
        writer.note_session(session(sys.argv, PACKAGE, LIBRARIES))
        crew = Processes(workers or os.cpu_count() or 1, study.design.time_limit)
        report = run_jobs(study.jobs, writer, crew, keep=study.design.keep)
    if report.failures:
        run = report.failures[0]
        raise RuntimeError(f"{report.standing.failed} of {study.total} runs failed; seed {run.seed}:\n{run.failure}")
    return Results(study.folder, tidy(ledger.rows(), study.jobs), study.system)

"""What ``formicarium campaign run`` does: open the ledger, run what is missing, say what came of it."""

import json
import math
import os
import shlex
import signal
import sys
import threading
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from typing import Any, NamedTuple

from rich.console import Console

from formicarium.campaigns.coordinator import Report, Standing, run_campaign
from formicarium.campaigns.crew import Crew
from formicarium.campaigns.ledger import Ledger
from formicarium.campaigns.provenance import session
from formicarium.campaigns.workers import Processes
from formicarium.campaigns.writer import Writer
from formicarium.commands.campaign.progress import CampaignProgress
from formicarium.commands.campaign.slurm import write_script
from formicarium.commands.campaign.study import Overrides, Study
from formicarium.commands.errors import UserError
from formicarium.commands.session import LIBRARIES
from formicarium.sources import PACKAGE

SHOWN_FAILURES = 3


class Request(NamedTuple):
    """How a person wants it run; see ``run`` for the meaning."""

    workers: int | None = None
    time_limit: float | None = None
    retry: bool = False
    share: str | None = None
    dask: str | None = None
    dask_options: tuple[str, ...] = ()


def perform(study: Study, request: Request) -> int:
    """Run what the campaign lacks and return the exit code: 0 if every run is done, 1 if not.

    Raises:
        UserError: if the request makes no sense.
        StoreError: if the folder cannot be used.
        KeyboardInterrupt: on Ctrl-C or a request to end, with a message that says how to go on.
    """
    _check(request)
    share = _share(request.share)
    ledger = Ledger(study.folder)
    with terminable(), Writer(ledger, study.manifest, study.jobs) as writer:
        keys = [key for job in study.jobs for key in job.keys][share[0] :: share[1]]
        forgotten = writer.forget_failures(keys) if request.retry else 0
        writer.note_session({**session(sys.argv, PACKAGE, LIBRARIES), "retried": forgotten})
        trouble = Console(stderr=True)
        crew = _crew(study, request)
        latest: list[Standing] = []
        with CampaignProgress(trouble, study.design.name) as progress:

            def told(standing: Standing) -> None:
                latest[:] = [standing]
                progress.show(standing)

            try:
                report = run_campaign(study.jobs, writer, crew, keep=study.design.keep, share=share, progress=told)
            except KeyboardInterrupt:
                raise KeyboardInterrupt(_interrupted(study, ledger)) from None
        _print(study, report)
        return 0 if report.standing.done == report.standing.total else 1


def _check(request: Request) -> None:
    if request.workers is not None and request.workers < 1:
        raise UserError(f"--workers {request.workers}: must be at least 1")
    if request.dask is None and request.dask_options:
        raise UserError("--dask-option: only together with --dask")
    if request.dask is not None and "://" in request.dask and request.workers is not None:
        raise UserError(f"--workers: the scheduler at {request.dask} has its own")
    if request.time_limit is not None and not (math.isfinite(request.time_limit) and request.time_limit > 0):
        raise UserError(f"--time-limit {request.time_limit:g}: must be a time in seconds above 0")


def _crew(study: Study, request: Request) -> Crew:
    time_limit = request.time_limit or study.design.time_limit
    if request.dask is None:
        return Processes(request.workers or os.cpu_count() or 1, time_limit)
    try:
        from formicarium.campaigns.cluster import DaskCrew, open_cluster
    except ImportError as error:
        raise UserError(f'--dask: {error.name} is not installed: pip install "formicarium[cluster]"') from error
    client, cluster = open_cluster(request.dask, request.workers, _typed(request.dask_options))
    return DaskCrew(client, cluster, time_limit)


def _typed(options: Sequence[str]) -> dict[str, Any]:
    found = {}
    for option in options:
        name, equals, text = option.partition("=")
        if not equals:
            raise UserError(f"--dask-option {option}: expected NAME=VALUE")
        try:
            found[name.replace("-", "_")] = json.loads(text)
        except ValueError:
            found[name.replace("-", "_")] = text
    return found


def offer_script(study: Study, overrides: Overrides, request: Request, tasks: int | None, sbatch: Sequence[str]) -> int:
    """Write a job-array script and say how to submit it; return the exit code.

    Raises:
        UserError: if the request makes no sense.
        StoreError: if the script cannot be written.
    """
    _check(request)
    if tasks is None:
        raise UserError("--sbatch: only together with --slurm-array")
    if request.dask is not None or request.share is not None:
        raise UserError("--slurm-array: not together with --dask or --share")
    more = ["--time-limit", str(request.time_limit)] if request.time_limit is not None else []
    more += ["--retry"] if request.retry else []
    script = write_script(study, overrides, tasks, request.workers or 1, more, sbatch)
    console = Console()
    console.print(f"written   {script}", highlight=False, soft_wrap=True)
    console.print(f"submit    sbatch {shlex.quote(str(script))}", highlight=False, soft_wrap=True)
    return 0


def _share(text: str | None) -> tuple[int, int]:
    if text is None:
        return (0, 1)
    first, _, every = text.partition("/")
    if not (first.isdecimal() and every.isdecimal() and int(first) < int(every)):
        raise UserError(f"--share {text}: expected K/N with K from 0 to N - 1, for example 0/4")
    return (int(first), int(every))


@contextmanager
def terminable() -> Iterator[None]:
    """Take a request to end (SIGTERM, as batch systems send it) like Ctrl-C."""

    def stop(*_: Any) -> None:
        signal.raise_signal(signal.SIGINT)

    if threading.current_thread() is not threading.main_thread():
        yield  # signals are delivered to the main thread only
        return
    previous = signal.signal(signal.SIGTERM, stop)
    try:
        yield
    finally:
        signal.signal(signal.SIGTERM, previous)


def _interrupted(study: Study, ledger: Ledger) -> str:
    done = sum(ledger.has(key) for job in study.jobs for key in job.keys)
    return f"interrupted: {done} of {study.total} runs are done and kept in {study.folder}. The same command continues."


def _print(study: Study, report: Report) -> None:
    screen, trouble = Console(), Console(stderr=True)
    standing = report.standing
    loaded = f", {report.loaded} of them loaded" if report.loaded else ""
    failed = f", {standing.failed} failed" if standing.failed else ""
    screen.print(
        f"[bold]{study.design.name}[/bold]: {standing.done} of {standing.total} runs done{loaded}{failed}; "
        f"{standing.produced} now, in {standing.seconds:,.0f} s",
        highlight=False,
    )
    screen.print(f"results   {study.folder}", highlight=False, soft_wrap=True)
    screen.print(
        f"next      formicarium campaign collect {study.source}{study.options}", highlight=False, soft_wrap=True
    )
    for note in report.notes:
        trouble.print(f"formicarium: {note}", highlight=False, soft_wrap=True, markup=False)
    for run in report.failures[:SHOWN_FAILURES]:
        cell = next(job.cell for job in study.jobs if (run.identity, run.seed) in job.keys)
        where = f"cell {cell.number} ({cell.label}), seed {run.seed}"
        said = f"\nformicarium: {run.ending}: {where}\n{run.failure.rstrip()}"
        trouble.print(said, highlight=False, soft_wrap=True, markup=False)
    if standing.failed:
        trouble.print(
            f"\nformicarium: {standing.failed} run{'s' * (standing.failed > 1)} failed; tracebacks in "
            f"{study.folder / 'failures'}. Try them again with --retry.",
            highlight=False, soft_wrap=True, markup=False,
        )  # fmt: skip

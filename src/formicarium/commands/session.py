"""What ``formicarium run`` does: check the request, run the set, draw, sum up."""

import math
import sys
from pathlib import Path
from typing import NamedTuple

from rich.console import Console

from formicarium.campaigns.provenance import session
from formicarium.campaigns.runner import SetReport, run_set
from formicarium.campaigns.store import Store
from formicarium.commands.errors import UserError
from formicarium.commands.folders import results_folder
from formicarium.commands.known import find_system
from formicarium.commands.mission import parameters_with_map, print_missions
from formicarium.commands.pictures import draw_run, draw_set
from formicarium.commands.progress import Progress
from formicarium.commands.runs import RECORDINGS
from formicarium.commands.summary import print_summary
from formicarium.commands.tables import EVERY
from formicarium.commands.work import as_json, configuration_of, function_of, record_run, recording_of
from formicarium.sources import PACKAGE

FRAMES_OF_ONE_RUN = 2.0  # seconds: enough for the last frame and a look at the way there
FRAMES_OF_A_MOVIE = 0.5  # seconds: 15 times real time at 30 pictures a second
MOVIES = 10  # with more runs than this only the first gets a movie
MOST_RUNS = 100_000  # in one set
LIBRARIES = ("formicarium", "numba", "numpy", "scipy", "pydantic", "pyarrow", "matplotlib")


class Request(NamedTuple):
    """What a person asked for; see ``run`` for the meaning."""

    system: str
    runs: int
    seed: int
    robots: int | None
    setting: int | None
    settings: tuple[str, ...]
    out: Path | None
    workers: int | None
    movie: bool
    frames: float | None
    record: bool = False
    map: str | None = None


def perform(request: Request) -> int:
    """Do what was asked and return the exit code.

    Raises:
        UserError: if the request makes no sense.
        StoreError: if the folder of results cannot be used.
        KeyboardInterrupt: on Ctrl-C, with a message that says what is done and how to go on.
    """
    _check(request)
    system = find_system(request.system)
    parameters = parameters_with_map(system, request.setting, request.robots, request.settings, request.map)
    configuration = configuration_of(system, parameters)
    folder = request.out or results_folder(system.name, configuration.identity)
    seeds = range(request.seed, request.seed + request.runs)
    every = _frames_every(request)
    recordings = folder / RECORDINGS if request.record else None
    if recordings is not None and system.watching is None:
        raise UserError(f"--record: {system.name} does not say how it is shown (System.watching)")
    function = function_of(request.system, parameters, every, configuration.sources, recordings)
    screen, trouble = Console(), Console(stderr=True)

    def wanted(seed: int) -> dict[str, dict[str, str]]:
        return {"events": {}, **({"frames": {EVERY: str(every[seed])}} if seed in every else {})}

    with Store(folder, configuration) as store:
        if len(store.rows_of(seeds)) < len(seeds):
            store.note(session(sys.argv, PACKAGE, LIBRARIES))
        with Progress(trouble, f"{system.name}", len(seeds)) as progress:
            try:
                report = run_set(
                    function,
                    seeds,
                    store,
                    workers=request.workers,
                    wanted=wanted,
                    progress=progress.runs,
                    watch=progress.inside,
                )
            except KeyboardInterrupt:
                done = len(store.rows_of(seeds))
                raise KeyboardInterrupt(
                    f"interrupted: {done} of {len(seeds)} runs are done and kept in {folder}. "
                    "The same command continues."
                ) from None
            for seed in seeds:
                if recordings and seed in store.rows and not recording_of(recordings, seed).exists():
                    progress.note(f"recording seed {seed}")
                    record_run(request.system, as_json(parameters), seed, recordings, progress.inside)
            pictures = draw_set(system, store, seeds, folder) if len(seeds) > 1 else []
            for seed in sorted({*every} & {*store.rows}):
                progress.note(f"drawing seed {seed}")
                stills = len(seeds) == 1
                pictures += draw_run(system, store, seed, folder, stills, _has_movie(request, seed), progress.inside)
        print_summary(screen, system, store, seeds, report, folder, pictures, targets=request.map is None)
        if request.map is not None and store.rows_of(seeds):
            print_missions(screen, store.rows_of(seeds))
        return _report_failures(report, folder)


def _check(request: Request) -> None:
    limits = {"runs": request.runs, "workers": request.workers}
    for name, value in limits.items():
        if value is not None and value < 1:
            raise UserError(f"--{name} {value}: must be at least 1")
    if request.runs > MOST_RUNS:
        raise UserError(
            f"--runs {request.runs}: at most {MOST_RUNS}; a larger set is several, each with its own --seed"
        )
    if not 0 <= request.seed < 2**63 - request.runs:
        raise UserError(f"--seed {request.seed}: must be a whole number from 0 to 2^63 - 1 (with all runs)")
    if request.frames is not None and not (math.isfinite(request.frames) and request.frames > 0):
        raise UserError(f"--frames {request.frames:g}: must be a time in seconds above 0")


def _has_movie(request: Request, seed: int) -> bool:
    return request.movie and (request.runs <= MOVIES or seed == request.seed)


def _frames_every(request: Request) -> dict[int, float]:
    """Return for every seed that is to be recorded the seconds between two frames."""
    alone = request.runs == 1
    seeds = range(request.seed, request.seed + request.runs)
    filmed = {seed: request.frames or FRAMES_OF_A_MOVIE for seed in seeds if _has_movie(request, seed)}
    if request.frames or alone:
        return {seed: request.frames or FRAMES_OF_ONE_RUN for seed in seeds} | filmed
    return filmed


def _report_failures(report: SetReport, folder: Path) -> int:
    for seed, failure in report.failures.items():
        print(f"\nformicarium: the run with seed {seed} failed:\n{failure.rstrip()}", file=sys.stderr)
    if report.failures:
        count = len(report.failures)
        print(
            f"\nformicarium: {count} run{'s' * (count > 1)} failed "
            f"(seed {', '.join(map(str, report.failures))}); "
            f"tracebacks in {folder / 'failures'}. The same command tries them again.",
            file=sys.stderr,
        )
    return 1 if report.failures else 0

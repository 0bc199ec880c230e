"""``formicarium run SYSTEM``: one run or a set of runs, with tables, pictures and a summary."""

from pathlib import Path
from typing import Annotated

from cyclopts import Parameter

from formicarium.commands.whole import Whole


def run(
    system: str,
    /,
    *,
    runs: Whole = 1,
    seed: Whole = 1,
    robots: Whole | None = None,
    setting: Whole | None = None,
    set_: Annotated[list[str] | None, Parameter(name="--set", negative="")] = None,
    map_: Annotated[str | None, Parameter(name="--map")] = None,
    out: str | None = None,
    workers: Whole | None = None,
    movie: Annotated[bool, Parameter(negative="")] = False,
    frames: float | None = None,
    record: Annotated[bool, Parameter(negative="")] = False,
) -> int:
    """Run a system once or many times, and keep tables and pictures of it.

    The same command run again loads what is there and produces what is
    missing: more --runs extend a set, an interrupted set continues. Results do
    not depend on --workers.

    Examples:

        formicarium run mark-i3
        formicarium run mark-i3 --seed 7 --movie
        formicarium run mark-i3 --runs 30 --setting 2 --out study
        formicarium run mark-i3 --robots 28 --set booth.task_time=4
        formicarium run coverage --map tasks.csv --robots 21 --set variant=safe

    Parameters
    ----------
    system
        Name of the system; list them with: formicarium systems
    runs
        How many runs; run k, counted from 0, uses seed + k.
    seed
        Seed of the first run.
    robots
        Number of robots, instead of that of the setting.
    setting
        A published setting of the system, by its number.
    set_
        Change a parameter: NAME=VALUE, as often as needed. List: formicarium describe SYSTEM
    map_
        Tasks in a file (.toml, .json, .csv), planned and then done by a swarm that can; with --robots, if the
        file lists no teams. The guide: docs/guides/mission.md
    out
        Folder of the results; a new folder of formicarium-results for each identity if not given.
    workers
        Processes that share the runs; one a core if not given.
    movie
        Make a movie of every run (of the first only if there are more than 10).
    frames
        Seconds between two records of all positions; 2 for a single run, 0.5 for a movie if not given.
    record
        Record every run: frames and events with a rolling hash, for formicarium replay, diff, movie and export.
    """
    from formicarium.commands.errors import UserError
    from formicarium.commands.session import Request, perform

    if out == "":
        raise UserError("--out is empty: name a folder, or leave --out away for one in formicarium-results")
    folder = None if out is None else Path(out)
    settings = tuple(set_ or ())
    return perform(Request(system, runs, seed, robots, setting, settings, folder, workers, movie, frames, record, map_))

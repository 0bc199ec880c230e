"""What ``movie`` and ``export`` do with a stored run."""

import math
from pathlib import Path

import numpy as np

from formicarium.campaigns.files import replacing
from formicarium.commands.errors import UserError
from formicarium.commands.extras import require
from formicarium.commands.replaying import CHANGED
from formicarium.commands.runs import Run, find_run
from formicarium.commands.work import RECORDED_EVERY
from formicarium.trial.record import Frames
from formicarium.views.recording.log import sliced
from formicarium.views.sentences import lines, teller

MOVIES = (".mp4", ".gif", ".webm")
STILLS = (".png", ".svg")


def make_movie(place: str, seed: int | None, out: Path | None, every: float | None, at: float | None) -> Path:
    """Make what the suffix of ``out`` says; return its path.

    Raises:
        UserError: if that makes no sense.
        StoreError: if the file cannot be written.
    """
    from formicarium.views.movie import suffix

    kind = suffix() if out is None else out.suffix.lower()
    if kind not in (*MOVIES, *STILLS, ".html"):
        raise UserError(f"--out {out}: the suffix must be one of {' '.join((*MOVIES, *STILLS, '.html'))}")
    if kind in (".mp4", ".webm"):
        require("movie", f"a movie as {kind}")
    if at is not None and kind not in STILLS:
        raise UserError("--at goes with a snapshot: give --out a name that ends in .png or .svg")
    for name, value in (("every", every), ("at", at)):
        if value is not None and not (math.isfinite(value) and value >= 0 and (value > 0 or name == "at")):
            raise UserError(f"--{name} {value:g}: must be a time in seconds")
    run = find_run(place, seed)
    frames = thinned(frames_of_run(run), every, run.scene.cycle_time)
    path = out or Path(f"movie-seed-{run.seed}{kind}")
    title = f"{run.system.name}\nseed {run.seed}"
    if kind in STILLS:
        return draw_still(run, frames, path, at, title)
    if kind == ".html":
        from formicarium.views.single_file import write_single_file

        events = lines(run.events, run.system.kinds, teller(run.system, run.system.kinds))
        return write_single_file(path, run.scene, frames, events, run.interventions, run.title)
    from rich.console import Console

    from formicarium.commands.progress import Progress
    from formicarium.views.movie import draw_movie

    with Progress(Console(stderr=True), f"movie of {run.title}", 1) as progress:
        return draw_movie(run.scene, frames, path, title, progress.inside, kind)


def draw_still(run: Run, frames: Frames, path: Path, at: float | None, title: str) -> Path:
    """Draw one frame."""
    from formicarium.views.frames import draw_frame

    index = len(frames.cycle) - 1
    if at is not None:
        index = int(np.abs(frames.cycle * run.scene.cycle_time - at).argmin())
    return draw_frame(run.scene, frames, path, index, title)


def frames_of_run(run: Run) -> Frames:
    """Return the frames of a run: those that were kept, or those of the trial simulated again.

    Raises:
        UserError: if there are none.
    """
    if run.frames is not None and len(run.frames.cycle):
        return run.frames
    if not run.same_sources:
        raise UserError(f"{run.path}: {CHANGED}, and no frames were kept")
    trial = run.system.run(run.parameters, run.seed, frames_every=RECORDED_EVERY)
    assert trial.frames is not None
    return trial.frames


def thinned(frames: Frames, every: float | None, cycle_time: float) -> Frames:
    """Return frames that are ``every`` seconds apart, or as near to that as they are."""
    if every is None or len(frames.cycle) < 2:
        return frames
    apart = float(frames.cycle[1] - frames.cycle[0]) * cycle_time
    return sliced(frames, slice(None, None, max(1, round(every / apart))))


def export_run(place: str, seed: int | None, to: str, folder: Path) -> list[Path]:
    """Write a run in an open format; return the paths.

    Raises:
        UserError: if an extra is missing.
        StoreError: if a file cannot be written.
    """
    if to == "mcap":
        require("mcap", "an export as mcap")
    run = find_run(place, seed)
    frames, tell = frames_of_run(run), teller(run.system, run.system.kinds)
    sentences = [tell(event) for event in run.events]
    if to == "mcap":
        from formicarium.views.mcap import write_mcap

        return [write_mcap(folder / f"seed-{run.seed}.mcap", run.scene, frames, run.events, sentences)]
    from formicarium.views.trajectories import event_table, trajectory_table

    tables = {
        "trajectories": trajectory_table(run.scene, frames),
        "events": event_table(run.scene, run.events, run.system.kinds, sentences),
    }
    return [write_table(table, folder / f"{name}-seed-{run.seed}.{to}") for name, table in tables.items()]


def write_table(table, path: Path) -> Path:
    """Write a table as CSV or Parquet, as the suffix says."""
    import pyarrow.csv as pa_csv
    import pyarrow.parquet as pq

    with replacing(path) as temporary:
        if path.suffix == ".csv":
            pa_csv.write_csv(table, temporary)
        else:
            pq.write_table(table, temporary, compression="zstd")
    return path

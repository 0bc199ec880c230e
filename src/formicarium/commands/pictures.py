"""Pictures of what a folder of results holds."""

from collections.abc import Callable, Sequence
from pathlib import Path

from formicarium.campaigns.store import Store
from formicarium.commands.summary import measured, published
from formicarium.commands.tables import trial_of
from formicarium.systems.registry import System

Progress = Callable[[int, int], None]
COUNTED = {  # what the curve of a timeline counts, if not sequences
    "partitioning": "objects stored",
    "coverage": "lengths reached",
}


def draw_set(system: System, store: Store, seeds: Sequence[int], folder: Path) -> list[Path]:
    """Draw the run-time distributions of the system's targets; nothing if no run is done."""
    from formicarium.views.runtimes import draw_run_times

    found = measured(system, store.rows_of(seeds))
    if not found:
        return []
    label = system.targets.published_label
    return [
        draw_run_times(
            found,
            published(system),
            folder / "runtimes.png",
            title=f"{system.name}: time to target",
            published_label=label,
        )
    ]


def draw_run(
    system: System, store: Store, seed: int, folder: Path, stills: bool, movie: bool, progress: Progress
) -> list[Path]:
    """Draw the last frame and the timeline of a run, or its movie, or both.

    A movie that is newer than the frames it shows is not made again.
    """
    from formicarium.views.frames import draw_frame
    from formicarium.views.movie import draw_movie, suffix
    from formicarium.views.timeline import draw_timeline

    trial = trial_of(store.rows[seed], store.table("events", seed), store.table("frames", seed), system.kinds)
    assert trial.frames is not None
    pictures = []
    if stills:
        end = folder / f"frame-end-seed-{seed}.png"
        lines = folder / f"timeline-seed-{seed}.png"
        pictures.append(draw_frame(trial.scene, trial.frames, end, title=f"{system.name}\nseed {seed}"))
        title = f"{system.name}, seed {seed}"
        pictures.append(
            draw_timeline(
                system.timeline(trial), trial.scene.roles, lines, title, COUNTED.get(system.name, "sequences done")
            )
        )
    if movie:
        path = folder / f"movie-seed-{seed}{suffix()}"
        if not path.exists() or path.stat().st_mtime < store.path("frames", seed).stat().st_mtime:
            draw_movie(trial.scene, trial.frames, path, f"{system.name}\nseed {seed}", progress)
        pictures.append(path)
    return pictures

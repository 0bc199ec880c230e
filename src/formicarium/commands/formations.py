"""The studies of what arms grow into beyond the paper: campaigns joined to tables and pictures (ST-74, ST-75)."""

from importlib import resources
from pathlib import Path

import numpy as np
from rich.console import Console

from formicarium.campaigns import table
from formicarium.campaigns.files import replacing
from formicarium.campaigns.ledger import Ledger
from formicarium.campaigns.tidy import tidy
from formicarium.commands.campaign.answers import write_csv
from formicarium.commands.campaign.sitting import Request, perform
from formicarium.commands.campaign.study import Overrides, Study, open_study
from formicarium.commands.errors import UserError
from formicarium.studies import formations
from formicarium.trial.record import Frames, Scene

TITLES = {"fractal": "Arms that branch", "network": "Networks of arms and tubes"}
COLUMNS = {"fractal": formations.FRACTAL, "network": formations.NETWORK}
DESIGNS = {
    "fractal": ("coverage-fractal", "coverage-fractal-deep"),
    "network": ("coverage-network", "coverage-network-failing"),
}
PICTURE_EVERY = 5.0  # s
MARGIN = 0.5  # m, round the robots of a picture
CORNERS = np.array([(-1, -1), (1, -1), (1, 1), (-1, 1)])
SHORTER: tuple[str, ...] = ()  # settings that tests add


def run_study(figure: str, folder: Path, runs: int | None, workers: int | None) -> int:
    """Run what the campaigns lack; return 0 if every run is done, 1 if some failed."""
    return max(perform(study, Request(workers=workers)) for study in _studies(figure, folder, runs, None))


def draw_study(figure: str, folder: Path, runs: int | None, sources: str | None) -> int:
    """Write a table of cells and a report a campaign, and a picture of its first run; return 0 if no run is missing.

    Raises:
        UserError: if no run is there.
        StoreError: if the folder cannot be read or written.
    """
    screen = Console()
    missing, there, written = 0, 0, []
    for study in _studies(figure, folder, runs, sources):
        rows = tidy(Ledger(study.folder).rows(), study.jobs).to_pylist()
        there += len(rows)
        missing += study.total - len(rows)
        if not rows:
            continue
        name = study.folder.name
        factors = list(dict.fromkeys(factor for job in study.jobs for factor in job.cell.factors))
        cells = formations.cells_of(rows, factors, COLUMNS[figure])
        write_csv(table.from_rows(cells), folder / f"{name}.csv")
        with replacing(folder / f"{name}.md") as temporary:
            temporary.write_text(formations.report(cells, factors, COLUMNS[figure], TITLES[figure]), encoding="utf-8")
        written += [folder / f"{name}.csv", folder / f"{name}.md", _draw_first(study, folder / f"{name}.png")]
    if not there:
        raise UserError(f"{folder}: no run of this study is there in {' or '.join(DESIGNS[figure])}. Run it first.")
    screen.print(f"[bold]{figure}[/bold]: drawn from {there} of {there + missing} runs", highlight=False)
    for path in written:
        screen.print(f"results   {path}", highlight=False, soft_wrap=True)
    return 0 if missing == 0 else 1


def _draw_first(study: Study, path: Path) -> Path:
    """Draw the last frame of a campaign's first run, which is flown again for that."""
    from formicarium.commands.known import find_system
    from formicarium.views.frames import draw_frame

    job = study.jobs[0]
    seed = job.cell.seeds[0]
    system = find_system(job.configuration.system)
    parameters = system.parameters.model_validate(job.configuration.parameters)
    trial = system.run(parameters, seed, frames_every=PICTURE_EVERY)
    assert trial.frames is not None
    return draw_frame(
        _widened(trial.scene, trial.frames), trial.frames, path, title=f"{study.folder.name}\nseed {seed}"
    )


def _widened(scene: Scene, frames: Frames) -> Scene:
    """Return a scene whose floor, its first polygon, reaches round all robots of the last frame."""
    floor, *others = scene.polygons
    points = np.vstack([floor.points, np.column_stack([frames.x[-1], frames.y[-1]])])
    (left, bottom), (right, top) = points.min(axis=0), points.max(axis=0)
    corners = np.array([(left, bottom), (right, bottom), (right, top), (left, top)]) + MARGIN * CORNERS
    return scene._replace(polygons=(floor._replace(points=corners), *others))


def _studies(figure: str, folder: Path, runs: int | None, sources: str | None) -> list[Study]:
    published = resources.files("formicarium.systems.coverage.published")
    found = []
    for name in DESIGNS[figure]:
        with resources.as_file(published / f"{name}.toml") as path:
            found.append(open_study(str(path), str(folder / name), Overrides(runs, SHORTER, sources)))
    return found

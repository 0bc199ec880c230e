"""Figures that are drawn from the implementation, without a study: 2, 3, 6, S15 and S17."""

import math
from pathlib import Path

import numpy as np

from formicarium.campaigns import table
from formicarium.campaigns.ledger import Ledger
from formicarium.commands.campaign.sitting import Request, perform
from formicarium.commands.campaign.study import Overrides, Study, study_of
from formicarium.commands.errors import UserError
from formicarium.commands.published import store
from formicarium.commands.tables import trial_of
from formicarium.studies import moments
from formicarium.studies.cells import NAMES, VARIANTS
from formicarium.studies.search import letter, sequences
from formicarium.systems.registry import resolve
from formicarium.systems.sequencing.setup import begin
from formicarium.systems.sequencing.study import scene_of
from formicarium.trial.record import Trial

DRAWN = ("2", "3", "6", "S15", "S17")
SNAPSHOT_SEEDS = {"mark-i3": 1, "mark-i4": 2, "mark-ii3": 3, "mark-ii4": 4}
MARK_I3_MOMENTS = (moments.START, moments.GUARDIANS, moments.BRANCH, moments.CHAIN, moments.SEQUENCE)
LETTERS = {"mark-i4": "G", "mark-ii3": "H", "mark-ii4": "I"}
ARENAS = {"A": ("mark-i3", "mark-ii3"), "B": ("mark-i4", "mark-ii4")}


def snapshot_studies(folder: Path) -> list[Study]:
    """Return one run of every variant, to its first sequence, with what happened and who was where."""
    studies = []
    for variant, seed in SNAPSHOT_SEEDS.items():
        name = f"{variant}-figure-2"
        limits = {"swarm.sequences": 1, "swarm.time_cap": 10_000.0}
        content = {"name": name, "system": variant, "replicates": 1, "first_seed": seed, "set": limits}
        content["keep"] = ["events", "frames"]
        studies.append(study_of(content, name, str(folder / name), Overrides(settings=store.MORE)))
    return studies


def run_snapshots(folder: Path, workers: int | None) -> int:
    """Run what Fig. 2 lacks; return 0 if every run is done."""
    return max(perform(study, Request(workers=workers)) for study in snapshot_studies(folder))


def snapshots_are_there(folder: Path) -> bool:
    """Tell whether the runs that Fig. 2 shows are done."""
    return all(store.tidy_rows(study) for study in snapshot_studies(folder))


def draw(figure: str, folder: Path) -> Path:
    """Draw one of these figures into a folder and return its path.

    Raises:
        UserError: if runs that it shows are not there.
        StoreError: if the file cannot be written.
    """
    path = folder / f"figure-{figure.lower()}.png"
    drawers = {"2": _snapshots, "3": _arenas, "6": _own_tree, "S15": _tree_of_three, "S17": _tree_of_four}
    return drawers[figure](path)


def _snapshots(path: Path) -> Path:
    from formicarium.views.snapshots import Snapshot, draw_snapshots

    trials = {study.system.name: _trial(study) for study in snapshot_studies(path.parent)}

    def shot(variant: str, moment: str, title: str) -> Snapshot:
        trial = trials[variant]
        assert trial.frames is not None
        cycles = moments.moments(trial, VARIANTS[variant].tasks)
        cycle = 200 if moment == moments.START else cycles.get(moment, int(trial.frames.cycle[-1]))
        return Snapshot(title, trial.scene, trial.frames, moments.frame_at(trial, cycle))

    first = [shot("mark-i3", moment, f"{'ABCDE'[k]}  {moment}") for k, moment in enumerate(MARK_I3_MOMENTS)]
    others = [shot(name, moments.CHAIN, f"{LETTERS[name]}  {NAMES[name]}: {moments.CHAIN}") for name in LETTERS]
    title = "Fig. 2: overhead snapshots, simulated. A to E: Mark I3"
    return draw_snapshots(title, [first, others], path)


def _trial(study: Study) -> Trial:
    ledger, rows = Ledger(study.folder), store.tidy_rows(study)
    if not rows:
        raise UserError(f"{study.folder}: the run that Fig. 2 shows is not there. Run it first.")
    events, frames = (table.read(ledger.table_path(name, study.jobs[0].keys[0])) for name in ("events", "frames"))
    return trial_of(rows[0], events, frames, study.system.kinds)


def _arenas(path: Path) -> Path:
    from formicarium.views.arenas import Ground, draw_arenas
    from formicarium.views.outlines import area

    rows = []
    for part, variants in ARENAS.items():
        row = []
        for setting in range(5):
            parameters = resolve(variants[0]).configure(setting=setting)
            state = begin(parameters, 1)  # type: ignore[arg-type]
            scene = scene_of(parameters, state)  # type: ignore[arg-type]
            corners = scene.polygons[0].points
            side = math.dist(corners[0], corners[1])
            title = f"{part}{setting}  side {side:.2f} m"
            robots = " or ".join(str(VARIANTS[name].robots[setting]) for name in variants)
            places = np.column_stack([state.world.bodies.x, state.world.bodies.y])
            row.append(Ground(title, f"{area(corners):.2f} m², {robots} robots", scene, places))
        rows.append(row)
    return draw_arenas(
        "Fig. 3: arenas of Marks I3 and II3 (A) and of Marks I4 and II4 (B), settings 0 to 4", rows, path
    )


def _own_tree(path: Path) -> Path:
    from formicarium.views.tree import draw_tree

    title = "Fig. 6: the search of Mark II3\nas the guardian of the green task sees it"
    return draw_tree(title, sequences(3), letter, path, own=2)


def _tree_of_three(path: Path) -> Path:
    from formicarium.views.tree import draw_tree

    return draw_tree("Fig. S15: search of Mark II3, depth first", sequences(3), letter, path)


def _tree_of_four(path: Path) -> Path:
    from formicarium.views.tree import draw_tree

    return draw_tree("Fig. S17: search of Mark II4, depth first", sequences(4), letter, path)

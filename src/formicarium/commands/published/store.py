"""The campaigns of the published study: which of their cells a figure needs, and what is there of them."""

from collections.abc import Callable, Iterable
from importlib import resources
from pathlib import Path
from typing import NamedTuple

from formicarium.campaigns.cells import Job
from formicarium.campaigns.ledger import Ledger
from formicarium.campaigns.tidy import tidy
from formicarium.commands.campaign.study import Overrides, Study, open_study
from formicarium.studies.cells import VARIANTS, Row, StudyCell

PROLONGED = "mark-i3-figure-4b"
TABLES = {variant: f"{variant}-table-1" for variant in VARIANTS}
MORE: tuple[str, ...] = ()  # "name=value" for all runs; tests make them short

Wanted = Callable[[StudyCell], bool]


class Asked(NamedTuple):
    """What a person asked for; see ``study`` for the meaning."""

    figure: str
    folder: Path
    runs: int | None = None
    workers: int | None = None
    sources: tuple[str, ...] = ()
    settings: tuple[int, ...] = ()  # all if empty
    tables: Path | None = None  # to read rows from, instead of the campaigns


class Part(NamedTuple):
    """A campaign as far as a figure needs it."""

    design: str
    wanted: Wanted = lambda cell: True


def is_default(cell: StudyCell) -> bool:
    """Tell whether a cell has the default number of robots."""
    return cell.level == 0


def is_base(cell: StudyCell) -> bool:
    """Tell whether it has so in the smallest arena."""
    return cell.level == 0 and cell.setting == 0


WHOLE = [Part(PROLONGED), *(Part(design) for design in TABLES.values())]
NEEDS: dict[str, list[Part]] = {
    "4": [Part(PROLONGED), *(Part(design, is_base) for design in list(TABLES.values())[1:])],
    "5": [Part(TABLES["mark-i3"]), Part(TABLES["mark-i4"])],
    "7": [Part(TABLES["mark-ii3"]), Part(TABLES["mark-ii4"])],
    "S18": [Part(TABLES["mark-i3"], is_default)],
    "S19": [Part(TABLES["mark-ii3"], is_base), Part(TABLES["mark-ii4"], is_base)],
    "all": WHOLE,
}  # the other figures are drawn from the implementation


def open_design(name: str, asked: Asked) -> Study:
    """Make a campaign of the study ready to run, or to be read with the sources that made most of its rows."""

    def opened(sources: str | None) -> Study:
        published = resources.files("formicarium.systems.sequencing.published")
        with resources.as_file(published / f"{name}.toml") as path:
            return open_study(str(path), str(asked.folder / name), Overrides(asked.runs, MORE, sources))

    options = [opened(sources) for sources in asked.sources or (None,)]
    return options[0] if len(options) == 1 else max(options, key=lambda study: len(tidy_rows(study)))


def tidy_rows(study: Study) -> list[dict]:
    """Return the rows of a campaign that are there."""
    return tidy(Ledger(study.folder).rows(), study.jobs).to_pylist()


def empty_cell(study: Study, job: Job) -> StudyCell:
    """Return a cell of a design without its runs."""
    parameters = job.configuration.parameters
    arena, swarm = parameters["arena"], parameters["swarm"]
    setting = job.cell.factors["setting"]
    return StudyCell(study.system.name, setting, arena["side"], swarm["robots"], swarm["time_cap"])


def cells_of(study: Study) -> list[StudyCell]:
    """Return the cells of a campaign, in the order of its design, with the runs that are there."""
    runs: dict[int, list[dict]] = {}
    for row in tidy_rows(study):
        runs.setdefault(row["cell"], []).append(row)
    return [empty_cell(study, job)._replace(runs=runs.get(job.cell.number, [])) for job in study.jobs]


def is_asked(cell: StudyCell, part: Part, asked: Asked) -> bool:
    """Tell whether a person wants a cell: the figure shows it, and its setting was not left out."""
    return part.wanted(cell) and (not asked.settings or cell.setting in asked.settings)


def needed(part: Part, asked: Asked) -> Study:
    """Return the campaign of a part with those of its cells alone that are asked for."""
    study = open_design(part.design, asked)
    return study._replace(jobs=[job for job in study.jobs if is_asked(empty_cell(study, job), part, asked)])


def cut(cells: Iterable[StudyCell]) -> list[StudyCell]:
    """Return prolonged cells as if they had ended at the paper's cap, but for the members, counted at their end."""
    found = []
    for cell in cells:
        cap = VARIANTS[cell.variant].time_caps[cell.setting]
        runs = [{**run, "duration_s": min(run["duration_s"] or cap, cap)} | _by(run, cap) for run in cell.runs]
        found.append(cell._replace(cap=cap, runs=runs))
    return found


def _by(run: Row, cap: float) -> dict:
    names = [name for name in run if name.startswith("time_") and run[name] is not None and run[name] >= cap]
    late = dict.fromkeys(names)
    return late | ({"success": 0, "cause": "done after the cap"} if "time_10_s" in late else {})

"""The study of whole missions: maps and conditions joined to a campaign, its table and its figure."""

import tomllib
from importlib import resources
from importlib.resources.abc import Traversable
from pathlib import Path
from typing import Any

from pydantic import BaseModel
from rich.console import Console

from formicarium.campaigns import table
from formicarium.campaigns.cells import Job, cells_of
from formicarium.campaigns.design import make_design
from formicarium.campaigns.ledger import Ledger
from formicarium.campaigns.tidy import tidy
from formicarium.commands.campaign.answers import write_csv
from formicarium.commands.campaign.earlier import made_by
from formicarium.commands.campaign.sitting import Request, perform
from formicarium.commands.campaign.study import Study
from formicarium.commands.errors import UserError
from formicarium.commands.extras import require
from formicarium.commands.fields import find_field, typed_value, with_values
from formicarium.commands.known import find_system
from formicarium.commands.mission import planned_parameters
from formicarium.commands.work import configuration_of, row_function
from formicarium.studies.missions import COLUMNS, figure_missions, mission_rows

SYSTEM, PATHS = "coverage", "mission.paths"
DESIGNS = {"missions": "coverage-missions", "mission-sizes": "coverage-mission-sizes"}


def run_study(figure: str, folder: Path, runs: int | None, workers: int | None) -> int:
    """Run what the campaign lacks; return 0 if every run is done, 1 if some failed."""
    return perform(open_missions(DESIGNS[figure], folder, runs), Request(workers=workers))


def draw_study(figure: str, folder: Path, runs: int | None, sources: str | None) -> int:
    """Write the table of all cells, the rows and the figure; return 0 if no run is missing, else 1.

    Raises:
        UserError: if no run is there.
    """
    from formicarium.views.charts import draw_chart

    name = DESIGNS[figure]
    study = open_missions(name, folder, runs, sources)
    found = tidy(Ledger(study.folder).rows(), study.jobs)
    rows = found.to_pylist()
    if not rows:
        raise UserError(f"{folder}: no run of missions is there. Run them first.")
    write_csv(found.select([column for column in COLUMNS if column in found.column_names]), folder / f"{name}-runs.csv")
    write_csv(table.from_rows(mission_rows(rows)), folder / f"{name}.csv")
    written = [folder / f"{name}-runs.csv", folder / f"{name}.csv"]
    written.append(draw_chart(figure_missions(rows), folder / f"figure-{figure}.png"))
    screen = Console()
    screen.print(f"[bold]missions[/bold]: drawn from {len(rows)} of {study.total} runs", highlight=False)
    for path in written:
        screen.print(f"results   {path}", highlight=False, soft_wrap=True)
    return 0 if len(rows) == study.total else 1


def open_missions(name: str, folder: Path, runs: int | None, sources: str | None = None) -> Study:
    """Plan the maps and make all cells ready to run; nothing is written."""
    require("scheduling", "formicarium study coverage, missions")
    published = resources.files("formicarium.systems.coverage.published")
    content = tomllib.loads((published / f"{name}.toml").read_text(encoding="utf-8"))
    maps, conditions, fixed = content.pop("maps"), content.pop("conditions"), content.pop("set")
    content |= {"system": SYSTEM, "factors": {"map": list(maps), "condition": list(conditions)}}
    content |= {"replicates": runs} if runs is not None else {}
    design = make_design(content, f"{name}.toml")
    system = find_system(SYSTEM)
    plans: dict[tuple[str, int], BaseModel] = {}
    jobs = []
    for cell in cells_of(design):
        place, settings = str(cell.factors["map"]), fixed | conditions[cell.factors["condition"]]
        plan = place, settings.get(PATHS, 1)
        if plan not in plans:
            plans[plan] = plan_of(published / "maps", maps[place], plan[1])
        typed = {}
        for field_name, value in settings.items():
            field = find_field(system.parameters, field_name, f"{name}.toml: {field_name}")
            typed[field.path] = typed_value(field, value, f"{name}.toml: {field_name}")
        parameters = with_values(plans[plan], typed)
        configuration = configuration_of(system, parameters)
        jobs.append(Job(cell, configuration, row_function(SYSTEM, parameters, configuration.sources)))
    own = folder / name
    jobs = jobs if sources is None else made_by(sources, jobs, Ledger(own))
    return Study(f"{name}.toml", design, system, jobs, own)


def plan_of(folder: Traversable, said: dict[str, Any], paths: int) -> BaseModel:
    """Return the parameters of missions of a map that is planned now, with so many paths to each task."""
    from formicarium.scheduling.reading import read_instance

    with resources.as_file(folder / said["file"]) as path:
        instance = read_instance(str(path), said.get("robots"))._replace(paths=paths)
    return planned_parameters(find_system(SYSTEM), instance, said["file"])

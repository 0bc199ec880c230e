"""A design joined to its system: cells that can be run, and the folder of their rows."""

import shlex
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any, NamedTuple

from pydantic import ValidationError

from formicarium.campaigns.cells import Cell, Job, cells_of, check_distinct
from formicarium.campaigns.design import Design, make_design
from formicarium.campaigns.design_file import read_content
from formicarium.campaigns.errors import DesignError
from formicarium.campaigns.ledger import Ledger
from formicarium.commands.campaign.earlier import made_by
from formicarium.commands.errors import UserError
from formicarium.commands.fields import find_field, in_words, parted, typed_value, value_of_text, with_values
from formicarium.commands.known import checked, find_system
from formicarium.commands.work import configuration_of, row_function
from formicarium.systems.registry import System

KEPT = ("events", "frames")  # tables that a design can keep
ARGUMENTS = ("setting", "robots")  # factors that the system's ``configure`` takes itself


class Overrides(NamedTuple):
    """What the command line says instead of the design."""

    runs: int | None = None  # of each cell
    settings: tuple[str, ...] = ()  # "name=value"
    sources: str | None = None  # hash of the sources that made the rows, instead of today's

    @property
    def words(self) -> list[str]:
        """What decides which runs are meant, as it is typed."""
        runs = ["--runs", str(self.runs)] if self.runs is not None else []
        return runs + [word for setting in self.settings for word in ("--set", setting)]


AS_DESIGNED = Overrides()


class Study(NamedTuple):
    """A campaign as a person asked for it."""

    source: str  # file of the design, for messages
    design: Design
    system: System
    jobs: list[Job]
    folder: Path
    options: str = ""  # of the command line that other verbs need too, to mean the same runs

    @property
    def total(self) -> int:
        """Runs of all cells."""
        return sum(len(job.cell.seeds) for job in self.jobs)

    @property
    def manifest(self) -> dict[str, Any]:
        """What the folder says about itself."""
        return {"name": self.design.name, "system": self.design.system, "design": self.design.content()}


def open_study(path: str, out: str | None, overrides: Overrides = AS_DESIGNED) -> Study:
    """Read a design and make its cells ready to run; nothing is written.

    Raises:
        DesignError: if the design itself is wrong.
        UserError: if the system does not know a factor or a value; the message names file, key and value.
    """
    return study_of(read_content(Path(path)), path, out, overrides)


def study_of(content: Mapping[str, Any], source: str, out: str | None, overrides: Overrides = AS_DESIGNED) -> Study:
    """Make the cells of a design given as plain values ready to run. Raises as ``open_study``."""
    design = make_design(content, source)
    system = _system(design, source)
    design = make_design(_overridden(design.content(), system, overrides), source)
    if unknown := [name for name in design.keep if name not in KEPT]:
        raise UserError(f"{source}: keep = {unknown[0]!r}: must be among {', '.join(KEPT)}")
    _check_names(design, system, source)
    try:
        jobs = [_job(cell, design, system, source) for cell in cells_of(design)]
        check_distinct(jobs)
    except DesignError as error:
        raise DesignError(f"{source}: {error}") from error
    if out == "":
        raise UserError("--out is empty: name a folder, or leave --out away for one in formicarium-results")
    folder = Path(out or f"formicarium-results/{design.name}")
    if overrides.sources is not None:
        jobs = made_by(overrides.sources, jobs, Ledger(folder))
    return Study(source, design, system, jobs, folder, _options(out, overrides))


def _job(cell: Cell, design: Design, system: System, source: str) -> Job:
    parameters = _parameters(cell, system, source)
    configuration = configuration_of(system, parameters)
    function = row_function(design.system, parameters, configuration.sources, tuple(design.keep))
    return Job(cell, configuration, function)


def _options(out: str | None, overrides: Overrides) -> str:
    words = ["--out", out] if out else []
    return "".join(f" {shlex.quote(word)}" for word in words + overrides.words)


def _system(design: Design, source: str) -> System:
    try:
        return find_system(design.system)
    except UserError as error:
        raise UserError(f"{source}: system = {design.system!r}: {error}") from error


def _overridden(content: dict[str, Any], system: System, overrides: Overrides) -> dict[str, Any]:
    if overrides.runs is not None:
        if overrides.runs < 1:
            raise UserError(f"--runs {overrides.runs}: must be at least 1")
        content["replicates"] = overrides.runs
    for setting in overrides.settings:
        name, text = parted(setting)
        value = _value_of(name, text, system)
        if name in content.get("factors", {}):
            content["factors"][name] = [value]
        elif name in (content.get("rows") or [{}])[0]:
            content["rows"] = [{**row, name: value} for row in content["rows"]]
        else:
            content.setdefault("set", {})[name] = value
    return content


def _value_of(name: str, text: str, system: System) -> Any:
    if name in ARGUMENTS:
        try:
            return int(text)
        except ValueError:
            raise UserError(f"--set {name}={text}: must be a whole number") from None
    value = value_of_text(find_field(system.parameters, name, f"--set {name}"), text)
    return list(value) if isinstance(value, tuple) else value


def _check_names(design: Design, system: System, source: str) -> None:
    places: list[tuple[str, Iterable[str]]] = [("set", design.fixed), ("factors", design.factors)]
    places += [("rows[0]", row) for row in design.rows[:1]]
    paths: dict[str, str] = {}
    for place, names in places:
        for name in names:
            if name == "first_seed" and place == "rows[0]":
                continue
            said = f"{source}: {place}.{name}"
            path = name if name in ARGUMENTS else find_field(system.parameters, name, said).path
            if paths.setdefault(path, name) != name:
                raise UserError(f"{said}: is the same parameter as {paths[path]!r}")


def _parameters(cell: Cell, system: System, source: str) -> Any:
    values = dict(cell.said)
    where = f"{source}: cell {cell.number} ({cell.label})" if cell.factors else source
    arguments = {name: values.pop(name, None) for name in ARGUMENTS}
    for name, value in arguments.items():
        if value is not None and (not isinstance(value, int) or isinstance(value, bool)):
            raise UserError(f"{where}: {name} = {value!r}: must be a whole number")
    try:
        parameters = system.configure(**arguments)
    except ValidationError as error:
        raise UserError(f"{where}: {in_words(error)}") from error
    except ValueError as error:
        raise UserError(f"{where}: {error}") from error
    typed = {}
    for name, value in values.items():
        field = find_field(system.parameters, name, f"{where}: {name}")
        typed[field.path] = typed_value(field, value, f"{where}: {name}")
    try:
        return checked(system, with_values(parameters, typed))
    except UserError as error:
        raise UserError(f"{where}: {error}") from error


def factor_names(jobs: Sequence[Job]) -> list[str]:
    """Return the names of all factors, in order."""
    return list(dict.fromkeys(name for job in jobs for name in job.cell.factors))

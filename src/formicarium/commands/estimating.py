"""What ``formicarium connectivity`` does: read graphs, tell exact values, run estimators, draw their errors."""

import math
from collections.abc import Sequence
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from pydantic import ValidationError
from rich.console import Console
from rich.table import Table

from formicarium.campaigns import table
from formicarium.commands.calls.graphs import MOST_NODES
from formicarium.commands.campaign.answers import write_csv
from formicarium.commands.errors import UserError
from formicarium.commands.fields import in_words, with_settings
from formicarium.commands.graphs_of_runs import Passage, passage_of
from formicarium.commands.progress import bars
from formicarium.connectivity.estimate import estimate
from formicarium.connectivity.exact import (
    algebraic_connectivity,
    components,
    diameter,
    is_connected,
    random_walk_connectivity,
    vertex_connectivity,
)
from formicarium.connectivity.files import Graph, GraphError, read_graphs
from formicarium.connectivity.parameters import EstimatorTable, LinksTable, estimator
from formicarium.connectivity.scores import ONE_PERCENT, TEN_PERCENT, Reached, error, reached
from formicarium.studies.curves import CurvePanel, CurveSheet, Line

SHOWN = 12  # graphs whose exact values are printed
SYSTEM = "formicarium.studies.estimators:ESTIMATORS"  # which describes their numbers


class Asked(NamedTuple):
    """What a person asked for; see ``connectivity`` for the meaning."""

    file: str
    reach: float | None
    kind: str | None
    graphs: int | None
    methods: Sequence[str]
    mode: str
    settings: Sequence[str]
    links: dict[str, Any]
    iterations: int
    runs: int | None
    first_seed: int
    seed: int | None
    at: float | None
    folder: Path


class Told(NamedTuple):
    """What one estimator said of all graphs."""

    which: EstimatorTable
    errors: np.ndarray  # (runs x graphs, T)
    last: float  # its median estimate at the end, mean over runs and graphs
    truth: float  # mean over graphs


def estimate_file(asked: Asked) -> int:
    """Do all of it; return the exit code.

    Raises:
        UserError: if file or options make no sense.
        StoreError: if the folder cannot be written.
    """
    from formicarium.views.curves import draw_curves

    whiches, links = _estimators(asked), _links(asked)
    graphs, passage = _graphs(asked)
    screen = Console()
    screen.print(_exact(graphs))
    written = []
    if passage is not None:
        screen.print(passage.words, highlight=False)
        written.append(draw_curves(passage.sheet, asked.folder / "lambda2.png"))
    whole = [graph.adjacency for graph in graphs if len(graph.adjacency) > 1 and is_connected(graph.adjacency)]
    if not whole:
        screen.print("No graph is connected: lambda2 is 0, and there is nothing for estimators to converge to.")
    else:
        if len(whole) < len(graphs):
            screen.print(f"{len(graphs) - len(whole)} graphs are not connected and not estimated.", highlight=False)
        told = _run(asked, whiches, links, whole)
        screen.print(_found(told, asked))
        if any(which.uses_global_memory for which in whiches):
            screen.print("* reads the memory of all nodes, which no robot can", highlight=False)
        written.append(draw_curves(_sheet(told, asked, links, len(whole)), asked.folder / "errors.png"))
        write_csv(table.from_rows(_rows(told)), asked.folder / "errors.csv")
        written.append(asked.folder / "errors.csv")
    for path in written:
        screen.print(f"results   {path}", highlight=False, soft_wrap=True)
    return 0


def _estimators(asked: Asked) -> list[EstimatorTable]:
    if asked.iterations < 1:
        raise UserError(f"--iterations {asked.iterations}: must be at least 1")
    if asked.runs is not None and asked.runs < 1:
        raise UserError(f"--runs {asked.runs}: must be at least 1")
    if not asked.methods:
        raise UserError("--method: name at least one of PI1, PI2, Wave")
    if asked.graphs is not None and asked.graphs < 1:
        raise UserError(f"--graphs {asked.graphs}: must be at least 1")
    if asked.reach is not None and not (math.isfinite(asked.reach) and asked.reach > 0):
        raise UserError(f"--range {asked.reach:g}: must be a distance in metres above 0")
    found = []
    for method in dict.fromkeys(asked.methods):
        try:
            changed = with_settings(estimator(method, asked.mode), asked.settings)
        except UserError as error:
            raise UserError(str(error).replace("describe SYSTEM", f"describe {SYSTEM}")) from error
        assert isinstance(changed, EstimatorTable)
        found.append(changed)
    return found


def _links(asked: Asked) -> LinksTable:
    try:
        return LinksTable.model_validate(asked.links)
    except ValidationError as error:
        raise UserError(f"--{in_words(error)}") from error


def _graphs(asked: Asked) -> tuple[list[Graph], Passage | None]:
    path = Path(asked.file)
    if path.is_dir() or path.suffix == ".recording":
        passage = passage_of(asked.file, asked.seed, asked.reach, asked.at)
        return [passage.graph], passage
    for name, value in (("seed", asked.seed), ("at", asked.at)):
        if value is not None:
            raise UserError(f"--{name}: only for a recorded run, {path} is none")
    try:
        graphs = read_graphs(path, asked.reach, asked.kind)
    except GraphError as error:
        more = "; give it with --range METRES" if "a range is needed" in str(error) else ""
        raise UserError(f"{error}{more}") from error
    return graphs[: asked.graphs], None


def _exact(graphs: Sequence[Graph]) -> Table:
    shown = Table(box=None, pad_edge=False, padding=(0, 2, 0, 0), title_justify="left")
    for title in ("graph", "nodes", "links", "components", "diameter", "lambda2", "mu2", "vertex connectivity"):
        shown.add_column(title, justify="right")
    for number, (matrix, _) in enumerate(graphs[:SHOWN]):
        parts = int(components(matrix).max()) + 1
        cut = str(vertex_connectivity(matrix)) if len(matrix) <= MOST_NODES else "not computed"
        values = (algebraic_connectivity(matrix), random_walk_connectivity(matrix))
        shown.add_row(
            str(number + 1), str(len(matrix)), str(int(matrix.sum()) // 2), str(parts),
            str(diameter(matrix)) if parts == 1 else "-", *(f"{value:.6g}" for value in values), cut,
        )  # fmt: skip
    if len(graphs) > SHOWN:
        shown.add_row(f"... {len(graphs) - SHOWN} more")
    return shown


def _run(asked: Asked, whiches: Sequence[EstimatorTable], links: LinksTable, graphs: list[np.ndarray]) -> list[Told]:
    runs = asked.runs or (5 if links.drop > 0 else 1)
    found = []
    with bars(Console(stderr=True)) as shown:
        task = shown.add_task("estimating", total=len(whiches) * runs * len(graphs), words="")
        for which in whiches:
            errors, lasts, truths = [], [], []
            for run in range(runs):
                for number, matrix in enumerate(graphs):
                    seed = asked.first_seed + run * len(graphs) + number
                    said = estimate(matrix, which, links, seed=seed, iterations=asked.iterations)
                    errors.append(error(matrix, said, which, "eigenvalue"))
                    finite = said.values[-1][np.isfinite(said.values[-1])]
                    lasts.append(float(np.median(finite)) if len(finite) else math.nan)
                    of_wave = which.method == "Wave"
                    truths.append((random_walk_connectivity if of_wave else algebraic_connectivity)(matrix))
                    shown.update(task, advance=1, words=which.method)
            found.append(Told(which, np.array(errors), float(np.mean(lasts)), float(np.mean(truths))))
    return found


def _found(told: Sequence[Told], asked: Asked) -> Table:
    shown = Table(box=None, pad_edge=False, padding=(0, 2, 0, 0))
    for title in ("estimator", "of", "exact", f"after {asked.iterations}", "error", "10 % from", "1 % from"):
        shown.add_column(title, justify="left" if title in ("estimator", "of") else "right")
    for which, errors, last, truth in told:
        mean = errors.mean(axis=0)
        steps = np.arange(1, len(mean) + 1)
        shown.add_row(
            which.method + ("*" if which.uses_global_memory else ""),
            "mu2" if which.method == "Wave" else "lambda2",
            f"{truth:.6g}",
            f"{last:.6g}",
            f"{100 * mean[-1]:.3g} %",
            *(in_iterations(reached(steps, mean, limit)) for limit in (TEN_PERCENT, ONE_PERCENT)),
        )
    return shown


def in_iterations(when: Reached) -> str:
    """Say from which iteration on an error stays small, or when it first was."""
    if when.stays is not None:
        return str(when.stays)
    return "never" if when.first is None else f"not for long ({when.first})"


def _sheet(told: Sequence[Told], asked: Asked, links: LinksTable, graphs: int) -> CurveSheet:
    lines = []
    for shade, (which, errors, _, _) in enumerate(told):
        mean = errors.mean(axis=0)
        band = (errors.min(axis=0), errors.max(axis=0)) if len(errors) > 1 else None
        lines.append(Line(which.method, np.arange(1, len(mean) + 1), mean, shade, band))
    runs = len(told[0].errors) // graphs
    count = f"{graphs} graph{'s' if graphs > 1 else ''}, {runs} run{'s' if runs > 1 else ''} of each"
    losses = f"; {100 * links.drop:g} % of the packets lost, {links.drops}" if links.drop else "; no packet lost"
    note = f"{count}; {asked.mode} mode{losses}; bands: least and greatest"
    up = "relative error of lambda2 (Wave: of mu2)"
    limits = ((TEN_PERCENT, "10 %"), (ONE_PERCENT, "1 %"))
    panel = CurvePanel("", "iterations", up, lines, limits=limits, span=(1e-4, 10.0))
    return CurveSheet(f"Estimates of connectivity: {Path(asked.file).name}", note, [[panel]])


def _rows(told: Sequence[Told]) -> list[dict[str, Any]]:
    rows = []
    for which, errors, _, _ in told:
        mean, least, most = errors.mean(axis=0), errors.min(axis=0), errors.max(axis=0)
        for k in range(len(mean)):
            rows.append({"estimator": which.method, "iteration": k + 1, "mean_error": float(mean[k]),
                         "least_error": float(least[k]), "greatest_error": float(most[k])})  # fmt: skip
    return rows

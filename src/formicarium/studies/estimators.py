"""Fig. 2 of Panerati et al. 2018 as something a campaign can repeat: one run is one estimator on several graphs."""

from collections.abc import Callable, Mapping
from typing import Literal

import numpy as np
from pydantic import BaseModel, ConfigDict, field_validator

from formicarium.connectivity.estimate import estimate
from formicarium.connectivity.exact import is_connected
from formicarium.connectivity.graphs import from_graph6, random_unit_disc
from formicarium.connectivity.parameters import AUTHOR, EstimatorTable, LinksTable
from formicarium.connectivity.scores import ONE_PERCENT, TEN_PERCENT, error, reached
from formicarium.systems.registry import System, Targets
from formicarium.tables import Table, number
from formicarium.trial.record import EVENT, Scene, Timeline, Trial

VARIANTS: dict[str, Mapping[str, object]] = {
    "as set": {},
    "author": AUTHOR,
    "author, own rows": {**AUTHOR, "rows": "own"},
    "honest": {},
    "honest, maximum": {"norm": "maximum"},
    "honest, long window": {"window": 200},
}
Variant = Literal["as set", "author", "author, own rows", "honest", "honest, maximum", "honest, long window"]
MOST_GRAPHS = 1000  # seeds of one run are a thousand apart


class GraphsTable(Table):
    """The graphs of a run."""

    nodes: int = number(10, "1", "K [paper]", ge=2, le=300)
    count: int = number(10, "1", "as many as the published curves are of [ST-3]", ge=1, le=MOST_GRAPHS)
    reach: float = number(0.5, "1", "of a link, in a square of side 1; degrees as in the published graphs [ST-2]", gt=0)
    first_seed: int = number(142001, "1", "graph k has seed first_seed + k", ge=0)
    given: str = number("", "", "graphs in graph6, parted by blanks, instead of random ones")

    @field_validator("given")
    @classmethod
    def _connected(cls, text: str) -> str:
        for place, word in enumerate(text.split()):
            matrix = from_graph6(word)
            if len(matrix) < 2 or not is_connected(matrix):
                raise ValueError(f"graph {place + 1} ({word}) is not connected: it has nothing to estimate")
        return text

    def matrices(self) -> list[np.ndarray]:
        """Return the adjacency matrices."""
        if self.given:
            return [from_graph6(word) for word in self.given.split()]
        return [random_unit_disc(self.nodes, self.reach, self.first_seed + k) for k in range(self.count)]


class LengthTable(Table):
    """How long a run is."""

    iterations: int = number(2001, "1", "of every graph [scripts, ST-15]", ge=1)
    every: int = number(10, "1", "iterations between two that are noted, from the first", ge=1)


class EstimatorParameters(BaseModel):
    """All numbers of a run."""

    model_config = ConfigDict(extra="forbid", frozen=True)

    variant: Variant = "as set"
    estimator: EstimatorTable = EstimatorTable()
    links: LinksTable = LinksTable()
    graphs: GraphsTable = GraphsTable()
    length: LengthTable = LengthTable()

    def which(self) -> EstimatorTable:
        """Return the estimator with what the variant changes."""
        return EstimatorTable.model_validate({**self.estimator.model_dump(), **VARIANTS[self.variant]})


def configure(setting: int | None = None, robots: int | None = None) -> EstimatorParameters:
    """Return the parameters; ``robots`` is the number of nodes.

    Raises:
        ValueError: if a setting is asked for: there are none.
    """
    if setting is not None:
        raise ValueError(f"setting {setting} does not exist: the estimators have none")
    return EstimatorParameters(graphs=GraphsTable(nodes=robots or 10))


def run(
    parameters: EstimatorParameters,
    seed: int,
    *,
    frames_every: float | None = None,
    watch: Callable[[float, float], None] | None = None,
) -> Trial:
    """Run an estimator on every graph and return a row: the error's mean and deviation over graphs, as it went on."""
    del frames_every  # nothing moves
    which, length = parameters.which(), parameters.length
    graphs = parameters.graphs.matrices()
    papers, errors = [], []
    for k, matrix in enumerate(graphs):
        own = seed * MOST_GRAPHS + k
        said = estimate(matrix, which, parameters.links, seed=own, iterations=length.iterations, every=length.every)
        papers.append(error(matrix, said, which, "paper"))
        errors.append(error(matrix, said, which, "eigenvalue"))
        if watch:
            watch(float(k + 1), float(len(graphs)))
    mean = np.mean(errors, axis=0)
    steps = 1 + length.every * np.arange(len(mean))
    ten, one = (reached(steps, mean, limit) for limit in (TEN_PERCENT, ONE_PERCENT))
    outcome = {
        "method": which.method,
        "nodes": len(graphs[0]),
        "graphs": len(graphs),
        "uses_global_memory": which.uses_global_memory,
        "error_at_end": float(mean[-1]),
        "error_last_third": float(mean[-max(1, len(mean) // 3) :].mean()),
        "ten_percent_first": ten.first,
        "ten_percent_stays": ten.stays,
        "one_percent_first": one.first,
        "one_percent_stays": one.stays,
        "errors": as_text(mean),
        "deviations": as_text(np.std(errors, axis=0, ddof=1 if len(graphs) > 1 else 0)),
        "paper_errors": as_text(np.mean(papers, axis=0)),
    }
    return Trial(outcome, np.zeros(0, EVENT), None, Scene((), 0.0, (), 1.0))


def as_text(values: np.ndarray) -> str:
    """Return numbers as one text, four digits each."""
    return " ".join(f"{value:.4g}" for value in values)


def from_text(text: str) -> np.ndarray:
    """Read what ``as_text`` wrote."""
    return np.array([float(word) for word in text.split()])


ESTIMATORS = System(
    name="estimators",
    summary="Distributed estimators of connectivity: PI1, PI2 and Wave (Panerati et al. 2018, Fig. 2)",
    parameters=EstimatorParameters,
    configure=configure,
    run=run,
    kinds=(),
    targets=Targets(columns={}, published={}, published_label="", published_cap=1.0),
    timeline=lambda _: Timeline((), (), (), (), 0.0),
)

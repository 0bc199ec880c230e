"""Could the robots of an eruption know how connected they are? The estimators on their own messages (ST-73)."""

from collections.abc import Callable, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
from pydantic import BaseModel, ConfigDict

from formicarium.connectivity.aboard import BYTES, estimate_aboard
from formicarium.connectivity.estimate import Estimates, estimate
from formicarium.connectivity.exact import algebraic_connectivity, random_walk_connectivity
from formicarium.connectivity.parameters import EstimatorTable, estimator
from formicarium.connectivity.scores import ONE_PERCENT, TEN_PERCENT, reached, relative_error
from formicarium.studies.curves import CurvePanel, CurveSheet, Line
from formicarium.studies.estimators import as_text, from_text
from formicarium.systems.coverage.loop import run
from formicarium.systems.coverage.parameters import CoverageParameters, coverage_parameters
from formicarium.systems.coverage.setup import begin
from formicarium.systems.registry import System, Targets
from formicarium.tables import Table, number
from formicarium.trial.record import EVENT, Scene, Timeline, Trial

HALF = 0.5  # relative error of an estimate that still tells well from badly connected
LONGEST_LAG = 120.0  # s, that is looked for


class Aboard(NamedTuple):
    """An estimator, and how long it is given on a graph that stands still."""

    estimator: EstimatorTable
    frozen_iterations: int
    title: str


# The quickest of the honest ones (docs/results/connectivity.md), and for long arms such as can see a small lambda2:
# PI1 settles on the eigenvalue nearest to alpha / (diffusions + 1), Wave tells apart what is 2 pi / window apart.
ESTIMATORS: Mapping[str, Aboard] = {
    "pi1": Aboard(estimator("PI1", norm="maximum"), 8001, "PI1"),
    "pi1_long": Aboard(estimator("PI1", norm="maximum", diffusions=1000), 40001, "PI1, 1,000 diffusions"),
    "pi2": Aboard(estimator("PI2"), 60001, "PI2"),
    "wave": Aboard(estimator("Wave"), 4001, "Wave"),
    "wave_long": Aboard(estimator("Wave", window=800), 4001, "Wave, window 800"),
}


class LookTable(Table):
    """How closely one looks."""

    every: int = number(5, "cycles", "between two values that are compared [choice]", ge=1)


class AboardParameters(BaseModel):
    """All numbers of a run: those of the swarm, and how closely one looks."""

    model_config = ConfigDict(extra="forbid", frozen=True)

    eruption: CoverageParameters = coverage_parameters(5)
    look: LookTable = LookTable()


class Voyage(NamedTuple):
    """What the messages of a swarm were, and what an onlooker saw."""

    received: np.ndarray  # (T, K, K) bool, row i of cycle t: from whom robot i heard in it
    sight: np.ndarray  # (S, K, K) bool, who could have heard whom, at every look


def sail(parameters: CoverageParameters, seed: int, every: int) -> Voyage:
    """Fly a trial and note every message that came through."""
    state = begin(parameters, seed)
    cycles, size = int(state.clock[0].last_cycle), len(state.robots)
    received = np.zeros((cycles, size, size), bool)
    sight = []
    for cycle in range(cycles):
        if cycle > 0 and (cycle - 1) % every == 0:  # in the first cycle nobody has spoken yet
            sight.append(state.sight.astype(bool))
        run(state, 1)
        state.clock[0].event_count = 0
        received[cycle] = state.heard == cycle
    return Voyage(received, np.array(sight))


def lag_of(said: np.ndarray, truth: np.ndarray, longest: int) -> tuple[int, float]:
    """Return by how many looks what is said trails behind the truth, and the median relative error at that lag.

    The lag is the shift, 0 to ``longest``, at which the median over time of |said(t) - truth(t - lag)| / truth(t - lag)
    is least.

    Args:
        said: (S,) what the median node says.
        truth: (S,).
        longest: looks.
    """
    off = []
    for lag in range(min(longest, len(truth) - 1) + 1):
        before = truth[: len(truth) - lag]
        with np.errstate(invalid="ignore", divide="ignore"):
            error = np.abs(said[lag:] - before) / before
        off.append(float(np.median(np.where(np.isfinite(error), error, np.inf))))
    best = int(np.argmin(off))
    return best, off[best]


def median_node(values: np.ndarray) -> np.ndarray:
    """Return what the median node says (S,), of those (S, K) that say anything finite; infinity if none does."""
    finite = np.where(np.isfinite(values), values, np.nan)
    said = np.full(len(values), np.inf)
    some = np.isfinite(values).any(axis=1)
    said[some] = np.nanmedian(finite[some], axis=1)
    return said


def frozen(graph: np.ndarray, which: Aboard, seed: int, cycle_time: float) -> tuple[float | None, float]:
    """Return after how long an estimator stays within 10 % if the graph stood still and no message was lost (s).

    And the error of the median node at the end.
    """
    found = estimate(graph, which.estimator, seed=seed, iterations=which.frozen_iterations, every=10)
    errors = relative_error(found.values, truth_of(graph, which.estimator))
    stays = reached(found.iterations, errors, TEN_PERCENT).stays
    return None if stays is None else stays * cycle_time, float(errors[-1])


def truth_of(graph: np.ndarray, which: EstimatorTable) -> float:
    """Return what an estimator ought to say: lambda2, for Wave mu2."""
    return random_walk_connectivity(graph) if which.method == "Wave" else algebraic_connectivity(graph)


def judge(said: Estimates, truth: np.ndarray, step: float) -> dict[str, float]:
    """Return how good estimates were: errors of the median node while the swarm moved, and how late they came.

    Args:
        said: at every look.
        truth: (S,).
        step: s, between two looks.
    """
    errors = np.array([relative_error(values, right) for values, right in zip(said.values, truth, strict=True)])
    lag, rest = lag_of(median_node(said.values), truth, round(LONGEST_LAG / step))
    return {
        "error": float(np.median(errors)),
        "error_last_third": float(np.median(errors[-max(1, len(errors) // 3) :])),
        "within_half": float((errors <= HALF).mean()),
        "within_tenth": float((errors <= TEN_PERCENT).mean()),
        "within_hundredth": float((errors <= ONE_PERCENT).mean()),
        "lag_s": lag * step,
        "error_at_lag": rest,
    }


def fly(
    parameters: AboardParameters,
    seed: int,
    *,
    frames_every: float | None = None,
    watch: Callable[[float, float], None] | None = None,
) -> Trial:
    """Fly an eruption, give its messages to the three estimators, and return a row."""
    del frames_every, watch
    swarm, every = parameters.eruption, parameters.look.every
    voyage = sail(swarm, seed, every)
    step = every * swarm.swarm.cycle_time
    row: dict[str, Any] = {
        "robots": swarm.swarm.robots,
        "duration_s": len(voyage.received) * swarm.swarm.cycle_time,
        "step_s": step,
        "bytes_more": BYTES,
        "delivered_share": delivered_share(voyage, every),
    }
    for name, which in ESTIMATORS.items():
        truth = np.array([truth_of(graph, which.estimator) for graph in voyage.sight])
        said = estimate_aboard(voyage.received[1:], which.estimator, seed=seed, every=every)
        row |= {f"{name}_{key}": value for key, value in judge(said, truth, step).items()}
        row[f"{name}_frozen_s"], row[f"{name}_frozen_error"] = frozen(
            voyage.sight[-1], which, seed, swarm.swarm.cycle_time
        )
        row[f"{name}_said"] = as_text(median_node(said.values))
        row[f"{name}_truth"] = as_text(truth)
    return Trial(row, np.zeros(0, EVENT), None, Scene((), 0.0, (), swarm.swarm.cycle_time))


def delivered_share(voyage: Voyage, every: int) -> float:
    """Return which share of the messages between robots in sight of each other came through."""
    return float(voyage.received[1::every][voyage.sight].mean())


ABOARD = System(
    name="estimators-aboard",
    summary="Estimators of connectivity on the messages of an eruption (Panerati et al. 2018; ST-73)",
    parameters=AboardParameters,
    configure=lambda setting=None, robots=None: AboardParameters(eruption=coverage_parameters(setting or 5, robots)),
    run=fly,
    kinds=(),
    targets=Targets(columns={}, published={}, published_label="", published_cap=1.0),
    timeline=lambda _: Timeline((), (), (), (), 0.0),
)


Row = Mapping[str, Any]
LOSS = "eruption.footbot.radio_loss"
COLUMNS = {
    "error": "median error over the run",
    "error_last_third": "in the last third, robots hardly moving",
    "within_half": "share of time within 50 %",
    "within_tenth": "within 10 %",
    "within_hundredth": "within 1 %",
    "lag_s": "lag (s)",
    "error_at_lag": "error at that lag",
    "frozen_s": "the graph frozen, nothing lost: within 10 % after (s)",
    "frozen_error": "and the error in the end",
}
LOWEST, HIGHEST = 1e-3, 30.0  # of the figure's axis


def cells_of(rows: Sequence[Row]) -> list[dict[str, Any]]:
    """Return a row for each estimator and share of lost messages: medians over runs; what no run has counts as inf."""
    cells = []
    for loss in dict.fromkeys(row[LOSS] for row in rows):
        own = [row for row in rows if row[LOSS] == loss]
        for key, which in ESTIMATORS.items():
            numbers: dict[str, Any] = {"estimator": which.title, "lost": loss, "runs": len(own)}
            for name in COLUMNS:
                values = [row[f"{key}_{name}"] for row in own]
                numbers[name] = float(np.median([np.inf if value is None else value for value in values]))
            cells.append(numbers)
    return cells


def report(cells: Sequence[Mapping[str, Any]]) -> str:
    """Return the table of cells in Markdown."""
    lines = ["# Estimators on the messages of an eruption", "", "Medians over runs; the median robot. -: never.", ""]
    lines.append("| | " + " | ".join(f"{c['estimator']}, {100 * c['lost']:g} % lost" for c in cells) + " |")
    lines.append("|---" * (len(cells) + 1) + "|")
    for name, words in COLUMNS.items():
        values = (f"{cell[name]:.3g}" if np.isfinite(cell[name]) else "-" for cell in cells)
        lines.append(f"| {words} | " + " | ".join(values) + " |")
    return "\n".join(lines) + "\n"


def figure_of(rows: Sequence[Row]) -> CurveSheet:
    """What the robots said and what was true, in the first run of each share of lost messages."""
    panels = []
    for loss in dict.fromkeys(row[LOSS] for row in rows):
        row = next(row for row in rows if row[LOSS] == loss)
        across = []
        for key, which in ESTIMATORS.items():
            truth, said = (from_text(row[f"{key}_{name}"]) for name in ("truth", "said"))
            times = float(row["step_s"]) * np.arange(1, len(truth) + 1)
            what = "mu2" if which.estimator.method == "Wave" else "lambda2"
            lines = [Line("exact", times, truth, 0), Line("the median robot says", times, np.abs(said), 1)]
            title = f"{which.title}, {100 * loss:g} % lost"
            across.append(CurvePanel(title, "time (s)", what, lines, span=(LOWEST, HIGHEST)))
        panels.append(across)
    note = f"{rows[0]['robots']} robots, three arms, one iteration a cycle; seed {rows[0]['seed']}"
    return CurveSheet("Estimates of connectivity during an eruption", note, panels)

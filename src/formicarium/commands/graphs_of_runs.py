"""The graph of a recorded swarm at every frame: who was within range of whom."""

from typing import NamedTuple

import numpy as np

from formicarium.commands.errors import UserError
from formicarium.commands.runs import find_run
from formicarium.connectivity.exact import algebraic_connectivity, is_connected
from formicarium.connectivity.files import Graph
from formicarium.connectivity.graphs import unit_disc
from formicarium.studies.curves import CurvePanel, CurveSheet, Line
from formicarium.views.style import clock


class Passage(NamedTuple):
    """How connected a recorded swarm was, and its graph at one moment."""

    graph: Graph
    words: str
    sheet: CurveSheet


def passage_of(place: str, seed: int | None, reach: float | None, at: float | None) -> Passage:
    """Return the connectivity of a recorded run.

    Args:
        place: a recording, or a folder of results.
        seed: of the run, if the folder holds several.
        reach: range of a link, metres.
        at: seconds; the frame before it gives the graph. The last frame if None.

    Raises:
        UserError: if something is missing or out of bounds.
        StoreError: if a file is damaged.
    """
    if reach is None:
        raise UserError(f"{place}: robots are linked within a range: give it with --range METRES")
    run = find_run(place, seed)
    if run.frames is None or not len(run.frames.cycle):
        raise UserError(f"{place}: no frames were kept of this run. Record one with: formicarium run --record")
    frames, times = run.frames, run.frames.cycle * run.scene.cycle_time
    if at is not None and not times[0] <= at <= times[-1]:
        raise UserError(f"--at {at:g}: the run has frames from {times[0]:g} to {times[-1]:g} s")
    chosen = len(times) - 1 if at is None else int(np.searchsorted(times, at, side="right")) - 1
    places = np.stack([frames.x, frames.y], axis=-1).astype(float)
    graphs = [unit_disc(points, reach) for points in places]
    whole = np.array([is_connected(graph) for graph in graphs])
    values = np.array([algebraic_connectivity(graph) for graph in graphs])
    parted = np.flatnonzero(~whole)
    words = f"connected in {whole.sum()} of {len(whole)} frames"
    if len(parted):
        words += f"; first parted at {clock(times[parted[0]])}, longest for {_longest(whole, times):g} s"
    words += f"; lambda2 {values.min():.3g} to {values.max():.3g}, median {np.median(values):.3g}"
    words += f"; the estimators get the graph at {clock(times[chosen])}"
    line = Line("", times, values)
    panel = CurvePanel("", "time (s)", f"lambda2, range {reach:g} m", [line], logarithmic=False)
    labels = tuple(str(identity) for identity in frames.identity)
    note = f"{len(frames.identity)} robots; 0: the swarm is in parts"
    return Passage(Graph(graphs[chosen], labels), words, CurveSheet(f"Connectivity: {run.title}", note, [[panel]]))


def _longest(whole: np.ndarray, times: np.ndarray) -> float:
    """Return the longest time in parts, seconds."""
    longest, start = 0.0, None
    for connected, time in zip([*whole, True], [*times, times[-1]], strict=True):
        if not connected and start is None:
            start = time
        elif connected and start is not None:
            longest, start = max(longest, float(time - start)), None
    return longest

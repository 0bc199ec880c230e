"""``formicarium connectivity FILE``: how connected a graph is, exactly and as its own nodes would find out."""

from typing import Annotated, Literal

from cyclopts import Parameter

from formicarium.commands.whole import Whole


def connectivity(
    file: str,
    /,
    *,
    reach: Annotated[float | None, Parameter(name="--range")] = None,
    kind: Annotated[Literal["matrix", "edges", "positions", "graph6"] | None, Parameter(name="--as")] = None,
    graphs: Whole | None = None,
    method: Annotated[tuple[Literal["PI1", "PI2", "Wave"], ...], Parameter(negative="")] = ("PI1", "PI2", "Wave"),
    mode: Literal["honest", "author"] = "honest",
    set_: Annotated[tuple[str, ...], Parameter(name="--set", negative="")] = (),
    drop: float = 0.0,
    drops: Literal["directed", "symmetric", "hold-last"] = "directed",
    iterations: Whole = 2001,
    runs: Whole | None = None,
    first_seed: Whole = 1,
    seed: Whole | None = None,
    at: float | None = None,
    out: str | None = None,
) -> int:
    """Say how connected a graph is, and what three distributed estimators make of it after how many iterations.

    Exact: lambda2 (second eigenvalue of the Laplacian), mu2 (of the random-walk
    Laplacian), components, diameter, vertex connectivity. Estimators: PI1
    (Bertrand & Moonen), PI2 (Di Lorenzo & Barbarossa), Wave (Sahai et al.),
    whose nodes exchange one message an iteration and know nothing else.
    Leaves the curves of the errors as errors.png and errors.csv.

    FILE may be a matrix of 0 and 1 (text, CSV, Octave text, .npy; several
    matrices one after the other), an edge list (two names a line), graph6, with
    --range positions (x y a line), or a run of "formicarium run --record".

    Examples:

        formicarium connectivity swarm.csv
        formicarium connectivity edges.txt --method PI1 --set norm=maximum
        formicarium connectivity positions.csv --range 3 --drop 0.05 --drops symmetric
        formicarium connectivity formicarium-results/mark-i3-1a2b3c4d --seed 7 --range 0.5 --at 60

    Parameters
    ----------
    file
        The graph, or graphs.
    reach
        Metres: nodes or robots within this range are linked.
    kind
        What the file holds, if it is not told from its content.
    graphs
        Take only so many graphs of the file.
    method
        Estimators to run; all three if not given.
    mode
        honest: nodes know what they hear. author: as the published scripts, which read
        norm, mean and the end of a consensus from the memory of all nodes.
    set_
        Change a number of the estimators: NAME=VALUE, for example readout=bin or window=200.
    drop
        Probability that a packet is lost, 0 to 1.
    drops
        directed: each way by itself; symmetric: both ways together; hold-last: directed,
        and the last packet that came goes on counting.
    iterations
        Iterations to run.
    runs
        Repetitions with other seeds; 1 if not given, 5 with losses.
    first_seed
        Seed of the first repetition.
    seed
        Of a folder of recorded runs: the seed of the run.
    at
        Of a recorded run: the second whose graph the estimators get; its last one if not given.
    out
        Folder for errors.png and errors.csv; formicarium-results/connectivity-NAME if not given.
    """
    from pathlib import Path

    from formicarium.commands.estimating import Asked, estimate_file

    folder = Path(out) if out else Path("formicarium-results") / f"connectivity-{Path(file).stem or 'here'}"
    links = {"drop": drop, "drops": drops}
    return estimate_file(
        Asked(file, reach, kind, graphs, method, mode, set_, links, iterations, runs, first_seed, seed, at, folder)
    )

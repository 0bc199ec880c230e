"""``formicarium study NAME``: a published study again, from its runs to its figures."""

from pathlib import Path
from typing import Annotated, Literal

from cyclopts import Parameter

from formicarium.commands.whole import Whole

Switch = Annotated[bool, Parameter(negative="")]


def study(
    name: Literal["sequencing"],
    /,
    *,
    figure: Literal["4", "5", "S18", "all"] = "all",
    out: str = "formicarium-results",
    runs: Whole | None = None,
    workers: Whole | None = None,
    collect_only: Switch = False,
    sources: str | None = None,
) -> int:
    """Run a published study, or go on with it, and draw its figures beside the paper's numbers.

    The runs are two campaigns inside the folder, mark-i3-figure-4b and
    mark-i3-table-1; what is done is loaded. Beside them: the figures, cells.csv
    (a row a cell) and report.md (what the paper says, tested). Exit code 0 if
    every run of the study is there, 1 if not.

    Examples:

        formicarium study sequencing --figure 4 --runs 5
        formicarium study sequencing --out study
        formicarium study sequencing --out study --collect-only

    Parameters
    ----------
    name
        The study: sequencing (Garattoni & Birattari 2018, Mark I3).
    figure
        The paper's number of the figure; 5 is 5A.
    out
        Folder of the campaigns, figures, table and report.
    runs
        Runs of each cell, instead of the paper's 30.
    workers
        Processes that share the runs; one a core if not given.
    collect_only
        Run nothing: draw from what is there, also while it is being run.
    sources
        Take the rows that these sources made (a hash, as in the rows); runs nothing.
    """
    from formicarium.commands.published import draw_study, run_study

    code = 0
    if not collect_only and sources is None:
        code = run_study(figure, Path(out), runs, workers)
    return max(code, draw_study(figure, Path(out), runs, sources))

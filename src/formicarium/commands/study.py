"""``formicarium study NAME``: a published study again, from its runs to its figures."""

from pathlib import Path
from typing import Annotated, Literal

from cyclopts import Parameter

from formicarium.commands.whole import Whole

Switch = Annotated[bool, Parameter(negative="")]


def study(
    name: Literal["sequencing", "partitioning"],
    /,
    *,
    figure: Literal["4", "5", "S18", "7", "8", "9", "10", "11", "giving-up", "all"] = "all",
    out: str = "formicarium-results",
    runs: Whole | None = None,
    workers: Whole | None = None,
    collect_only: Switch = False,
    sources: str | None = None,
) -> int:
    """Run a published study, or go on with it, and draw its figures beside the paper's numbers.

    The runs are campaigns inside the folder (of sequencing: mark-i3-figure-4b
    and mark-i3-table-1); what is done is loaded. Beside them: the figures, tables
    of cells and report.md (what the paper says, tested). Exit code 0 if every run
    of the study is there, 1 if not.

    Examples:

        formicarium study sequencing --figure 4 --runs 5
        formicarium study sequencing --out study
        formicarium study sequencing --out study --collect-only
        formicarium study partitioning --figure 7 --runs 3

    Parameters
    ----------
    name
        The study: sequencing (Garattoni & Birattari 2018, Mark I3) or partitioning (Pini et al. 2011).
    figure
        The paper's number of the figure: 4, 5 (5A), S18 of sequencing; 7 to 11 and giving-up of partitioning.
    out
        Folder of the campaigns, figures, table and report.
    runs
        Runs of each cell, instead of the design's (30, or 50 and 20).
    workers
        Processes that share the runs; one a core if not given.
    collect_only
        Run nothing: draw from what is there, also while it is being run.
    sources
        Take the rows that these sources made (a hash, as in the rows); runs nothing.
    """
    from formicarium.commands import foraging, published
    from formicarium.commands.errors import UserError

    module = {"sequencing": published, "partitioning": foraging}[name]
    if figure not in module.DESIGNS:
        raise UserError(f"--figure {figure}: the study {name} has {', '.join(module.DESIGNS)}")
    code = 0
    if not collect_only and sources is None:
        code = module.run_study(figure, Path(out), runs, workers)
    return max(code, module.draw_study(figure, Path(out), runs, sources))

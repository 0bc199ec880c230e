"""``formicarium campaign compare A B``: do two campaigns differ, and by how much?"""

from typing import Annotated

from cyclopts import Parameter

Choice = Annotated[list[str] | None, Parameter(negative="")]


def compare(first: str, second: str, /, *, a: Choice = None, b: Choice = None, out: str | None = None) -> None:
    """Test the runs of two folders against each other, cell by cell and target by target.

    The folders are those of campaigns that were collected, or of
    "formicarium run". Cells are matched by the factors that both have. For
    each target: the share of runs that reached it (Fisher's exact test, risk
    difference and odds ratio) and the time to it with runs that did not reach
    it as censored (log-rank test, hazard ratio, ratio of medians). All
    intervals are 95 %; p-values in brackets are adjusted for the number of
    tests (Holm).

    For example:

        formicarium campaign compare old new
        formicarium campaign compare study study --a spacing=0.15 --b spacing=0.18

    Parameters
    ----------
    first
        Folder A.
    second
        Folder B.
    a
        Only runs of A with NAME=VALUE, as often as needed.
    b
        Only runs of B with NAME=VALUE, as often as needed.
    out
        Write the comparison to this CSV file too.
    """
    from pathlib import Path

    from formicarium.campaigns import table
    from formicarium.commands.campaign.answers import write_csv
    from formicarium.commands.campaign.comparison import comparisons, matched, runs_in, system_of
    from formicarium.commands.campaign.screen import print_comparisons, wide_console
    from formicarium.commands.errors import UserError

    if out is not None and not out.endswith(".csv"):
        raise UserError(f"--out {out}: name a .csv file")
    sets = [runs_in(Path(folder), tuple(chosen or ())) for folder, chosen in ((first, a), (second, b))]
    found = comparisons(system_of(*sets), matched(*sets))
    print_comparisons(wide_console(), found)
    if out is not None:
        write_csv(table.from_rows([row.flat() for row in found]), Path(out))

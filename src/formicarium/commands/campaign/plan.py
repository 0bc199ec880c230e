"""``formicarium campaign plan DESIGN``: what would be run."""

from formicarium.commands.campaign.options import Settings
from formicarium.commands.whole import Whole


def plan(design: str, /, *, out: str | None = None, runs: Whole | None = None, set_: Settings = None) -> None:
    """Show the cells of a design with their seeds, and what of them is done; run nothing.

    Examples:

        formicarium campaign plan study.toml
        formicarium campaign plan study.toml --runs 100 --set spacing=0.15

    Parameters
    ----------
    design
        File of the design: .toml, .yaml or .py
    out
        Folder of the campaign; formicarium-results/NAME if not given.
    runs
        Runs of each cell, instead of the design's replicates.
    set_
        Change a parameter in all cells: NAME=VALUE, as often as needed.
    """
    from formicarium.campaigns.ledger import Ledger
    from formicarium.commands.campaign.screen import wide_console
    from formicarium.commands.campaign.standing import cells_table, standing_of
    from formicarium.commands.campaign.study import Overrides, open_study

    study = open_study(design, out, Overrides(runs, tuple(set_ or ())))
    ledger = Ledger(study.folder)
    ledger.refresh()
    console = wide_console()
    total = sum(len(job.keys) for job in study.jobs)
    cells = len(study.jobs)
    console.print(
        f"[bold]{study.design.name}[/bold]: {cells} cell{'s' * (cells != 1)} x {study.design.count} "
        f"= {total} runs of {study.design.system}",
        highlight=False,
    )
    console.print(cells_table(study, standing_of(study, ledger), seeds=True))
    console.print(f"results   {study.folder}", highlight=False, soft_wrap=True)

"""``formicarium campaign plan DESIGN``: what would be run."""

from formicarium.commands.campaign.options import DesignFile, Out, Runs, Settings


def plan(design: DesignFile, /, *, out: Out = None, runs: Runs = None, set_: Settings = None) -> None:
    """Show the cells of a design with their seeds, and what of them is done; run nothing.

    For example:

        formicarium campaign plan study.toml
        formicarium campaign plan study.toml --runs 100 --set spacing=0.15
    """
    from formicarium.campaigns.ledger import Ledger
    from formicarium.commands.campaign.screen import wide_console
    from formicarium.commands.campaign.standing import cells_table, standing_of
    from formicarium.commands.campaign.study import Overrides, open_study

    study = open_study(design, out, Overrides(runs, tuple(set_ or ())))
    ledger = Ledger(study.folder)
    ledger.refresh()
    console = wide_console()
    cells = len(study.jobs)
    console.print(
        f"[bold]{study.design.name}[/bold]: {cells} cell{'s' * (cells != 1)} x {study.design.count} "
        f"= {study.total} runs of {study.design.system}",
        highlight=False,
    )
    console.print(cells_table(study, standing_of(study, ledger), seeds=True))
    console.print(f"results   {study.folder}", highlight=False, soft_wrap=True)

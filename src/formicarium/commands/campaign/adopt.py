"""``formicarium campaign adopt DESIGN FOLDER``: take over runs that are somewhere else."""

from formicarium.commands.campaign.options import DesignFile, Out, Runs, Settings


def adopt(design: DesignFile, folder: str, /, *, out: Out = None, runs: Runs = None, set_: Settings = None) -> None:
    """Take over the runs of the design that another folder holds, so that they need not be run again.

    The folder may be one of "formicarium run", or another campaign, for
    example from another machine. Nothing in it is changed.

    For example:

        formicarium campaign adopt study.toml formicarium-results/mark-i3-1a2b3c4d

    Parameters
    ----------
    folder
        Where the runs are.
    """
    from pathlib import Path

    from formicarium.campaigns.adoption import adopt as take_over
    from formicarium.campaigns.adoption import rows_in
    from formicarium.campaigns.ledger import Ledger
    from formicarium.campaigns.writer import Writer
    from formicarium.commands.campaign.screen import wide_console
    from formicarium.commands.campaign.study import Overrides, open_study

    study = open_study(design, out, Overrides(runs, tuple(set_ or ())))
    rows = rows_in(Path(folder))  # before a folder of our own is made
    with Writer(Ledger(study.folder), study.manifest, study.jobs) as writer:
        found = take_over(writer, study.jobs, Path(folder), rows, study.design.keep)
    text = f"{found.new} runs taken over, {found.known} were there, {found.other} are not in the design"
    wide_console().print(text, highlight=False)

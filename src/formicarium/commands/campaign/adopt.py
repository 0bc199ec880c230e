"""``formicarium campaign adopt DESIGN PLACE``: take over runs that are somewhere else."""

from formicarium.commands.campaign.options import DesignFile, Out, Runs, Settings


def adopt(design: DesignFile, place: str, /, *, out: Out = None, runs: Runs = None, set_: Settings = None) -> None:
    """Take over runs of the design that are somewhere else, so that they need not be run again.

    The place may be a folder of "formicarium run", another campaign, for example
    from another machine, or a file of "campaign pack". Nothing in it is changed.

    For example:

        formicarium campaign adopt study.toml formicarium-results/mark-i3-1a2b3c4d

    Parameters
    ----------
    place
        Folder or file where the runs are.
    """
    from pathlib import Path

    from formicarium.campaigns.adoption import adopt as take_over
    from formicarium.campaigns.adoption import rows_in
    from formicarium.campaigns.ledger import Ledger
    from formicarium.campaigns.writer import Writer
    from formicarium.commands.campaign.screen import wide_console
    from formicarium.commands.campaign.study import Overrides, open_study

    study = open_study(design, out, Overrides(runs, tuple(set_ or ())))
    rows = rows_in(Path(place))  # before a folder of our own is made
    with Writer(Ledger(study.folder), study.manifest, study.jobs) as writer:
        found = take_over(writer, study.jobs, Path(place), rows, study.design.keep)
    text = f"{found.new} runs taken over, {found.known} were there, {found.other} are not in the design"
    wide_console().print(text, highlight=False)

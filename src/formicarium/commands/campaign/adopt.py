"""``formicarium campaign adopt DESIGN PLACE``: take over runs that are somewhere else."""

from formicarium.commands.campaign.options import DesignFile, Out, Runs, Settings
from formicarium.commands.whole import Whole


def adopt(
    design: DesignFile, place: str, /, *, out: Out = None, runs: Runs = None, set_: Settings = None, repeat: Whole = 0
) -> None:
    """Take over runs of the design that are somewhere else, so that they need not be run again.

    The place may be a folder of "formicarium run", another campaign, for example
    from another machine, or a file of "campaign pack". Nothing in it is changed.
    Rows that other sources made belong to other runs, and stay where they are;
    with --repeat they are taken over too, as rows of today's sources, if so many
    of them come out the same in every column when they are run again. Where the
    design keeps tables ("keep"), runs without theirs are left, to be run again.

    Examples:

        formicarium campaign adopt study.toml formicarium-results/mark-i3-1a2b3c4d
        formicarium campaign adopt study.toml before-the-edit.parquet --repeat 8

    Parameters
    ----------
    place
        Folder or file where the runs are.
    repeat
        Runs of other sources to repeat, chosen by a hash of their seeds.
    """
    import sys
    from pathlib import Path

    from formicarium.campaigns.adoption import adopt as take_over
    from formicarium.campaigns.adoption import as_of_today, rows_in
    from formicarium.campaigns.cells import Job
    from formicarium.campaigns.ledger import Ledger
    from formicarium.campaigns.provenance import session
    from formicarium.campaigns.writer import Writer
    from formicarium.commands.campaign.screen import wide_console
    from formicarium.commands.campaign.study import Overrides, open_study
    from formicarium.commands.session import LIBRARIES
    from formicarium.sources import PACKAGE

    study = open_study(design, out, Overrides(runs, tuple(set_ or ())))
    rows = rows_in(Path(place))  # before a folder of our own is made
    screen = wide_console()

    def told(job: Job, seed: int) -> None:
        screen.print(f"repeating seed {seed} of {job.cell.label}", highlight=False)

    repeated = as_of_today(study.jobs, Path(place), rows, repeat, told) if repeat else None
    with Writer(Ledger(study.folder), study.manifest, study.jobs) as writer:
        found = take_over(writer, study.jobs, Path(place), rows, study.design.keep)
        text = f"{found.new} runs taken over, {found.known} were there, {found.other} are not in the design"
        if repeated is not None:
            writer.note_session({**session(sys.argv, PACKAGE, LIBRARIES), "repeated": repeated.seeds})
            more = take_over(writer, study.jobs, Path(place), repeated.rows, study.design.keep)
            text += f"; {more.new} of other sources taken over, {len(repeated.seeds)} of them repeated: the same"
            found = found._replace(bare=found.bare + more.bare)
        if found.bare:
            kept = " and ".join(study.design.keep)
            text += f"; {found.bare} are without the {kept} that the design keeps: run them again"
    screen.print(text, highlight=False)

"""``formicarium campaign clean DESIGN``: remove what a folder holds besides the design's runs."""

from formicarium.commands.campaign.options import DesignFile, Out, Runs, Settings, Switch


def clean(
    design: DesignFile,
    /,
    *,
    out: Out = None,
    runs: Runs = None,
    set_: Settings = None,
    yes: Switch = False,
) -> None:
    """Remove rows that other sources made, rows of cells that are not in the design, and what belongs to them.

    Says what would go; does it only with --yes. Files that were set aside as
    damaged go too. Rows of the design as it is today stay.

    For example:

        formicarium campaign clean study.toml
        formicarium campaign clean study.toml --yes

    Parameters
    ----------
    yes
        Do it.
    """
    from formicarium.campaigns.cleaning import clean_up, leftovers
    from formicarium.campaigns.ledger import Ledger
    from formicarium.campaigns.writer import Writer
    from formicarium.commands.campaign.screen import say, wide_console
    from formicarium.commands.campaign.standing import other_rows
    from formicarium.commands.campaign.study import Overrides, open_study
    from formicarium.commands.errors import UserError

    study = open_study(design, out, Overrides(runs, tuple(set_ or ())))
    ledger = Ledger(study.folder)
    if ledger.manifest is None:
        raise UserError(f"{study.folder} holds no campaign")
    ledger.refresh()
    console = wide_console()

    for reason, count in other_rows(study, ledger).items():
        say(console, f"{count} rows {reason}")
    found = leftovers(ledger, study.jobs)
    say(console, f"{found.rows} rows and {len(found.files)} files can go, {len(ledger.done) - found.rows} rows stay")
    if not yes:
        say(console, "nothing was removed; do it with --yes")
        return
    with Writer(ledger, study.manifest, study.jobs) as writer:
        clean_up(writer, study.jobs)
    say(console, "removed")

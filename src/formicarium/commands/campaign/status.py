"""``formicarium campaign status DESIGN``: how far it is."""

from formicarium.commands.campaign.options import Settings
from formicarium.commands.whole import Whole

SHOWN_FAILURES = 5


def status(
    design: str,
    /,
    *,
    out: str | None = None,
    runs: Whole | None = None,
    set_: Settings = None,
    sources: str | None = None,
) -> int:
    """Show how far a campaign is, what failed and why; works while it runs, from any terminal.

    Exit code 0 if every run of the design is done, 1 if not.

    Examples:

        formicarium campaign status study.toml

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
    sources
        Count rows that these sources made (a hash, as in the rows) instead of today's.
    """
    from formicarium.campaigns import claims
    from formicarium.campaigns.ledger import Ledger
    from formicarium.commands.campaign.screen import say, wide_console
    from formicarium.commands.campaign.standing import cells_table, other_rows, standing_of
    from formicarium.commands.campaign.study import Overrides, open_study

    study = open_study(design, out, Overrides(runs, tuple(set_ or ()), sources))
    ledger = Ledger(study.folder)
    ledger.refresh()
    console = wide_console()
    cells = standing_of(study, ledger)
    total = sum(len(job.keys) for job in study.jobs)
    done, failed = sum(cell.done for cell in cells), sum(cell.failed for cell in cells)
    working = claims.writers(study.folder / "writers")

    say(
        console,
        f"{study.design.name}: {done} of {total} runs done, {failed} failed, {total - done - failed} missing; "
        + (f"{working} at work on it now" if working else "nobody is at work on it"),
    )
    console.print(cells_table(study, cells))
    others = other_rows(study, ledger)
    for reason, count in others.items():
        say(console, f"besides   {count} rows {reason}: they do not count")
    if others:
        say(console, f"          remove them with: formicarium campaign clean {study.source}{study.options}")
    for name, reason in ledger.damaged.items():
        say(
            console,
            f"damaged   {study.folder / 'parts' / name} ({reason}): the next run sets it aside and repeats its runs",
        )
    failures = ledger.failures()
    shown = [(job, key) for job in study.jobs for key in job.keys if key in failures and key not in ledger.done]
    for job, key in shown[:SHOWN_FAILURES]:
        record = ledger.failure(key)
        last = str(record.get("failure", "")).strip().splitlines()[-1:] or [""]
        say(console, f"failed    cell {job.cell.number}, seed {key[1]}: {last[0]} (see {ledger.failure_path(key)})")
    if len(shown) > SHOWN_FAILURES:
        say(console, f"          and {len(shown) - SHOWN_FAILURES} more in {study.folder / 'failures'}")
    return 0 if done == total else 1

"""``formicarium campaign status DESIGN``: how far it is."""

from formicarium.commands.campaign.options import DesignFile, Out, Runs, Settings, Sources

SHOWN_FAILURES = 5


def status(
    design: DesignFile,
    /,
    *,
    out: Out = None,
    runs: Runs = None,
    set_: Settings = None,
    sources: Sources = None,
) -> int:
    """Show how far a campaign is, what failed and why; works while it runs, from any terminal.

    Exit code 0 if every run of the design is done, 1 if not.

    For example:

        formicarium campaign status study.toml
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
    done, failed = sum(cell.done for cell in cells), sum(cell.failed for cell in cells)
    working = claims.writers(study.folder / "writers")

    counts = f"{done} of {study.total} runs done, {failed} failed, {study.total - done - failed} missing"
    now = f"{working} at work on it now" if working else "nobody is at work on it"
    say(console, f"{study.design.name}: {counts}; {now}")
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
    return 0 if done == study.total else 1

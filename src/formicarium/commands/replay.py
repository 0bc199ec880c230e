"""``formicarium replay RUN``: a stored run on the page again, simulated and verified."""

from typing import Annotated

from cyclopts import Parameter

from formicarium.commands.whole import Whole


def replay(
    run: str,
    /,
    *,
    seed: Whole | None = None,
    check: Annotated[bool, Parameter(negative="")] = False,
    speed: float = 10.0,
    host: str = "127.0.0.1",
    port: Whole = 8000,
    browser: bool = True,
) -> int:
    """Show a stored run again: simulated from its configuration and seed, and held against its recording.

    If the sources that decide results have changed since, the command says so
    and plays the recorded frames. A robot moved or killed in the replay starts
    another course, which is not held against anything.

    Examples:

        formicarium replay formicarium-results/mark-i3-1a2b3c4d --seed 7
        formicarium replay seed-7.recording --check

    Parameters
    ----------
    run
        A recording, or a folder of results.
    seed
        Seed of the run, if the folder holds several.
    check
        Show nothing: simulate and verify, all recordings of the folder if no seed is given. Exit code 1 if one differs.
    speed
        Times real time; 0 for as fast as it goes.
    host
        Address to listen on.
    port
        Port of the page; 0 for any that is free.
    browser
        Open the page in the browser of this machine.
    """
    from formicarium.commands.replaying import check_runs, replay_run
    from formicarium.commands.showing import Page

    if check:
        return check_runs(run, seed)
    return replay_run(run, seed, Page(host, port, speed, True, browser))

"""What ``replay`` does: simulate a stored run again, hold it against its recording, or play what was recorded."""

import sys
from pathlib import Path
from typing import Any

from formicarium.campaigns.files import StoreError
from formicarium.commands.errors import UserError
from formicarium.commands.extras import require
from formicarium.commands.runs import Run, find_run, recordings_in
from formicarium.commands.showing import Page, show
from formicarium.commands.showing import check as check_page
from formicarium.views.live.checking import Checks
from formicarium.views.live.logged import LoggedFrames
from formicarium.views.live.session import Session
from formicarium.views.style import clock

CHANGED = "the sources that decide results have changed since this run was made"


def session_of(run: Run) -> Session:
    """Return the run as a trial that is to be simulated again."""
    return Session(run.system, run.parameters, run.seed, run.interventions, Checks(run.checks))


def logged(run: Run) -> LoggedFrames:
    """Return the run as it was recorded.

    Raises:
        UserError: if it was not.
    """
    if run.frames is None or not len(run.frames.cycle):
        raise UserError(f"{run.path}: {CHANGED}, and no frames were recorded. Run it again to watch it.")
    return LoggedFrames(run.scene, run.frames, run.events, run.interventions)


def replay_run(place: str, seed: int | None, page: Page) -> int:
    """Show a run on the page; return the exit code."""
    require("watch", "formicarium replay")
    check_page(page)
    run = find_run(place, seed)
    if not run.same_sources:
        print(f"formicarium: {CHANGED}: the recorded frames are played, not verified", file=sys.stderr)
        note = {"note": "recorded frames, not verified: the sources have changed"}
        return show(logged(run), run.system, f"{run.title}, replay", page, lambda: note)
    session = session_of(run)
    session.warm_up()
    return show(session, run.system, f"{run.title}, replay", page, lambda: {"note": verdict(run, session)})


def verdict(run: Run, session: Any) -> str:
    """Say in a few words how far the trial has been found to be the recorded one."""
    checks, cycle_time = session.checks, session.scene.cycle_time
    if checks.differs is not None:
        return f"differs from the recording at {clock(checks.differs * cycle_time)}"
    if checks.left is not None:
        return f"another course since {clock(checks.left * cycle_time)}"
    if session.ended and session.finished:
        return trouble(run, session) or "verified to the end"
    return f"verified up to {clock(checks.agreed * cycle_time)}" if run.checks else "not recorded: verified at the end"


def trouble(run: Run, session: Any) -> str:
    """Return in what a trial that was simulated again differs from the stored one, empty if in nothing."""
    checks, cycle_time = session.checks, session.scene.cycle_time
    if checks.differs is not None:
        return f"the state differs from the recording at {clock(checks.differs * cycle_time)} (cycle {checks.differs})"
    if run.checks and checks.agreed < checks.last:
        return f"the trial ends at cycle {session.frontier}, the recording goes on to {run.end}"
    events, stored = session.events, run.events
    if run.outcome is None:  # left or cut off: what came after the last frame may not be whole
        events, stored = (log[log["cycle"] < run.end] for log in (events, stored))
    if events.tobytes() != stored.tobytes():
        return "the events differ from the stored ones"
    if run.outcome is not None and dict(run.outcome) != dict(session.outcome()):
        return "the outcome differs from the stored one"
    return ""


def check_runs(place: str, seed: int | None) -> int:
    """Simulate runs again and verify them; return 0 if all agree with what was stored, otherwise 1."""
    path = Path(place)
    places = [place] if path.is_file() or seed is not None else [str(file) for file in recordings_in(path)] or [place]
    good = 0
    for each in places:
        try:
            found, text = check_run(find_run(each, seed))
        except StoreError as error:
            found, text = False, str(error)
        good += found
        print(f"{each}: {text}", flush=True)
    if len(places) > 1:
        print(f"{good} of {len(places)} verified")
    return 0 if good == len(places) else 1


def check_run(run: Run) -> tuple[bool, str]:
    """Simulate a run again; return whether it is what was stored, and a sentence."""
    if not run.same_sources:
        return False, f"not verified: {CHANGED}"
    session = session_of(run)
    session.advance(run.end if run.outcome is None else session.last_cycle)
    found = trouble(run, session)
    if found:
        return False, found
    digests = f"{session.checks.counted} digests" if session.checks and run.checks else "no digests"
    return True, f"verified: {session.frontier} cycles, {digests}, {len(run.events)} events"

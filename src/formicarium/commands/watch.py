"""``formicarium watch SYSTEM``: one trial on a live page."""

from pathlib import Path
from typing import Annotated

from cyclopts import Parameter

from formicarium.commands.whole import Whole


def watch(
    system: str,
    /,
    *,
    seed: Whole = 1,
    robots: Whole | None = None,
    setting: Whole | None = None,
    set_: Annotated[list[str] | None, Parameter(name="--set", negative="")] = None,
    map_: Annotated[str | None, Parameter(name="--map")] = None,
    speed: float = 1.0,
    paused: Annotated[bool, Parameter(negative="")] = False,
    out: str | None = None,
    host: str = "127.0.0.1",
    port: Whole = 8000,
    browser: bool = True,
) -> int:
    """Run a trial and show it on a page in the browser, where it can be paused, sought and touched.

    The page works over ssh (ssh -L 8000:localhost:8000 MACHINE) and on a
    phone. Looking changes nothing; what you do to robots and booths is kept
    in the recording, beside every frame and event. Ctrl-C ends it.

    Examples:

        formicarium watch mark-i3
        formicarium watch mark-i3 --seed 7 --speed 30
        formicarium watch mark-i3 --robots 28 --set booth.task_time=4 --paused
        formicarium watch coverage --map tasks.csv --robots 21 --speed 10

    Parameters
    ----------
    system
        Name of the system; list them with: formicarium systems
    seed
        Seed of the trial.
    robots
        Number of robots, instead of that of the setting.
    setting
        A published setting of the system, by its number.
    set_
        Change a parameter: NAME=VALUE, as often as needed. List: formicarium describe SYSTEM
    map_
        Tasks in a file, planned and then done by a swarm that can; as of: formicarium run --map
    speed
        Times real time; 0 for as fast as it goes.
    paused
        Wait at the first cycle.
    out
        Folder of the recording; that of the run in formicarium-results if not given.
    host
        Address to listen on. Whoever can reach it can watch and intervene.
    port
        Port of the page; 0 for any that is free.
    browser
        Open the page in the browser of this machine.
    """
    from formicarium.commands.showing import Page, watch_live

    page = Page(host, port, speed, not paused, browser)
    folder = None if out is None else Path(out)
    return watch_live(system, seed, robots, setting, tuple(set_ or ()), folder, page, map_)

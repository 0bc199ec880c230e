"""What ``watch`` and ``replay`` do alike: a session, a recording, a page."""

import math
import sys
import webbrowser
from collections.abc import Callable
from pathlib import Path
from typing import Any, NamedTuple

from formicarium.campaigns.configuration import Configuration
from formicarium.commands.errors import UserError
from formicarium.commands.extras import require
from formicarium.commands.folders import results_folder
from formicarium.commands.known import find_system
from formicarium.commands.mission import parameters_with_map
from formicarium.commands.work import RECORDED_EVERY, configuration_of
from formicarium.systems.registry import System


class Page(NamedTuple):
    """How a trial is to be shown."""

    host: str
    port: int
    speed: float
    playing: bool
    browser: bool


def head_of(name: str, configuration: Configuration, seed: int, system: System) -> dict[str, Any]:
    """Return what a recording says of its trial; ``name`` is how the registry finds the system."""
    return {**configuration.content(), "name": name, "seed": seed, "kinds": list(system.kinds)}


def unused(folder: Path, seed: int) -> Path:
    """Return a name for a recording that no file has."""
    path, number = folder / f"seed-{seed}.recording", 1
    while path.exists():
        number += 1
        path = folder / f"seed-{seed}-{number}.recording"
    return path


def watch_live(
    name: str,
    seed: int,
    robots: int | None,
    setting: int | None,
    settings: tuple[str, ...],
    out: Path | None,
    page: Page,
    map_file: str | None = None,
) -> int:
    """Run a trial on a live page and record it; return the exit code.

    Raises:
        UserError: if the request makes no sense.
        StoreError: if the recording cannot be written.
    """
    require("watch", "formicarium watch")
    from formicarium.views.live.session import Session, Unwatchable
    from formicarium.views.recording.recorder import Recorder

    if not 0 <= seed < 2**63:
        raise UserError(f"--seed {seed}: must be a whole number from 0 to 2^63 - 1")
    system = find_system(name)
    parameters = parameters_with_map(system, setting, robots, settings, map_file)
    check(page)
    configuration = configuration_of(system, parameters)
    print(f"{system.name}, seed {seed}: getting ready", file=sys.stderr)
    try:
        session = Session(system, parameters, seed)
    except Unwatchable as error:
        raise UserError(str(error)) from error
    folder = out or results_folder(system.name, configuration.identity) / "recordings"
    path = unused(folder, seed)
    every = max(1, round(RECORDED_EVERY / session.scene.cycle_time))
    session.warm_up()
    session.record(Recorder(path, head_of(name, configuration, seed, system), session.scene, session.state, every))
    code = show(session, system, f"{system.name}, seed {seed}", page, lambda: {"note": ""})
    print(f"recording {path}\nreplay it with: formicarium replay {path}")
    return code


def check(page: Page) -> None:
    """Check how a trial is to be shown.

    Raises:
        UserError: if it cannot be shown so.
    """
    if not (math.isfinite(page.speed) and 0 <= page.speed <= 1e6):
        raise UserError(f"--speed {page.speed:g}: must be 0 (as fast as it goes) or above")
    if not 0 <= page.port < 65536:
        raise UserError(f"--port {page.port}: must be 0 to 65535")


def show(session: Any, system: System, title: str, page: Page, describe: Callable[[], dict[str, Any]]) -> int:
    """Serve the page of a session until Ctrl-C; return the exit code.

    Raises:
        UserError: if the port cannot be listened on.
    """
    from formicarium.views.live.player import Player
    from formicarium.views.live.server import Audience, PortTaken, listening, serve
    from formicarium.views.live.wire import greeting

    try:
        listener = listening(page.host, page.port)
    except PortTaken as error:
        session.stop()
        raise UserError(str(error)) from error
    port = listener.getsockname()[1]
    shown = f"[{page.host}]" if ":" in page.host else page.host
    address = f"http://{'localhost' if page.host in ('127.0.0.1', '0.0.0.0', '::1', '::') else shown}:{port}/"
    player = Player(session, page.speed, page.playing, describe)
    assert system.watching is not None
    audience = Audience(player, greeting(session, title, system.kinds), system.watching.tell, system.kinds)

    def ready() -> None:
        print(f"watch it at {address}  (Ctrl-C ends it)", flush=True)
        if page.browser and sys.stdout.isatty():
            webbrowser.open(address)

    serve(audience, listener, page.host, title, ready)
    if player.failure is not None:
        raise player.failure
    return 0

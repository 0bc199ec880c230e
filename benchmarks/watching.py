"""What watching costs: recording, ten pages at once, drawing 216 robots; and the picture of the page in the README.

Every cost is a ratio of two times taken in turn in the same process, so that other work on the machine disturbs
both alike. Drawing is measured in a headless Chromium without a graphics card, as frames drawn in a second.

    python benchmarks/watching.py                      all of it
    python benchmarks/watching.py --picture page.png   only the picture
"""

import argparse
import statistics
import subprocess
import sys
import tempfile
import threading
import time
from pathlib import Path

import uvicorn
from playwright.sync_api import sync_playwright

from formicarium.systems.registry import resolve
from formicarium.views.live.player import Player
from formicarium.views.live.server import Audience, application, listening
from formicarium.views.live.session import Session
from formicarium.views.live.wire import Pause, Seek, Show, Speed, greeting
from formicarium.views.recording.recorded import record_trial

SYSTEM = resolve("mark-i3")
FLAGS = ["--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--disable-background-networking"]
REPEATS = 15
ROUNDS = 60
PAGES = 10


class Served:
    """A trial on a page, in this process."""

    def __init__(self, setting: int, robots: int | None, seed: int, speed: float, playing: bool = True):
        self.session = Session(SYSTEM, SYSTEM.configure(setting=setting, robots=robots), seed)
        self.session.warm_up()
        self.player = Player(self.session, speed, playing, lambda: {"note": ""})
        hello = greeting(self.session, f"mark-i3, seed {seed}", SYSTEM.kinds)
        audience = Audience(self.player, hello, SYSTEM.watching.tell, SYSTEM.kinds)
        listener = listening("127.0.0.1", 0)
        self.address = f"127.0.0.1:{listener.getsockname()[1]}"
        app = application(audience, "127.0.0.1", hello["title"])
        self.server = uvicorn.Server(uvicorn.Config(app, log_level="error", ws_per_message_deflate=False))
        self.thread = threading.Thread(target=self.server.run, kwargs={"sockets": [listener]}, daemon=True)
        self.thread.start()
        while not self.server.started:
            time.sleep(0.01)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.server.should_exit = True
        self.thread.join()


def recording() -> None:
    """Time trials with and without a recording, in turn."""
    parameters = SYSTEM.configure()
    ratios, sizes = [], []
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "a.recording"
        for seed in range(REPEATS + 1):
            start = time.process_time()
            SYSTEM.run(parameters, seed)
            middle = time.process_time()
            trial = record_trial(SYSTEM, parameters, seed, path, {}, 0.5)
            end = time.process_time()
            if seed:  # the first one loads the code
                ratios.append((end - middle) / (middle - start))
                sizes.append(path.stat().st_size / (trial.outcome["duration_s"] / 3600) / 1e6)
    print(f"recording, 20 robots, 2 frames/s: {spread(ratios)} times the run without; {spread(sizes)} MB an hour")


def spread(values: list[float]) -> str:
    return f"median {statistics.median(values):.3f} ({min(values):.3f} to {max(values):.3f})"


LOOKERS = """
import sys, threading
from websockets.sync.client import connect
stop, counts = threading.Event(), [0] * int(sys.argv[2])
def look(k):
    with connect(f"ws://{sys.argv[1]}/socket", compression=None) as page:
        page.send('{"do":"packets","on":true}')
        while not stop.is_set():
            try:
                page.recv(timeout=0.1)
                counts[k] += 1
            except TimeoutError:
                pass
threads = [threading.Thread(target=look, args=(k,)) for k in range(len(counts))]
for thread in threads:
    thread.start()
print("looking", flush=True)
sys.stdin.read()
stop.set()
for thread in threads:
    thread.join()
print(min(counts, default=0), flush=True)
"""


def audience(setting: int = 0, robots: int = 20, cycles: int = 15_000) -> None:
    """Time a trial as fast as it goes, with ten pages and with none, in turn; the pages are another process.

    The trials are short and many: the speed of a virtual machine drifts within seconds, by more than is looked for. The
    pages stay connected all the time, and in every other trial the player takes it that nobody is there.
    """
    ratios: dict[str, list[float]] = {"wall clock": [], "processor time of the trial's thread": []}
    with Served(setting, robots, 5, 0.0, playing=False) as served:
        words = [sys.executable, "-c", LOOKERS, served.address, str(PAGES)]
        lookers = subprocess.Popen(words, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
        assert lookers.stdout is not None
        lookers.stdout.readline()
        while len(served.player.packets) < PAGES:
            time.sleep(0.05)
        sprint(served, cycles)
        for turn in range(ROUNDS):
            taken = {}
            for looked in (True, False) if turn % 2 else (False, True):
                served.player.watched = looked
                taken[looked] = sprint(served, cycles)
            for k, found in enumerate(ratios.values()):
                found.append(taken[True][k] / taken[False][k])
        served.player.watched = True
        messages = int(lookers.communicate("")[0])
    for name, found in ratios.items():
        print(f"{PAGES} pages on {robots} robots, {name}: {spread(found)} times that of the trial alone")
    print(f"   messages to the slowest page in a trial: {messages / ROUNDS:.0f}")


def crowd() -> None:
    """The same with 216 robots."""
    audience(4, 216, 2500)


def sprint(served: Served, cycles: int) -> tuple[float, float]:
    """Return the seconds, of the wall clock and of its thread, that a trial takes to ``cycles`` from its beginning."""
    player, session = served.player, served.session
    player.ask(None, Seek(do="seek", cycle=0))
    while session.cycle != 0:
        time.sleep(0.01)
    time.sleep(0.1)
    session.snapshots.forget_after(0)  # or the trial would jump to where it has been
    clock = time.pthread_getcpuclockid(player.thread.ident)
    start, spent = time.perf_counter(), time.clock_gettime(clock)
    player.ask(None, Seek(do="seek", cycle=cycles))
    while session.cycle < cycles and not session.finished:
        time.sleep(0.005)
    return time.perf_counter() - start, time.clock_gettime(clock) - spent


def drawing() -> None:
    """Count the frames a browser draws in a second."""
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path="/usr/bin/chromium", args=FLAGS)
        for setting, robots, speed in ((4, 216, 1.0), (4, 216, 30.0), (0, 20, 30.0)):
            with Served(setting, robots, 5, speed) as served:
                page = browser.new_page(viewport={"width": 1280, "height": 800})
                page.goto(f"http://{served.address}/")
                time.sleep(4)
                gaps = page.evaluate(
                    """() => new Promise((done) => {
                        const times = [], first = performance.now(), drawn = () => watching.arena.drawn;
                        let seen = -1;
                        const count = (now) => {
                            if (drawn() !== seen) times.push(now);
                            seen = drawn();
                            if (now - first < 8000) requestAnimationFrame(count);
                            else done(times.slice(1).map((time, k) => time - times[k]));
                        };
                        requestAnimationFrame(count);
                    })"""
                )
                start = page.evaluate("watching.now.frame.cycle"), time.perf_counter()
                time.sleep(3)
                end = page.evaluate("watching.now.frame.cycle"), time.perf_counter()
                pace = (end[0] - start[0]) * 0.1 / (end[1] - start[1])
                late = sorted(gaps)[int(0.99 * len(gaps))]
                print(
                    f"drawing {robots} robots at {speed:g}x: {1000 / statistics.mean(gaps):.1f} frames/s, "
                    f"99 of 100 within {late:.0f} ms; {pace:.1f} times real time"
                )
                page.close()
        browser.close()


def picture(path: str) -> None:
    """Save the page as the README shows it."""
    with Served(0, None, 3, 30.0) as served, sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path="/usr/bin/chromium", args=FLAGS)
        page = browser.new_page(viewport={"width": 1120, "height": 700})
        page.goto(f"http://{served.address}/")
        served.player.ask(None, Seek(do="seek", cycle=1850))
        time.sleep(2)
        served.player.ask(None, Speed(do="speed", times=10.0))
        time.sleep(4)
        served.player.ask(None, Pause(do="pause"))
        served.player.ask(None, Show(do="packets", on=True))
        page.keyboard.press("m")
        time.sleep(0.5)
        column = page.evaluate("[...watching.now.frame.role].indexOf(3)")
        page.mouse.click(*page.evaluate(f"watching.arena.place({max(column, 2)})"))
        time.sleep(1)
        page.screenshot(path=path)
        browser.close()


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parts = {"recording": recording, "audience": audience, "crowd": crowd, "drawing": drawing}
    parser.add_argument("parts", nargs="*", default=list(parts))
    parser.add_argument("--picture")
    given = parser.parse_args()
    if given.picture:
        picture(given.picture)
    for part in given.parts if not given.picture else ():
        parts[part]()

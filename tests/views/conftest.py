"""A real browser and a real server: what the page shows is looked at where people look at it."""

import contextlib
import re
import shutil
import signal
import subprocess
import sys
import threading
import time

import pytest
from playwright.sync_api import sync_playwright

CHROMIUM = ("chromium", "chromium-browser", "google-chrome")
FLAGS = [
    "--no-sandbox",
    "--disable-gpu",
    "--disable-quic",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
]


@pytest.fixture(scope="session")
def browser():
    """Chromium without a screen. Without a browser these tests fail: what nobody has looked at is not tested."""
    found = next(filter(None, map(shutil.which, CHROMIUM)), None)
    assert found, "these tests need Chromium: apt-get install chromium (see README)"
    with sync_playwright() as playwright:
        running = playwright.chromium.launch(executable_path=found, args=FLAGS)
        yield running
        running.close()


def until(page, condition, patience=20.0):
    """Wait until a condition holds in the page. (Playwright's own waiting evaluates texts, which the page forbids.)"""
    end = time.monotonic() + patience
    while not page.evaluate(condition):
        assert time.monotonic() < end, f"still not: {condition}"
        time.sleep(0.02)


def placed(page, column):
    """Return where a robot is drawn, once the picture has come to rest."""
    before, place = None, page.evaluate(f"watching.arena.place({column})")
    while place != before:
        page.wait_for_timeout(200)
        before, place = place, page.evaluate(f"watching.arena.place({column})")
    return place


@contextlib.contextmanager
def command(*words, folder):
    """Run ``formicarium watch`` or ``replay`` and give the address of its page; end it with Ctrl-C."""
    line = [sys.executable, "-m", "formicarium.commands.main", *words, "--port", "0", "--no-browser"]
    process = subprocess.Popen(line, cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    rest = []
    try:
        first = process.stdout.readline()
        address = re.search(r"http://\S+", first)
        assert address, first + process.stderr.read()
        reader = threading.Thread(target=lambda: rest.append(process.stdout.read()), daemon=True)
        reader.start()
        yield address[0]
    finally:
        if process.poll() is None:
            process.send_signal(signal.SIGINT)
        assert process.wait(20) == 0, process.stderr.read()


@pytest.fixture
def serving():
    return command


@pytest.fixture
def opened(browser):
    """Open a page; at the end nothing may have gone wrong in it."""
    contexts, trouble = [], []

    def opening(address, width=1280, height=800, **options):
        context = browser.new_context(viewport={"width": width, "height": height}, **options)
        contexts.append(context)
        page = context.new_page()
        page.on("console", lambda said: trouble.append(said.text) if said.type in ("error", "warning") else None)
        page.on("pageerror", lambda error: trouble.append(str(error)))
        page.goto(address)
        until(page, "window.watching && watching.now.frame && watching.now.status.frontier >= 0")
        return page

    yield opening
    for context in contexts:
        context.close()
    assert trouble == []

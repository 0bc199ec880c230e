"""Ctrl-C: held back while something must not be torn, kept away from workers."""

import signal
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from multiprocessing import resource_tracker
from typing import Any


@contextmanager
def held_back() -> Iterator[None]:
    """Let the block finish before a Ctrl-C that comes meanwhile is raised as KeyboardInterrupt."""
    if threading.current_thread() is not threading.main_thread():
        yield  # signals are delivered to the main thread only
        return
    arrived: list[Any] = []
    previous = signal.signal(signal.SIGINT, lambda *_: arrived.append(True))
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, previous)
    if arrived:
        raise KeyboardInterrupt


@contextmanager
def hidden_from_children() -> Iterator[None]:
    """Processes started in the block never see Ctrl-C: a terminal sends it to the whole group.

    They inherit the blocked signal from their first instruction on, so there is no moment at which a worker
    that is still importing could print a traceback.
    """
    if not hasattr(signal, "pthread_sigmask"):  # Windows: workers ignore the signal once they are up
        yield
        return
    resource_tracker.ensure_running()  # started with the first process, it would unblock the signal behind our back
    before = signal.pthread_sigmask(signal.SIG_BLOCK, [signal.SIGINT])
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)

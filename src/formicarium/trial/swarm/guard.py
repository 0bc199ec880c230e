"""The run's side of its watchdog."""

import json
import os
import subprocess
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

WATCHDOG = Path(__file__).with_name("watchdog.py")
PATIENCE = float(os.environ.get("FORMICARIUM_PATIENCE", "60"))  # s of computing for one look of 100 cycles


@contextmanager
def guarded(explaining: list[str]) -> Iterator[Callable[[int], None]]:
    """Have this process watched; call what is returned with the cycle reached, at every look.

    Args:
        explaining: command that explains a failure, to which cycle and kind of failure are added.
    """
    if os.name == "nt":  # no pipe can be waited for with a time limit there: nobody watches
        yield lambda cycle: None
        return
    words = [sys.executable, "-I", "-S", str(WATCHDOG), str(os.getpid()), str(PATIENCE), json.dumps(explaining)]
    dog = subprocess.Popen(words, stdin=subprocess.PIPE)
    assert dog.stdin is not None
    pipe = dog.stdin

    def reached(cycle: int) -> None:
        with suppress(OSError):  # a watchdog that is gone harms nobody
            pipe.write(f"{cycle}\n".encode())
            pipe.flush()

    try:
        yield reached
    finally:
        with suppress(OSError):
            pipe.write(b"over\n")
            pipe.close()
        dog.wait()

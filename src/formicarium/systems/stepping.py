"""Going through a trial in plain Python, cycle by cycle, until something fails; then saying where."""

import pickle
import signal
import sys
import threading
import traceback
import warnings
from _thread import interrupt_main
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from linecache import getline
from pathlib import Path
from types import FrameType, TracebackType
from typing import Any

import numpy as np

from formicarium.sources import PACKAGE
from formicarium.systems.registry import resolve

CYCLE_LIMIT = 10.0  # s that a cycle may take; interpreted ones take some hundredths
WHEELS = ("left", "right")
# As NumPy says it.
BY_ZERO, INVALID, IN_DIVISION = "divide by zero", "invalid value", " encountered in .*(divi|remainder|mod)"


def main() -> None:
    """Read a state from stdin, go on, and print what fails: arguments PATH PLACE CYCLES strict|plain (sys.argv)."""
    advance = resolve(sys.argv[2]).advance
    assert advance is not None
    mind_divisions(sys.argv[4] == "strict")
    print(first_failure(advance, pickle.load(sys.stdin.buffer), int(sys.argv[3])))


def first_failure(advance: Callable[[Any, int], None], state: Any, cycles: int) -> str:
    """Return what fails within so many cycles, in words; empty if nothing does."""
    for _ in range(cycles):
        clock = state.clock[0]
        if clock.cycle >= clock.last_cycle or (clock.finished and not troubled(state)):
            return ""
        before = pickle.dumps(state)
        try:
            with limited(CYCLE_LIMIT):
                advance(state, 1)
        except KeyboardInterrupt as error:
            return f"{whose(error.__traceback__)} never ends its decision:\n{where(error.__traceback__)}"
        except Exception as error:
            said = f"{type(error).__name__}: {error}".rstrip(": ")
            return f"{whose(error.__traceback__)}:\n{where(error.__traceback__)}\n  {said}"
        if troubled(state):
            robot = int(state.trouble[0].robot)
            line = no_number(advance, pickle.loads(before), robot)
            return f"cycle {int(state.trouble[0].cycle)}, robot {robot} commands a speed that is no number:\n{line}"
        clock.event_count = 0
    return ""


def mind_divisions(strict: bool) -> None:
    """Have a reader's own divisions by zero raise, as they do when compiled; NumPy's numbers would go on with inf.

    Args:
        strict: 0 / 0 too. NumPy says the same of inf / inf, which compiled code lets pass.
    """
    np.seterr(all="warn")
    warnings.simplefilter("ignore", RuntimeWarning)
    said = rf"({BY_ZERO}|{INVALID})" if strict else BY_ZERO
    warnings.filterwarnings("error", said + IN_DIVISION, RuntimeWarning, rf"(?!{PACKAGE.name}\b)")


def troubled(state: Any) -> bool:
    """Tell whether a command was no number."""
    return hasattr(state, "trouble") and state.trouble[0].robot != 0


@contextmanager
def limited(seconds: float) -> Iterator[None]:
    """Interrupt what takes longer, also where a shell in the background has SIGINT ignored."""
    previous = signal.signal(signal.SIGINT, signal.default_int_handler)
    timer = threading.Timer(seconds, interrupt_main)
    timer.daemon = True
    timer.start()
    try:
        yield
    finally:
        timer.cancel()
        signal.signal(signal.SIGINT, previous)


def frames_of(trace: TracebackType | None) -> list[tuple[FrameType, int]]:
    """Return frames and lines of a traceback, outermost first."""
    return list(traceback.walk_tb(trace))


def whose(trace: TracebackType | None) -> str:
    """Return "cycle 12, robot 7", as far as the frames of a traceback know it."""
    words: dict[str, str] = {}
    for frame, _ in frames_of(trace):
        names = frame.f_locals
        if (state := names.get("state")) is not None and hasattr(state, "clock"):
            words["cycle"] = f"cycle {int(state.clock[0].cycle)}"
            if isinstance(names.get("i"), int) and names["i"] < len(state.robots):
                words["robot"] = f"robot {int(state.robots[names['i']].identity)}"
        reading = names.get("reading")
        if reading is not None and "identity" in (getattr(getattr(reading, "dtype", None), "names", None) or ()):
            words["robot"] = f"robot {int(reading.identity)}"
    return ", ".join(words.values()) or "somewhere"


def where(trace: TracebackType | None) -> str:
    """Return file, line and text of the innermost frame of a reader's own code."""
    frames = frames_of(trace)
    own = [(frame, line) for frame, line in frames if is_own(frame)] or frames[-1:]
    return "\n".join(place(frame.f_code.co_filename, line, frame.f_code.co_name) for frame, line in own[-2:][::-1])


def place(file: str, line: int, function: str) -> str:
    """Write a line of a file."""
    return f"  {file}, line {line}, in {function}\n      {getline(file, line).strip()}"


def is_own(frame: FrameType) -> bool:
    """Tell whether a frame is of a reader's own code."""
    file = frame.f_code.co_filename
    return not Path(file).is_relative_to(PACKAGE) and not file.startswith("<") and "site-packages" not in file


def no_number(advance: Callable[[Any, int], None], state: Any, robot: int) -> str:
    """Go through a cycle again, line by line; return the line after which a wheel's speed is no number."""
    found: list[str] = []
    last: list[tuple[str, int, str]] = []

    def lines(frame: FrameType, event: str, _: Any) -> Any:
        command = next((frame.f_locals[name] for name in ("command",) if name in frame.f_locals), None)
        reading = frame.f_locals.get("reading")
        ours = reading is None or int(getattr(reading, "identity", robot)) == robot
        if command is not None and ours and not found:
            if last and not all(np.isfinite(command[name]) for name in WHEELS):
                found.append(place(*last[-1]))
        if event == "line" and is_own(frame):
            last.append((frame.f_code.co_filename, frame.f_lineno, frame.f_code.co_name))
        return lines

    for command in state.commands:
        for name in WHEELS:
            command[name] = 0.0
    sys.settrace(lines)
    try:
        advance(state, 1)
    finally:
        sys.settrace(None)
    return found[0] if found else "  (in the command it had from the start)"

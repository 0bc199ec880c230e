"""Why a run of a reader's swarm failed: file, line, robot and cycle, found by going there in plain Python.

A trial is its parameters and its seed, so it can be led to the last cycle that was well, compiled, and from there on
interpreted: then Python itself says which line fails, or never ends.
"""

import json
import os
import pickle
import re
import shlex
import subprocess
import sys
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from formicarium.sources import INSTALLED, PACKAGE
from formicarium.systems.registry import resolve

INTERPRETED_CYCLES = 220  # enough for two looks
LONGEST = 120.0  # s for all of them
FILE = re.compile(r'File "(?P<file>[^"]+)", line (?P<line>\d+)| at (?P<other>\S+\.py) \((?P<number>\d+)\)')
WHERE = re.compile(r"cycle (?P<cycle>\d+), robot (?P<robot>\d+)")
ADVICE = (
    "Way out: functions under @compiled may use numbers, records, arrays, math and other compiled functions; no "
    "dictionaries, texts, classes or new arrays. The code itself runs as plain Python with FORMICARIUM_INTERPRETED=1."
)


def explain(place: str, parameters: str, seed: int, cycle: int, what: str) -> str:
    """Return in words what has gone wrong.

    Args:
        place: the system as "module:object".
        parameters: of the trial, as JSON.
        seed: of the trial.
        cycle: the last that is known to be well.
        what: how it failed: "hangs: ...", "died", or the message of an exception.
    """
    system = resolve(place)
    head = f"{system.name}, seed {seed}"
    state = system.begin(system.parameters.model_validate_json(parameters), seed)  # type: ignore[misc]
    reached = 0
    try:
        if cycle:
            system.advance(state, cycle)  # type: ignore[misc]
        reached = cycle
    except Exception:  # it cannot be compiled
        state = system.begin(system.parameters.model_validate_json(parameters), seed)  # type: ignore[misc]
    found = interpreted(place, state)
    if not found and "ZeroDivisionError" in what:
        found = interpreted(place, state, "strict")
    if found:
        settings = changed(system.configure().model_dump(mode="json"), json.loads(parameters))
        return f"{head}, {found}{way_out(system.name, seed, found, settings)}"
    if "Failed in nopython mode" in what or "numba" in what or "TypingError" in what:
        return f"{head}: the compiler does not understand{lines_of(what)}\n{ADVICE}"
    return f"{head}: {what} after cycle {reached}; plain Python goes on from there without complaint.\n{ADVICE}"


def changed(usual: Mapping[str, Any], chosen: Mapping[str, Any], prefix: str = "") -> list[str]:
    """Return what must be said after --set to come from one set of parameters to another: "group.name=value"."""
    found = []
    for name, value in chosen.items():
        before = usual.get(name)
        if isinstance(value, Mapping) and isinstance(before, Mapping):
            found += changed(before, value, f"{prefix}{name}.")
        elif value != before:
            text = value if isinstance(value, str) else json.dumps(value, separators=(",", ":"))
            found.append(f"{prefix}{name}={text}")
    return found


def way_out(name: str, seed: int, found: str, settings: Sequence[str]) -> str:
    """Return the command that stops where a behaviour fails; empty if no robot's cycle is known."""
    place = WHERE.match(found)
    if place is None:
        return ""
    command = ["formicarium", "debug", name, "--seed", str(seed), "--cycle", place["cycle"], "--robot", place["robot"]]
    command += [word for setting in settings for word in ("--set", setting)]
    return f"\nWay out: {shlex.join(command)}\nstops there, line by line."


def lines_of(message: str) -> str:
    """Return the lines of a reader's files that a message of the compiler names, and what it says."""
    named = [(m["file"] or m["other"], m["line"] or m["number"]) for m in FILE.finditer(message)]
    own = [(Path(file).resolve(), line) for file, line in named[::-1] if is_own(file)]  # the innermost first
    places = "".join(f"\n  {file}, line {line}" for file, line in dict.fromkeys(own))
    said = [
        line.strip() for line in message.splitlines() if line.strip() and not line.lstrip().startswith(("File", "-"))
    ]
    telling = [line for line in said if not line.startswith(("Failed in", "During:", "[1", "[2", "[3", "This error"))]
    return f"{places}\n  {' '.join(telling[:3])[:500]}"


def is_own(file: str) -> bool:
    """Tell whether a file is a reader's."""
    path = Path(file)
    return path.suffix == ".py" and not path.is_relative_to(PACKAGE) and not INSTALLED & set(path.parts)


def interpreted(place: str, state: Any, divisions: str = "plain") -> str:
    """Go on from a state in plain Python, in a process of its own; return what fails, empty if nothing does.

    Args:
        place: the system as "module:object".
        state: to begin with.
        divisions: "strict" to stop at 0 / 0 of NumPy's numbers too.
    """
    program = (
        "import json, sys; sys.path[:] = json.loads(sys.argv[1]); from formicarium.systems.stepping import main; main()"
    )
    try:
        done = subprocess.run(
            [sys.executable, "-c", program, json.dumps(sys.path), place, str(INTERPRETED_CYCLES), divisions],
            input=pickle.dumps(state), env=os.environ | {"FORMICARIUM_INTERPRETED": "1"}, timeout=LONGEST,
            capture_output=True, check=False,
        )  # fmt: skip
    except subprocess.TimeoutExpired:
        return f"and plain Python does not come to {INTERPRETED_CYCLES} cycles in {LONGEST:g} s either"
    if done.returncode:
        return f"and plain Python fails before it comes there: {done.stderr.decode().strip().splitlines()[-1:]}"
    return done.stdout.decode().strip()

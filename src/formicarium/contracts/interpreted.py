"""What the compiled loop does, the same Python does without a compiler, to the last bit."""

import itertools
import json
import os
import pickle
import subprocess
import sys
from typing import Any
from unittest import SkipTest

from formicarium.compiled import source_hash
from formicarium.contracts.broken import require
from formicarium.contracts.states import advanced, copy_of, differences, recorded
from formicarium.systems.registry import resolve

PROGRAM = """
import json, pickle, sys
sys.path[:] = json.loads(sys.argv[1])
from formicarium.systems.registry import resolve
from formicarium.compiled import INTERPRETED, source_hash
assert INTERPRETED
if source_hash() != sys.argv[4]:
    sys.exit("the sources were edited while the test ran")
system = resolve(sys.argv[2])
state = pickle.load(sys.stdin.buffer)
system.advance(state, int(sys.argv[3]))
pickle.dump(state, sys.stdout.buffer)
"""


def interpreted(name: str, state: Any, cycles: int) -> Any:
    """Return the state after so many cycles of the uncompiled loop, run in a process of its own."""
    done = subprocess.run(
        [sys.executable, "-c", PROGRAM, json.dumps(sys.path), name, str(cycles), source_hash()],
        env=os.environ | {"FORMICARIUM_INTERPRETED": "1"}, input=pickle.dumps(state), capture_output=True, check=False,
    )  # fmt: skip
    if b"the sources were edited" in done.stderr:
        raise SkipTest("the sources were edited while the test ran")
    require(done.returncode == 0, f"the uncompiled loop fails:\n{done.stderr.decode()}")
    return pickle.loads(done.stdout)


def compiled(name: str, state: Any, cycles: int) -> Any:
    """Return the state after so many cycles of the compiled loop."""
    return advanced(resolve(name), copy_of(state), cycles)


def windows(name: str, count: int, length: int) -> list[Any]:
    """Return starting states that together have every role of the living; a robot dies in each window."""
    roles = resolve(name).roles
    pool = list(itertools.islice(recorded(name, every=length), 40))
    chosen: list[Any] = []
    while pool and len(chosen) < count:
        met = {role for state in chosen for role in roles(state)} if roles else set()
        chosen.append(
            max(pool, key=lambda state: len(set(roles(state)) - met) if roles else 0)
        )  # the first of the best
        pool = [state for state in pool if state is not chosen[-1]]
    for state in chosen:
        state.robots[0].dies_at = state.clock[0].cycle + length // 2
    return chosen


def compiled_equals_interpreted(name: str, length: int = 24) -> None:
    """A window in the midst of a trial is the same compiled and interpreted, to the last bit."""
    start = windows(name, 1, 600)[0]
    start.robots[0].dies_at = start.clock[0].cycle + length // 2
    expected = compiled(name, start, length)
    require(len(differences(start, expected)) > 3, "hardly anything changes within so few cycles")
    found = differences(interpreted(name, start, length), expected)
    require(
        not found, f"compiled and interpreted differ in {', '.join(found[:5])}; math.hypot? sums of arrays? integers?"
    )

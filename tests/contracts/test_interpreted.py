"""What the compiled loop does, the same Python does without a compiler, to the last bit."""

import itertools
import os
import pickle
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from contracts.states import copy_of, differences, recorded
from formicarium.compiled import source_hash
from formicarium.systems.registry import resolve

PROGRAM = """
import pickle, sys
sys.path.insert(0, sys.argv[1])
from formicarium.systems.registry import resolve
from formicarium.compiled import INTERPRETED, source_hash
assert INTERPRETED
if source_hash() != sys.argv[4]:
    sys.exit("the sources were edited while the test ran")
state = pickle.load(sys.stdin.buffer)
resolve(sys.argv[2]).advance(state, int(sys.argv[3]))
pickle.dump(state, sys.stdout.buffer)
"""


def interpreted(name, state, cycles):
    """Return the state after so many cycles of the uncompiled loop, run in a process of its own."""
    done = subprocess.run(
        [sys.executable, "-c", PROGRAM, str(Path(__file__).parents[1]), name, str(cycles), source_hash()],
        env=os.environ | {"FORMICARIUM_INTERPRETED": "1"}, input=pickle.dumps(state), capture_output=True, check=False,
    )  # fmt: skip
    if b"the sources were edited" in done.stderr:
        pytest.skip("the sources were edited while the test ran")
    assert done.returncode == 0, done.stderr.decode()
    return pickle.loads(done.stdout)


def compiled(name, state, cycles):
    state = copy_of(state)
    resolve(name).advance(state, cycles)
    return state


def windows(name, count, length):
    """Return starting states that together have every role of the living; a robot dies in each window."""
    roles = resolve(name).roles
    pool = list(itertools.islice(recorded(name, every=length), 40))
    chosen = []
    while pool and len(chosen) < count:
        met = {role for state in chosen for role in roles(state)}
        chosen.append(max(pool, key=lambda state: len(set(roles(state)) - met)))  # the first of the best
        pool = [state for state in pool if state is not chosen[-1]]
    for state in chosen:
        state.robots[0].dies_at = state.clock[0].cycle + length // 2
    return chosen


def wanted(name):
    """Return the role numbers that living robots can have: all of the scene's but the last, the dead."""
    system = resolve(name)
    return set(range(len(system.run(system.configure(robots=1), 1).scene.roles) - 1))


def test_a_short_window_in_the_midst_of_a_trial(name):
    length = 40
    start = windows(name, 1, 600)[0]
    start.robots[0].dies_at = start.clock[0].cycle + length // 2
    expected = compiled(name, start, length)
    assert len(differences(start, expected)) > 20
    assert differences(interpreted(name, start, length), expected) == []


@pytest.mark.long
def test_ten_windows_of_a_minute_with_every_role(name):
    starts = windows(name, 10, 600)
    roles = set(np.concatenate([resolve(name).roles(state) for state in starts]).tolist())
    assert roles >= wanted(name) and len(starts) == 10
    for start in starts:
        assert differences(interpreted(name, start, 600), compiled(name, start, 600)) == []

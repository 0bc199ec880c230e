"""One robot's decisions, line by line: from a cycle of a run on, in Python's own debugger."""

import os
import subprocess
import sys

import pytest

from formicarium.commands.debugging import debug_run, state_of
from formicarium.commands.errors import UserError

NONE = (None, None, ())
PROGRAM = """
from formicarium.commands.debugging import debug_run, state_of
robot = sorted(state_of("mark-i3", 0, 5, (None, 3, ()))[1].robots.identity)[1]
print("chosen", robot, flush=True)
debug_run("mark-i3", 0, int(robot), 2, 5, (None, 3, ()))
"""


def test_it_stops_where_the_robot_decides_once_a_cycle():
    done = subprocess.run(
        [sys.executable, "-c", PROGRAM], input="p reading.identity\nn\nc\np reading.cycle\nc\n",
        env=os.environ | {"FORMICARIUM_INTERPRETED": "1"}, capture_output=True, text=True, check=False, timeout=300,
    )  # fmt: skip
    robot = done.stdout.partition("chosen ")[2].split()[0]
    assert done.returncode == 0, done.stderr
    assert f"robot {robot}, cycle 0" in done.stdout and f"robot {robot}, cycle 1" in done.stdout
    assert "behaviour.py" in done.stdout and "decide" in done.stdout
    printed = [line.removeprefix("(Pdb) ") for line in done.stdout.splitlines() if line.startswith("(Pdb) ")]
    assert robot in printed[0] and "1" in printed[-2:][0] + printed[-1]


def test_what_is_not_there_is_named():
    with pytest.raises(UserError, match="there is none; robots are"):
        debug_run("mark-i3", 0, 999, 1, 1, (None, 3, ()))
    with pytest.raises(UserError, match="unknown system"):
        state_of("mark-i33", 0, None, NONE)

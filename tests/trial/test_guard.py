"""A run that hangs or dies within a cycle, where no Python runs, is explained by its watchdog and ended."""

import os
import signal
import subprocess
import sys

PROGRAM = """
import os, sys, time
from formicarium.trial.swarm.guard import guarded
explain = [sys.executable, "-c", "import sys; print('after cycle', sys.argv[1], 'it', sys.argv[2])"]
with guarded(explain) as reached:
    reached(100)
    reached(200)
    {deed}
print("well")
"""


def run(deed, patience="1"):
    return subprocess.run(
        [sys.executable, "-c", PROGRAM.format(deed=deed)], capture_output=True, text=True, check=False, timeout=100,
        env=os.environ | {"FORMICARIUM_PATIENCE": patience, "FORMICARIUM_INTERPRETED": "1"},
    )  # fmt: skip


def test_a_run_that_hangs_is_explained_and_ended():
    done = run("while True: pass")
    assert "no look at the trial for 0.25 s of computing since cycle 200" in done.stderr
    assert "after cycle 200 it hangs: no control cycle has ended for 1 s of computing" in done.stderr
    assert done.returncode == -signal.SIGTERM and "well" not in done.stdout


def test_a_run_that_dies_is_explained():
    done = run("os.kill(os.getpid(), 11)")
    assert done.returncode == -signal.SIGSEGV
    assert "after cycle 200 it died" in done.stderr


def test_a_run_that_waits_or_is_well_is_left_alone():
    done = run("time.sleep(3)")
    assert done.returncode == 0 and done.stdout == "well\n" and done.stderr == ""

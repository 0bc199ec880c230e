"""Seconds from nothing to the first simulated cycle, and for the whole command, with nothing compiled and with all.

    python benchmarks/start.py

Each start is a process of its own that runs ``formicarium run mark-i3`` with a trial of one second, its tables and its
two pictures into an empty folder. A cold start has an empty compile cache, a warm one the cache of the cold one before
it. Medians (least to most) of several; the processor's time beside them hardly feels what else a machine is doing.

Needs an operating system that counts the processor's time of child processes (Linux, macOS).
"""

import os
import resource
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import NamedTuple

from scenes import PLACES, reference_kernel, reference_time

COLD, WARM = 3, 3  # starts: cold ones, and warm ones after each of them

# The command, made to tell when it first looks at the trial: after 100 cycles, four thousandths of a second.
PROGRAM = """
import sys, time
from formicarium.commands.main import main
from formicarium.trial import simulate

def told(state):
    print(f"first cycles {time.time()}", flush=True)
    simulate.drain = drain
    return drain(state)

drain, simulate.drain = simulate.drain, told
main(sys.argv[1:])
"""


class Start(NamedTuple):
    """One start, in seconds."""

    first_cycle: float  # from the start of the process to the end of the first hundred cycles
    whole: float  # to the end of the process
    processor: float  # of one core, user and system


def started(cache: Path) -> Start:
    """Run the command once in a process of its own."""
    with tempfile.TemporaryDirectory() as out:
        environment = os.environ | {"FORMICARIUM_CACHE_DIR": str(cache), "FORMICARIUM_INTERPRETED": ""}
        command = [sys.executable, "-c", PROGRAM, "run", "mark-i3", "--set", "swarm.time_cap=1", "--out", out]
        before, start = children_time(), time.time()
        done = subprocess.run(command, env=environment, capture_output=True, text=True, check=True)
        end = time.time()
    first = next(float(line.split()[-1]) for line in done.stdout.splitlines() if line.startswith("first cycles"))
    return Start(first - start, end - start, children_time() - before)


def children_time() -> float:
    """Return the seconds of processor time that finished child processes have used so far."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def main() -> None:
    """Start cold and warm in turn, and print medians."""
    starts: dict[str, list[Start]] = {"cold": [], "warm": []}
    reference_kernel(PLACES, 1)
    references = []
    for _ in range(COLD):
        references.append(reference_time())
        with tempfile.TemporaryDirectory() as cache:
            starts["cold"].append(started(Path(cache)))
            starts["warm"] += [started(Path(cache)) for _ in range(WARM)]
    print("start   first cycles, s      whole command, s     processor, s")
    for name, those in starts.items():
        columns = [
            f"{statistics.median(one):6.2f} ({min(one):.2f}..{max(one):.2f})" for one in zip(*those, strict=True)
        ]
        print(f"{name:6s} " + "  ".join(f"{column:20s}" for column in columns))
    print(f"reference kernel {statistics.median(references):.3f} us/point; {COLD} cold and {COLD * WARM} warm starts")


if __name__ == "__main__":
    main()

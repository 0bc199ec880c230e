"""A process that watches a run of a swarm and says what has become of it if it hangs or dies. Run by path, alone.

Nobody inside can tell: compiled code holds the interpreter, and a wrong index may end the process. The run writes a
line at every look; when none has come for so much of the run's own processor time, it is explained and ended.
Arguments: the run's process, seconds of patience, the command that explains (JSON).
"""

import json
import os
import select
import signal
import subprocess
import sys
import time


def processor_time(process: int) -> float:
    """Return the seconds a process has been computing; a process that is stopped or waits uses none."""
    try:
        with open(f"/proc/{process}/stat", encoding="ascii") as file:
            fields = file.read().rpartition(")")[2].split()
        return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")
    except (OSError, ValueError, IndexError):
        return time.monotonic()  # no such file on this system: by the clock on the wall


def explain(command: list[str], cycle: str, what: str) -> None:
    """Write to stderr what is known of the run."""
    done = subprocess.run([*command, cycle, what], stdout=subprocess.PIPE, text=True, check=False)
    say(done.stdout.strip() or what)


def say(what: str) -> None:
    """Write to stderr, below what the run's progress has left there."""
    sys.stderr.write(f"\nformicarium: {what}\n")
    sys.stderr.flush()


def watch(process: int, patience: float, command: list[str]) -> None:
    """Read lines until the run says that it is over, hangs, or is gone."""
    cycle, heard, warned = "0", processor_time(process), False
    while True:
        ready, _, _ = select.select([0], [], [], 1.0)
        if ready:
            line = os.read(0, 65536).decode()
            if not line:
                return explain(command, cycle, "died")
            cycle = line.split()[-1]
            if cycle == "over":
                return None
            heard, warned = processor_time(process), False
        elif not warned and processor_time(process) - heard > 0.25 * patience:
            warned = True
            say(f"no look at the trial for {0.25 * patience:g} s of computing since cycle {cycle}; "
                f"it is ended and explained after {patience:g} s (FORMICARIUM_PATIENCE)")  # fmt: skip
        elif processor_time(process) - heard > patience:
            explain(command, cycle, f"hangs: no control cycle has ended for {patience:g} s of computing")
            os.kill(process, signal.SIGTERM)
            time.sleep(5.0)  # who has taken over the signal cannot hear it either
            if not select.select([0], [], [], 0.0)[0]:  # its end of the pipe is still open
                os.kill(process, signal.SIGKILL)
            return None


if __name__ == "__main__":
    watch(int(sys.argv[1]), float(sys.argv[2]), json.loads(sys.argv[3]))

"""What a campaign costs beside its trials: against a bare loop, and two workers against two bare processes.

    python benchmarks/campaign_overhead.py work|wait [TRIALS [REPEATS]]

A trial computes until its process has used one second of processor time (work), or sleeps for a second (wait). It is
not a fixed amount of computing: on a virtual machine the same loop takes 20 % more or less from one second to the next,
which a few repeats do not average out. What takes the core away from a trial, such as the coordinator, still counts.
Bare and campaign take turns in the same run; both start their processes anew, and that is in the time. The bare ones
are timed up to their last trial, the campaign until all is written and its processes have ended. Reported are the
median and the range over the repeats of the ratio of neighbours, the share of the workers' time that was spent inside
trials, and the processor time of the coordinator.
"""

import statistics
import sys
import tempfile
import time
from functools import partial
from multiprocessing import get_context
from pathlib import Path
from typing import Any

from formicarium.campaigns.cells import Job, cells_of
from formicarium.campaigns.configuration import Configuration
from formicarium.campaigns.coordinator import run_campaign
from formicarium.campaigns.design import make_design
from formicarium.campaigns.ledger import Ledger
from formicarium.campaigns.result import Result
from formicarium.campaigns.workers import Processes
from formicarium.campaigns.writer import Writer

KINDS = ("work", "wait")
SECONDS = 1.0  # of a trial
MANIFEST = {"name": "overhead", "system": "work"}


def trial(kind: str, seed: int, watch: object) -> Result:
    """Compute or sleep for a second; the result is a row like that of a trial."""
    value, end = seed, time.process_time() + SECONDS
    if kind == "wait":
        time.sleep(SECONDS)
    while kind == "work" and time.process_time() < end:
        value = (value * 1103515245 + 12345) % 2147483648
    return Result({"value": value, **{f"column_{k}": value % (k + 2) for k in range(30)}}, {})


def loop(kind: str, trials: int, first: int, done: Any) -> None:
    """Do the trials one after the other, keep nothing and say when they are done."""
    for seed in range(first, first + trials):
        trial(kind, seed, None)
    done.send(True)


def bare(kind: str, trials: int, processes: int) -> float:
    """Return the seconds that bare processes need for so many trials each, up to the last trial, not to their exit."""
    context = get_context("spawn")
    started = time.perf_counter()
    pipes = [context.Pipe(duplex=False) for _ in range(processes)]
    crew = [
        context.Process(target=loop, args=(kind, trials, 1 + trials * k, done)) for k, (_, done) in enumerate(pipes)
    ]
    for process in crew:
        process.start()
    for ours, _ in pipes:
        ours.recv()
    seconds = time.perf_counter() - started
    for process in crew:
        process.join()
    return seconds


def campaign(kind: str, trials: int, workers: int) -> tuple[float, float]:
    """Run a campaign of so many trials a worker.

    Returns the seconds that it needs with all that it writes, and the share of the workers' time inside trials.
    """
    design = make_design({**MANIFEST, "replicates": trials * workers, "first_seed": 1})
    jobs = [Job(cell, Configuration("work", {}, "none", "0"), partial(trial, kind)) for cell in cells_of(design)]
    with tempfile.TemporaryDirectory() as folder:
        started = time.perf_counter()
        with Writer(Ledger(Path(folder)), MANIFEST, jobs) as writer:
            report = run_campaign(jobs, writer, Processes(workers))
        seconds = time.perf_counter() - started
        inside = sum(Ledger(Path(folder)).rows()["wall_seconds"].to_pylist())
    assert report.standing.done == trials * workers
    return seconds, inside / (workers * seconds)


def measure(kind: str, trials: int, repeats: int, workers: int) -> list[tuple[float, float, float]]:
    """Return seconds bare, seconds as a campaign, and its share inside trials, of every repeat."""
    return [(bare(kind, trials, workers), *campaign(kind, trials, workers)) for _ in range(repeats)]


if __name__ == "__main__":
    kind, *numbers = sys.argv[1:] or ["work"]
    trials, repeats = (int(word) for word in [*numbers, *["20", "3"][len(numbers) :]])
    assert kind in KINDS, f"{kind}: one of {KINDS}"
    for workers, name in ((1, "one worker against a bare loop"), (2, "two workers against two bare processes")):
        before = time.process_time()
        found = measure(kind, trials, repeats, workers)
        coordinating = (time.process_time() - before) / (trials * workers * repeats)
        overheads = [whole / alone - 1 for alone, whole, _ in found]
        median = statistics.median(overheads)
        print(
            f"{name}: overhead {median:+.1%} ({min(overheads):+.1%} to {max(overheads):+.1%}), "
            f"{1 / (1 + median):.1%} of the bare speed; "
            f"coordinator {coordinating * 1000:.1f} ms of processor time a trial; "
            f"inside trials {statistics.median(share for _, _, share in found):.1%}; "
            f"seconds {', '.join(f'{alone:.2f}/{whole:.2f}' for alone, whole, _ in found)}",
            flush=True,
        )

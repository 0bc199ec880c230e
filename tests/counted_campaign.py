"""A campaign of a function that is not a simulation: squares, for tests of ledgers, crews and faults.

As a program it runs the campaign in a folder with two worker processes:
``python -m counted_campaign FOLDER RUNS PAUSE``.
"""

import os
import signal
import sys
import time
from functools import partial
from pathlib import Path

import pyarrow as pa

from formicarium.campaigns.cells import Job, cells_of
from formicarium.campaigns.configuration import Configuration
from formicarium.campaigns.coordinator import run_campaign
from formicarium.campaigns.design import make_design
from formicarium.campaigns.ledger import Ledger
from formicarium.campaigns.result import Result
from formicarium.campaigns.tidy import tidy
from formicarium.campaigns.workers import Processes
from formicarium.campaigns.writer import Writer

MANIFEST = {"name": "counted", "system": "squares"}


def squares(power: int, pause: float, trouble: str, seed: int, watch) -> Result:
    """Give seed ** power. Some seeds make trouble if asked to: one raises, one dies, one never ends."""
    time.sleep(pause)
    if trouble == "raise" and seed == 3:
        raise ArithmeticError(f"{seed} cannot be raised")
    if trouble == "die" and seed == 3:
        os.kill(os.getpid(), signal.SIGKILL)
    if trouble == "die once" and seed == 3:
        mark = Path(os.environ["COUNTED_MARK"])
        if not mark.exists():
            mark.touch()
            os.kill(os.getpid(), signal.SIGKILL)
    if trouble == "hang" and seed == 3:
        time.sleep(600)
    half = None if seed % 5 == 0 else seed / 2
    return Result(
        {"value": (seed % 1000) ** power, "half": half, "even": seed % 2 == 0, "name": f"n{seed}", "never": None},
        {"numbers": pa.table({"number": range(seed % 7)})},
    )


def jobs(runs=10, pause=0.0, trouble="", sources="sources", first_seed=1):
    design = make_design(
        {**MANIFEST, "replicates": runs // 2, "first_seed": first_seed, "factors": {"power": [1, 2]}},
    )
    return [
        Job(
            cell,
            Configuration("squares", {"power": cell.factors["power"]}, sources, "0"),
            partial(squares, cell.factors["power"], pause, trouble),
        )
        for cell in cells_of(design)
    ]


def campaign(folder, crew, found, **options):
    """Run a campaign and return its report and the tidy table."""
    ledger = Ledger(Path(folder))
    with Writer(ledger, MANIFEST, found) as writer:
        report = run_campaign(found, writer, crew, **options)
    return report, table(folder, found)


def table(folder, found):
    return tidy(Ledger(Path(folder)).rows(), found)


def keys_in_parts(folder):
    """Return the key of every row of every part, repetitions included."""
    ledger = Ledger(Path(folder))
    ledger.refresh()
    assert not ledger.damaged
    return sum(ledger.known.values()), len(ledger.done)


if __name__ == "__main__":
    report, _ = campaign(sys.argv[1], Processes(2), jobs(int(sys.argv[2]), float(sys.argv[3])))
    print(report.standing.produced)

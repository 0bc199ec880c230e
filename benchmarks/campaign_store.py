"""A store of 100,000 rows: time and memory to open, filter and collect it, in a fresh process.

    python benchmarks/campaign_store.py [ROWS]

Rows have the 30 columns of a trial of Mark I3, in 100 cells, in parts as a campaign leaves them.
"""

import json
import resource
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np
import pyarrow as pa
import pyarrow.compute as pc

from formicarium.campaigns import table
from formicarium.campaigns.cells import Job, cells_of
from formicarium.campaigns.configuration import Configuration
from formicarium.campaigns.design import make_design
from formicarium.campaigns.ledger import Ledger
from formicarium.campaigns.parts import OWN, write_part
from formicarium.campaigns.tidy import tidy

CELLS = 100
PART = 4096  # rows


def jobs(rows: int) -> list[Job]:
    """Return cells whose runs are the rows."""
    design = make_design(
        {"name": "store", "system": "none", "replicates": rows // CELLS, "factors": {"x": list(range(CELLS))}}
    )
    return [Job(cell, Configuration("none", dict(cell.factors), "sources", "0"), print) for cell in cells_of(design)]


def build(folder: Path, rows: int) -> None:
    """Write the parts of a store, its runs in random order as workers end them."""
    random = np.random.default_rng(1)
    keys = [(*key, job.cell.number) for job in jobs(rows) for key in job.keys]
    keys = [keys[k] for k in random.permutation(len(keys))]
    for number, start in enumerate(range(0, len(keys), PART)):
        chosen = keys[start : start + PART]
        count = len(chosen)
        own = (
            [identity for identity, _, _ in chosen],
            [seed for _, seed, _ in chosen],
            ["8391d972b36db7ad"] * count,
            [json.dumps({"x": cell}) for _, _, cell in chosen],
            random.exponential(2.0, count),
            ["0"] * count,
        )
        columns = {name: pa.array(values, kind) for (name, kind), values in zip(OWN.items(), own)}
        columns |= {f"count_{k}": pa.array(random.integers(0, 10**6, count)) for k in range(18)}
        columns |= {f"time_{k}_s": pa.array(random.exponential(900.0, count)) for k in range(10)}
        columns |= {"order": pa.array(random.choice(["RGB", "GBR", "BRG"], count).tolist())}
        columns |= {"cause": pa.array(random.choice(["no chain", "late"], count).tolist())}
        write_part(pa.table(columns), folder / "parts" / f"part-{number:06d}.parquet")


def use(folder: Path, rows: int) -> dict[str, float]:
    """Open, filter and collect the store; return seconds of each and the peak memory in MB."""
    found = jobs(rows)
    started = time.perf_counter()
    ledger = Ledger(folder)
    ledger.refresh()
    missing = sum(not ledger.has(key) for job in found for key in job.keys)
    opened = time.perf_counter()
    whole = tidy(ledger.rows(), found)
    collected = time.perf_counter()
    cell = whole.filter(pc.equal(whole["cell"], 7))
    filtered = time.perf_counter()
    table.write(whole, folder / "runs.parquet")
    written = time.perf_counter()
    assert missing == 0 and len(whole) == rows and len(cell) == rows // CELLS
    kilobytes = peak_kilobytes()
    return {
        "open_s": opened - started,
        "collect_s": collected - opened,
        "filter_s": filtered - collected,
        "write_s": written - filtered,
        "whole_s": written - started,
        "peak_mb": kilobytes / 1024,
    }


def peak_kilobytes() -> float:
    """Return the most memory that this program has had; Linux counts what started it too if one asks getrusage."""
    if (status := Path("/proc/self/status")).exists():
        return float(next(line.split()[1] for line in status.read_text().splitlines() if line.startswith("VmHWM")))
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / (1024 if sys.platform == "darwin" else 1)


def measure(rows: int) -> dict[str, float]:
    """Build a store and use it in a fresh process."""
    with tempfile.TemporaryDirectory() as place:
        build(Path(place), rows)
        command = [sys.executable, __file__, "use", place, str(rows)]
        return json.loads(subprocess.run(command, capture_output=True, text=True, check=True).stdout)


if __name__ == "__main__":
    if sys.argv[1:2] == ["use"]:
        print(json.dumps(use(Path(sys.argv[2]), int(sys.argv[3]))))
    else:
        for name, value in measure(int(sys.argv[1]) if sys.argv[1:] else 100_000).items():
            print(f"{name:10s} {value:8.3f}")

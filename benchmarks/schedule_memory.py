"""How much memory a thousand solves leave behind: ``python benchmarks/schedule_memory.py [SOLVES]``.

Small and large ones in turn: least time of every class, least dislocation of instances whose programmes take hundreds
of megabytes while they run. Compared is the resident memory after the first fifty with that at the end.
"""

import resource
import sys
from pathlib import Path

from formicarium.scheduling.generator import DENSITIES, draw_instance
from formicarium.scheduling.solver import solve

WARM = 50
TRAVELS = ((5, 0.05), (3, 0.1), (3, 0.5), (1, 0.01), (4, 0.1))  # seconds each


def resident() -> float:
    """Return the resident memory of this process in MB (Linux)."""
    return int(Path("/proc/self/statm").read_text().split()[1]) * resource.getpagesize() / 1e6


def main(solves: int) -> None:
    """Solve and print."""
    after_warm = most = 0.0
    for number in range(solves):
        seed = 900_000 + number
        if number % 20 == 0:
            solve(draw_instance(*TRAVELS[number // 20 % len(TRAVELS)], seed), "travel", "printed", 20.0)
        else:
            solve(draw_instance(1 + number % 5, DENSITIES[number % 6], seed), "time", "printed", 20.0)
        now = resident()
        most = max(most, now)
        if number == WARM:
            after_warm = now
        if number % WARM == 0:
            print(f"{number:5d} solves: {now:7.1f} MB", flush=True)
    print(f"after {WARM}: {after_warm:.1f} MB; after {solves}: {now:.1f} MB; growth {now - after_warm:.1f} MB")


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 1000)

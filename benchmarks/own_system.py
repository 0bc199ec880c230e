"""What a reader's own system costs beside a built-in one of equal work, and what importing the package costs.

    python benchmarks/own_system.py

20 robots that sense, talk by radio and push, 1,000 cycles; the built-in system is Mark I3. The laid-out one senses
light and ground as well, and decides less. As laid out everybody speaks in every cycle, which is more to hear than in
Mark I3; for equal work it speaks in every second. Packets heard tell which is which. Medians of ratios taken in turn in
one process, with extremes.
"""

import os
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from formicarium.commands.laying_out import lay_out
from formicarium.systems.registry import resolve

CYCLES, ROUNDS = 1000, 9
SPEAKS = "    broadcast(command)\n"


def seconds(system, state, cycles):
    began = time.process_time()
    done = 0
    while done < cycles:
        system.advance(state, 100)
        state.clock[0].event_count = 0
        done += 100
    return time.process_time() - began


def compare(name):
    """Print the ratio of a laid-out system of the current folder to Mark I3."""
    own, built_in = resolve(name), resolve("mark-i3")
    behaviour = own.configure().behaviour.model_copy(update={"stay": 0.0})  # nobody rests, no trial ends
    own_parameters = own.configure().model_copy(update={"behaviour": behaviour})
    for system, parameters in ((own, own_parameters), (built_in, built_in.configure())):
        began = time.perf_counter()
        system.advance(system.begin(parameters, 0), 1)
        print(f"{system.name}: first cycle after {time.perf_counter() - began:.1f} s")
    ratios, costs, heard = [], [], []
    for seed in range(1, ROUNDS + 1):
        states = own.begin(own_parameters, seed), built_in.begin(built_in.configure(), seed)
        mine, theirs = (seconds(system, state, CYCLES) for system, state in zip((own, built_in), states))
        ratios.append(mine / theirs)
        costs.append(mine / CYCLES * 1e6)
        heard.append([int(state.robots["packets_heard"].sum()) / CYCLES for state in states])
    packets, others = (statistics.median(numbers) for numbers in zip(*heard))
    print(f"{name} / built-in: {statistics.median(ratios):.2f} ({min(ratios):.2f} to {max(ratios):.2f}); "
          f"{statistics.median(costs):.0f} us a cycle; {packets:.0f} packets heard a cycle, built-in {others:.0f}",
          flush=True)  # fmt: skip


def main():
    importing = []
    for _ in range(5):
        began = time.perf_counter()
        subprocess.run([sys.executable, "-c", "import formicarium"], check=True)
        bare = time.perf_counter()
        subprocess.run([sys.executable, "-c", "pass"], check=True)
        importing.append((bare - began) - (time.perf_counter() - bare))
    print(f"import formicarium: {statistics.median(importing):.3f} s more than starting Python")
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        sometimes = f"    if reading.cycle % 2 == 0:\n    {SPEAKS}"
        for name, speaks in (("even-swarm", sometimes), ("bench-swarm", SPEAKS)):
            os.chdir(folder)
            lay_out(name)
            os.chdir(name)
            file = Path(name.replace("-", "_"), "behaviour.py")
            file.write_text(file.read_text(encoding="utf-8").replace(SPEAKS, speaks), encoding="utf-8")
            compare(name)
        with file.open("a", encoding="utf-8") as behaviour_file:
            behaviour_file.write("# edited\n")
        program = (
            "import time; t = time.perf_counter(); from formicarium.systems.registry import resolve; "
            "s = resolve('bench-swarm'); s.advance(s.begin(s.configure(), 1), 1); print(time.perf_counter() - t)"
        )
        for what in ("after an edit of its behaviour", "from the cache"):
            done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
            print(f"own system, import to first cycle, {what}: {float(done.stdout):.1f} s")


if __name__ == "__main__":
    main()

"""Microseconds per robot-step of each phase of the control cycle, in the very run that is timed.

    python benchmarks/phases.py

The loop below does what systems/sequencing/loop.py does and reads the clock after every phase. The clock is the C
library's, called from compiled code (20 to 30 ns, measured and taken off). Three kinds of windows alternate:

- by the package's own loop;
- by phases. How far their sum agrees with the first is printed: 0.97 to 1.03 in most scenes measured on a
  busy machine;
- by phases, with a reading of the clock after each sensor. The sensors add up to 0.8 to 1.1 of the phase "sense"
  (printed), so read them as shares of it.

No sensor depends on another, so the run stays the same to the last bit, which is checked.

Needs a C library with clock_gettime (Linux, macOS).
"""

import ctypes
import statistics
import time
import warnings
from collections.abc import Iterator
from typing import Any

import numpy as np
from scenes import PLACES, SCENES, WINDOW, reference_kernel, reference_time, warmed

from formicarium.compiled import compiled
from formicarium.devices.service import serve_booths
from formicarium.physics.grid import find_neighbours
from formicarium.physics.step import step
from formicarium.robots.simulated.camera import sense_blobs
from formicarium.robots.simulated.proximity import sense_proximity
from formicarium.robots.simulated.radio import sense_packets
from formicarium.robots.simulated.wheels import sense_steps
from formicarium.streams import derived
from formicarium.systems.sequencing.behaviour import decide
from formicarium.systems.sequencing.loop import run
from formicarium.systems.sequencing.measures import note
from formicarium.trial.phases import act, sense

REPEATS = 7
CHOSEN = {("setting 0", 20), ("setting 4", 80), ("as dense", 1000)}
SENSORS = ("proximity", "camera", "radio", "steps")
PHASES = ("sense", "decide", "act", "step", "neighbours", "serve", "note")
SENSE, DECIDE, ACT, STEP, NEIGHBOURS, SERVE, NOTE, PROXIMITY, CAMERA, RADIO, STEPS = range(11)

# A pointer from outside cannot be kept on disk, so these loops are compiled in every process.
warnings.filterwarnings("ignore", message=".*annot cache compiled function")
clock_gettime = ctypes.CDLL(None).clock_gettime
clock_gettime.argtypes = (ctypes.c_int, ctypes.c_size_t)
clock_gettime.restype = ctypes.c_int
MONOTONIC = int(time.CLOCK_MONOTONIC)


@compiled
def lap(spent, phase, stamp, address):
    """Add the nanoseconds since the last call to what a phase has spent."""
    last = stamp[0] * 1_000_000_000 + stamp[1]
    clock_gettime(MONOTONIC, address)
    spent[phase] += stamp[0] * 1_000_000_000 + stamp[1] - last


@compiled
def sense_apart(state, spent, stamp, address):
    """Do what trial/phases.py does in ``sense``, one sensor after the other."""
    cycle = state.clock[0].cycle
    epuck = state.epuck[0]
    for i in range(len(state.robots)):
        robot = state.robots[i]
        if robot.alive == 1:
            reading = state.readings[i]
            reading.identity = robot.identity
            reading.cycle = cycle
            reading.infrared = robot.infrared_heard
            sense_proximity(state.world, i, epuck, derived(robot.noise, cycle), reading)
    lap(spent, PROXIMITY, stamp, address)
    for i in range(len(state.robots)):
        robot = state.robots[i]
        if robot.alive == 1:
            moment = derived(robot.noise, cycle)
            sense_blobs(state.world, i, state.robots, state.commands, state.lights, epuck, moment, state.readings[i])
    lap(spent, CAMERA, stamp, address)
    for i in range(len(state.robots)):
        robot = state.robots[i]
        if robot.alive == 1:
            moment = derived(robot.noise, cycle)
            sense_packets(state.world, i, state.robots, state.commands, state.queue, epuck, moment, state.readings[i])
    lap(spent, RADIO, stamp, address)
    for i in range(len(state.robots)):
        if state.robots[i].alive == 1:
            sense_steps(state.robots[i], epuck, state.readings[i])
    lap(spent, STEPS, stamp, address)


@compiled
def run_by_phases(state, cycles, apart, spent, stamp, address):
    """Advance a trial as the package's loop does and note the nanoseconds that each phase takes."""
    clock = state.clock[0]
    clock_gettime(MONOTONIC, address)
    for _ in range(cycles):
        if clock.finished == 1:
            return
        if apart:
            sense_apart(state, spent, stamp, address)
        else:
            sense(state)
            lap(spent, SENSE, stamp, address)
        for i in range(len(state.robots)):
            if state.robots[i].alive == 1:
                decide(state.readings[i], state.memories[i], state.commands[i], state.behaviour[0], state.epuck[0])
        lap(spent, DECIDE, stamp, address)
        act(state)
        lap(spent, ACT, stamp, address)
        step(state.world)
        lap(spent, STEP, stamp, address)
        find_neighbours(state.world)
        lap(spent, NEIGHBOURS, stamp, address)
        serve_booths(
            state.booths,
            state.lights,
            state.coordinator[0],
            state.robots,
            state.world.bodies,
            state.commands,
            state.booth_table[0],
            clock.cycle,
            state.world.settings[0].cycle_time,
        )
        lap(spent, SERVE, stamp, address)
        note(state)
        lap(spent, NOTE, stamp, address)
        clock.cycle += 1


@compiled
def only_laps(times, spent, stamp, address):
    """Read the clock over and over, to learn what that costs."""
    clock_gettime(MONOTONIC, address)
    for _ in range(times):
        lap(spent, SENSE, stamp, address)


def arrays(state: Any) -> Iterator[np.ndarray]:
    """Yield all arrays of a state."""
    for part in state:
        yield from arrays(part) if isinstance(part, tuple) else (part,)


def differ(one: Any, other: Any) -> bool:
    """Tell whether two states differ in any bit."""
    return any(a.tobytes() != b.tobytes() for a, b in zip(arrays(one), arrays(other), strict=True))


class Stopwatch:
    """What every phase and sensor has spent, and what reading the clock costs (ns)."""

    def __init__(self) -> None:
        self.spent = np.zeros(STEPS + 1, np.int64)
        self.stamp = np.zeros(2, np.int64)  # seconds and nanoseconds, as the C library writes them
        self.arguments = (self.spent, self.stamp, self.stamp.ctypes.data)
        only_laps(10_000, *self.arguments)
        self.spent[:] = 0
        only_laps(10_000, *self.arguments)
        self.reading = self.spent[SENSE] / 10_000

    def by_phases(self, state: Any, cycles: int, apart: bool) -> np.ndarray:
        """Run so many cycles; return microseconds per robot-step of every phase and sensor."""
        self.spent[:] = 0
        run_by_phases(state, cycles, apart, *self.arguments)
        return np.maximum(0.0, self.spent / cycles - self.reading) / len(state.robots) * 1e-3


def main() -> None:
    """Time the phases of every chosen scene and print medians."""
    watch = Stopwatch()
    reference_kernel(PLACES, 1)
    print(f"medians, microseconds a robot-step; a reading of the clock takes {watch.reading:.0f} ns")
    for name, setting, robots in SCENES:
        if (name, robots) not in CHOSEN:
            continue
        whole, split = warmed((name, setting, robots), run), warmed((name, setting, robots), run)
        wholes, references, sums, sensors, phases = [], [], [], [], []
        for repeat in range(2 * REPEATS):
            whole.clock[0].event_count = split.clock[0].event_count = 0
            references.append(reference_time())
            start = time.perf_counter()
            run(whole, WINDOW)
            one = (time.perf_counter() - start) / WINDOW / robots * 1e6
            parts = watch.by_phases(split, WINDOW, apart=repeat % 2 == 1)
            if repeat % 2 == 1:
                sensors.append(parts[PROXIMITY:])
            else:
                wholes.append(one)
                phases.append(parts[:PROXIMITY])
                sums.append(parts.sum() / one)
        if differ(whole, split):
            raise SystemExit(f"{name}, {robots} robots: the loop by phases did not do what the package's loop does")
        by_phase, by_sensor = np.median(phases, axis=0), np.median(sensors, axis=0)
        print(f"\n{name}, {robots} robots: {statistics.median(wholes):.3f} in the package's own loop", end="")
        print(f" (reference kernel {statistics.median(references):.3f} a point)")
        print("  " + "  ".join(f"{phase} {value:.3f}" for phase, value in zip(PHASES, by_phase, strict=True)))
        print(f"  their sum is {statistics.median(sums):.2f} of the whole")
        print("  " + "  ".join(f"{sensor} {value:.3f}" for sensor, value in zip(SENSORS, by_sensor, strict=True)))
        print(f"  their sum is {by_sensor.sum() / by_phase[SENSE]:.2f} of sense", flush=True)


if __name__ == "__main__":
    main()

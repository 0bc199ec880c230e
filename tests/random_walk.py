"""A system without a simulator: robots that walk at random, for tests of campaigns, views and commands.

It has what a real one has (nested parameters, events, frames, targets) and costs milliseconds. Its name for
the registry is "random_walk:RANDOM_WALK".
"""

import os
import signal
import time

import numpy as np
from pydantic import BaseModel, ConfigDict, Field

from formicarium.systems.registry import System, Targets
from formicarium.trial.record import EVENT, Frames, Polygon, Scene, Span, Timeline, Trial

KINDS = ("ROLE", "SEQUENCE", "DEATH")
ROLES = ("runner", "guardian", "link", "tail", "dead")
CYCLE_TIME = 0.1


class Swarm(BaseModel):
    model_config = ConfigDict(extra="forbid")

    robots: int = Field(20, ge=1, le=200, description="robots in the arena (none)", json_schema_extra={"unit": "1"})
    speed: float = Field(0.05, gt=0, le=0.13, description="of a walk (e-puck limit)", json_schema_extra={"unit": "m/s"})


class Booth(BaseModel):
    model_config = ConfigDict(extra="forbid")

    dwell_time: float = Field(8.0, ge=0, le=60, description="of a task (invented)", json_schema_extra={"unit": "s"})
    speed: float = Field(1.0, gt=0, description="of nothing: a second field of that name")
    lamps: tuple[int, ...] = Field((1, 2, 3), description="that are lit")


class Trials(BaseModel):
    model_config = ConfigDict(extra="forbid")

    duration: float = Field(600.0, gt=0, description="of a trial", json_schema_extra={"unit": "s"})
    pause: float = Field(0.0, ge=0, description="wall-clock time a trial takes, for tests of interruption")
    failing_seed: int = Field(-1, description="seed whose trial raises")
    dying_seed: int = Field(-1, description="seed whose trial kills its process")
    repeats: bool = Field(True, description="equal seeds give equal trials")


class Parameters(BaseModel):
    model_config = ConfigDict(extra="forbid")

    swarm: Swarm = Swarm()
    booth: Booth = Booth()
    trial: Trials = Trials()


def configure(setting: int | None = None, robots: int | None = None) -> Parameters:
    if setting is not None and setting not in range(5):
        raise ValueError(f"setting {setting} is not one of 0, 1, 2, 3, 4")
    counts = (20, 28, 40, 57, 80)
    return Parameters(swarm=Swarm(robots=counts[setting or 0] if robots is None else robots))


def run(parameters: Parameters, seed: int, *, frames_every=None, watch=None) -> Trial:
    settings = parameters.trial
    if seed == settings.failing_seed:
        raise RuntimeError("this seed fails on purpose")
    if seed == settings.dying_seed:
        os.kill(os.getpid(), signal.SIGKILL)
    for step in range(10):
        time.sleep(settings.pause / 10)
        if watch:
            watch(settings.duration * (step + 1) / 10, settings.duration)
    generator = np.random.default_rng(seed if settings.repeats else None)
    times = np.cumsum(generator.exponential(settings.duration / 12, 10)) + parameters.booth.dwell_time
    done = times[times < settings.duration]
    outcome = {
        "robots": parameters.swarm.robots,
        **{f"time_{n}_s": float(times[n - 1]) if len(done) >= n else None for n in (1, 5, 10)},
        "sequences": len(done),
        "duration_s": settings.duration,
        "cause": None if len(done) == 10 else ("chain never closed" if len(done) < 8 else "too slow"),
    }
    rows = [(round(t / CYCLE_TIME), 1, 0, 0, i + 1, 0) for i, t in enumerate(done)]
    rows += [(100 * i, 0, i + 1, 0, 1 + i % 3, 0) for i in range(min(parameters.swarm.robots, 6))]
    rows.append((round(0.6 * settings.duration / CYCLE_TIME), 2, parameters.swarm.robots, 0, 0, 0))
    events = np.array(sorted(rows), EVENT)
    return Trial(outcome, events, frames(parameters, generator, frames_every), scene())


def frames(parameters: Parameters, generator, every: float | None) -> Frames | None:
    if every is None:
        return None
    n = parameters.swarm.robots
    cycles = np.arange(0, parameters.trial.duration / CYCLE_TIME + 1, max(round(every / CYCLE_TIME), 1))
    f = len(cycles)
    turns = generator.normal(0, 0.4, (f, n)).cumsum(0)
    place = generator.uniform(-0.6, 0.6, (2, 1, n)) + 0.02 * np.array([np.cos(turns), np.sin(turns)]).cumsum(1)
    place = (place + 0.75) % 3.0
    place = np.where(place > 1.5, 3.0 - place, place) - 0.75
    role = np.zeros((f, n), np.int8)
    chain = [1, 2, 2, 2, 2, 2, 1, 2, 2, 2, 2, 3][:n]
    for i, kind in enumerate(chain):
        role[f // 20 * i :, i] = kind
        place[:, f // 20 * i :, i] = np.array([0.45 - 0.16 * max(i - 5, 0), -0.55 + 0.16 * min(i, 5)])[:, None]
    role[6 * f // 10 :, -1] = 4
    carried = np.minimum(generator.integers(0, 3, (f, n)).cumsum(0) // 8 % 4, 3)
    return Frames(
        cycles.astype(np.int64),
        place[0].astype(np.float32),
        place[1].astype(np.float32),
        turns.astype(np.float32),
        role,
        np.where(role == 0, carried, 0).astype(np.int8),
        (generator.uniform(size=(f, 3)) < 0.7).astype(np.int8),
        np.arange(1, n + 1, dtype=np.int64),
    )


def scene() -> Scene:
    around = np.linspace(0, 2 * np.pi, 7)[:-1] + np.pi / 6
    outline = 0.9 * np.array([np.cos(around), np.sin(around)]).T
    polygons = [Polygon(outline, "wall")]
    for angle, colour in zip(np.array([0, 2, 4]) * np.pi / 3, ("red", "green", "blue")):
        turn = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
        box = np.array([[0.78, -0.06], [0.90, -0.06], [0.90, 0.06], [0.78, 0.06]])
        polygons.append(Polygon(box @ turn.T, colour))
    return Scene(tuple(polygons), 0.035, ROLES, CYCLE_TIME)


def timeline(trial: Trial) -> Timeline:
    duration = float(trial.outcome["duration_s"])
    n = int(trial.outcome["robots"])
    changes = {int(e["robot"]): (e["cycle"] * CYCLE_TIME, int(e["value"])) for e in trial.events if e["kind"] == 0}
    spans = []
    for lane in range(n):
        start, role = changes.get(lane + 1, (duration, 0))
        spans += [Span(lane, 0.0, start, 0), Span(lane, start, duration, role)]
    counts = tuple(float(e["cycle"] * CYCLE_TIME) for e in trial.events if e["kind"] == 1)
    lanes = tuple(f"robot {i + 1}" for i in range(n))
    return Timeline(lanes, tuple(spans), ((60.0, "chain begun"), (190.0, "chain closed")), counts, duration)


RANDOM_WALK = System(
    name="random-walk",
    summary="Robots that walk at random; a stand-in for tests",
    parameters=Parameters,
    configure=configure,
    run=run,
    kinds=KINDS,
    targets=Targets(
        {"time_1_s": "1 sequence", "time_5_s": "5 sequences", "time_10_s": "10 sequences"},
        {
            "time_1_s": (30.0, 42.0, 60.0, 75.0, 110.0),
            "time_5_s": (180.0, 210.0, 260.0, 333.0, 420.0),
            "time_10_s": (410.0, 490.0, 560.0, float("inf"), float("inf")),
        },
        "5 invented runs",
        600.0,
    ),
    timeline=timeline,
)

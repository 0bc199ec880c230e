"""The state of a sequencing trial and how it begins."""

from typing import NamedTuple

import numpy as np

from formicarium.devices.booth import BOOTH, HALF, LIGHTS, placed
from formicarium.devices.coordinator import COORDINATOR
from formicarium.observers.referee import REFEREE
from formicarium.physics.records import records
from formicarium.physics.world import World, make_world
from formicarium.robots.records import COMMAND, LIGHT, QUEUE, READING, SILENCE
from formicarium.streams import generator, stream
from formicarium.systems.sequencing.arena import Arena, make_arena
from formicarium.systems.sequencing.log import CHAIN, MEMBER
from formicarium.systems.sequencing.memory import COLOURS, MEMORY, NEVER, State
from formicarium.systems.sequencing.parameters import SequencingParameters
from formicarium.trial.events import CLOCK, make_log
from formicarium.trial.setup import make_crew, random_places

BOOTH_CLEARANCE = 0.15  # m, no robot starts this near to the middle of a mouth (U42)
EVENTS_PER_ROBOT_CYCLE = 4  # room in the log for one look of 100 cycles when everything is logged


class SequencingState(NamedTuple):
    """Everything that a sequencing trial is made of. A copy of the arrays is a snapshot."""

    clock: np.recarray  # CLOCK (1,)
    world: World
    robots: np.recarray  # ROBOT (N,)
    readings: np.recarray  # READING (N,)
    memories: np.recarray  # MEMORY (N,)
    commands: np.recarray  # COMMAND (N,)
    booths: np.recarray  # BOOTH (m,)
    lights: np.recarray  # LIGHT (3 m,)
    coordinator: np.recarray  # COORDINATOR (1,)
    referee: np.recarray  # REFEREE (N,)
    members: np.recarray  # MEMBER (N,), what the chain monitor knows of each robot
    chain: np.recarray  # CHAIN (1,)
    queue: np.recarray  # QUEUE (N,), scratch
    events: np.recarray  # EVENT, scratch
    epuck: np.recarray  # tables of numbers, one record each
    booth_table: np.recarray
    behaviour: np.recarray
    swarm: np.recarray


def begin(
    parameters: SequencingParameters,
    seed: int,
    *,
    storage: np.ndarray | None = None,
    arena: Arena | None = None,
) -> SequencingState:
    """Return the state of trial ``seed`` before its first cycle.

    Drawn from the seed: places and headings, identities, which colour is at which booth, the correct order
    (TS-37). ``storage`` permutes the robots in memory, ``arena`` replaces the regular arena (both for tests).
    """
    p = parameters
    if arena is None:
        arena = make_arena(p.arena, p.booth.friction)
    mouths = np.array([placed(x, y, way, -HALF, 0.0) for x, y, way in arena.booths])
    count = p.swarm.robots
    places = random_places(count, arena.corners, mouths, BOOTH_CLEARANCE, seed)
    crew = make_crew(places, p.epuck, seed, p.swarm.failure_rate, p.physics.cycle_time, p.swarm.deaths, storage)
    world = make_world(
        crew.bodies,
        arena.segments,
        cycle_time=p.physics.cycle_time,
        substeps=p.physics.substeps,
        iterations=p.physics.iterations,
        reach=max(p.epuck.radio_range, p.epuck.camera_range) + 0.01,
    )
    booths, lights = make_booths(arena, p, seed)
    clock = records(CLOCK, 1)
    clock[0].last_cycle = round(p.swarm.time_cap / p.physics.cycle_time)
    logging = p.swarm.log_messages or p.swarm.log_states
    events = make_log(4096 + (100 * EVENTS_PER_ROBOT_CYCLE * count if logging else 20 * count))
    commands = records(COMMAND, count)
    commands.infrared = SILENCE
    return SequencingState(
        clock=clock,
        world=world,
        robots=crew.robots,
        readings=records(READING, count),
        memories=make_memories(crew.robots, seed),
        commands=commands,
        booths=booths,
        lights=lights,
        coordinator=make_coordinator(p, seed),
        referee=make_referee(count),
        members=records(MEMBER, count),
        chain=records(CHAIN, 1),
        queue=records(QUEUE, count),
        events=events,
        epuck=p.epuck.record(),
        booth_table=p.booth.record(),
        behaviour=p.behaviour.record(),
        swarm=p.swarm.record(),
    )


def make_memories(robots: np.recarray, seed: int) -> np.recarray:
    """Return the memories of newly switched-on robots: nothing heard, nothing seen, a random stream each."""
    memories = records(MEMORY, len(robots))
    for memory, robot in zip(memories, robots, strict=True):
        memory.draws = stream(seed, "decisions", int(robot.key))
        memory.state = State.WALK
        memory.exchange = SILENCE
        for name in (
            "inhibition_heard",
            "inhibition_ahead",
            "echo_heard",
            "chain_seen",
            "verdict_heard",
            "echo_until",
            "requested",
            "step_heard",
            "stranger_heard",
        ):
            memory[name] = NEVER
        for colour in range(COLOURS):
            memory.adverts[colour].heard = NEVER
    return memories


def make_booths(arena: Arena, p: SequencingParameters, seed: int) -> tuple[np.recarray, np.recarray]:
    """Return the booths, colours drawn from the seed, and their lights."""
    colours = generator(seed, "colours").permutation(np.arange(1, len(arena.booths) + 1))
    booths = records(BOOTH, len(arena.booths))
    lights = records(LIGHT, len(arena.booths) * len(LIGHTS))
    for k, (x, y, way) in enumerate(arena.booths):
        booth = booths[k]
        booth.x, booth.y, booth.cosine, booth.sine = x, y, np.cos(way), np.sin(way)
        booth.colour, booth.visitor = colours[k], -1
        booth.draws = stream(seed, "booth", k)
        for n, (u, v) in enumerate(LIGHTS):
            light = lights[k * len(LIGHTS) + n]
            light.x, light.y = placed(x, y, way, u, v)
            light.colour, light.key = colours[k], k * len(LIGHTS) + n
    return booths, lights


def make_coordinator(p: SequencingParameters, seed: int) -> np.recarray:
    """Return the experimenter's computer with the correct order drawn from the seed."""
    coordinator = records(COORDINATOR, 1)
    coordinator[0].tasks = p.arena.tasks
    coordinator[0].delayed = p.booth.delayed_feedback
    coordinator[0].order[: p.arena.tasks] = generator(seed, "order").permutation(np.arange(1, p.arena.tasks + 1))
    return coordinator


def make_referee(count: int) -> np.recarray:
    """Return the referee's sheet: every robot outside, nothing done."""
    referee = records(REFEREE, count)
    referee.booth = -1
    return referee

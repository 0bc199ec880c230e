"""The state of a swarm's trial and how it begins."""

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np

from formicarium.devices.booth import BOOTH, HALF, LIGHTS, placed
from formicarium.physics.records import records
from formicarium.physics.world import World, make_world
from formicarium.robots.all_senses import READING
from formicarium.robots.forager import LAMP
from formicarium.robots.records import COMMAND, LIGHT, QUEUE, SILENCE, Colour
from formicarium.streams import generator, stream
from formicarium.trial.events import CLOCK, make_log
from formicarium.trial.setup import APART, PLACING_ATTEMPTS, WALL_MARGIN, NoRoom, make_crew
from formicarium.trial.swarm.arena import Arena
from formicarium.trial.swarm.castes import Caste, castes_by_key, embody

EVENTS_PER_LOOK = 400  # room in the log for each robot in one look of 100 cycles
BOOTH_CLEARANCE = 0.15  # m, no robot starts this near to the middle of a mouth
UNSEEN = -1

# What the package's observer knows of each robot.
SEEN = np.dtype([("role", "i8")], align=True)
# The first command that was no number: it ends the trial.
TROUBLE = np.dtype([("robot", "i8"), ("cycle", "i8")], align=True)  # robot: identity, 0 while there is none
NOTHING = np.dtype([("unused", "i8")], align=True)


class SwarmState(NamedTuple):
    """Everything that a trial is made of. A copy of the arrays is a snapshot."""

    clock: np.recarray  # CLOCK (1,)
    world: World
    robots: np.recarray  # ROBOT (N,)
    castes: np.ndarray  # (N,): place of each robot's table in epuck; all 0 in a swarm of one caste
    readings: np.recarray  # READING of all senses (N,)
    memories: np.recarray  # the system's MEMORY (N,)
    commands: np.recarray  # COMMAND (N,)
    booths: np.recarray  # BOOTH (B,)
    lights: np.recarray  # LIGHT (3 B,), of the booths
    lamps: np.recarray  # LAMP (L,)
    floor: np.recarray  # PATCH (P,)
    seen: np.recarray  # SEEN (N,), the package's observer's
    notes: np.recarray  # the system's NOTES (N,), its observer's
    trouble: np.recarray  # TROUBLE (1,)
    seed: np.ndarray  # (1,)
    queue: np.recarray  # QUEUE (N,), scratch
    events: np.recarray  # EVENT, scratch
    epuck: np.recarray  # tables of numbers, one record each; here one a caste
    sight: np.recarray
    behaviour: np.recarray
    swarm: np.recarray


def begin_swarm(
    parameters: Any,
    seed: int,
    arena: Arena,
    memory: np.dtype,
    notes: np.dtype | None = None,
    storage: np.ndarray | None = None,
    castes: Sequence[Caste] = (),
) -> SwarmState:
    """Return the state of trial ``seed`` before its first cycle.

    Drawn from the seed: places and headings, identities, times of death. A robot's memory is zero but for a field
    ``draws``, the start of its own random stream, and a field ``caste``, the number of its caste.

    Args:
        parameters: SwarmParameters with a group ``behaviour``.
        seed: decides everything that is random.
        arena: what stands still.
        memory: layout of a robot's memory.
        notes: layout of what the system's observer keeps of each robot.
        storage: permutation of the robots in memory, for tests.
        castes: of the robots; one caste with the numbers of the parameters' group ``epuck`` if empty.

    Raises:
        NoRoom: if the robots do not fit.
        ValueError: if the castes are not as many robots as there are.
    """
    p = parameters
    count = p.swarm.robots
    castes = castes or (Caste(count, p.epuck),)
    by_key = castes_by_key(castes, count)
    places = free_places(count, arena, seed)
    crew = make_crew(places, p.epuck, seed, p.swarm.failure_rate, p.swarm.cycle_time, p.swarm.deaths, storage)
    numbers = by_key[crew.robots.key]
    embody(crew.bodies, numbers, castes)
    world = make_world(
        crew.bodies,
        arena.segments(),
        cycle_time=p.swarm.cycle_time,
        reach=max(max(caste.epuck.radio_range, caste.epuck.camera_range) for caste in castes) + 0.01,
    )
    clock = records(CLOCK, 1)
    clock[0].last_cycle = round(p.swarm.time_cap / p.swarm.cycle_time)
    commands, seen = records(COMMAND, count), records(SEEN, count)
    commands.infrared, seen.role = SILENCE, UNSEEN
    memories = records(memory, count)
    if "draws" in (memory.names or ()):
        memories.draws = [stream(seed, "decisions", int(key)) for key in crew.robots.key]
    if "caste" in (memory.names or ()):
        memories.caste = numbers
    booths, lights = make_booths(arena)
    return SwarmState(
        clock=clock,
        world=world,
        robots=crew.robots,
        castes=numbers,
        readings=records(READING, count),
        memories=memories,
        commands=commands,
        booths=booths,
        lights=lights,
        lamps=make_lamps(arena),
        floor=arena.patches(),
        seen=seen,
        notes=records(NOTHING if notes is None else notes, count),
        trouble=records(TROUBLE, 1),
        seed=np.array([seed], "i8"),
        queue=records(QUEUE, count),
        events=make_log(4096 + EVENTS_PER_LOOK * count),
        epuck=np.concatenate([caste.epuck.record() for caste in castes]).view(np.recarray),
        sight=p.sight.record(),
        behaviour=p.behaviour.record(),
        swarm=p.swarm.record(),
    )


def make_booths(arena: Arena) -> tuple[np.recarray, np.recarray]:
    """Return the arena's booths and their lights."""
    booths = records(BOOTH, len(arena.booth))
    lights = records(LIGHT, len(arena.booth) * len(LIGHTS))
    for k, (x, y, way) in enumerate(arena.booths):
        booth = booths[k]
        booth.x, booth.y, booth.cosine, booth.sine = x, y, np.cos(way), np.sin(way)
        booth.colour, booth.visitor = Colour[arena.booth[k].colour.upper()], -1
        for n, (u, v) in enumerate(LIGHTS):
            light = lights[k * len(LIGHTS) + n]
            light.x, light.y = placed(x, y, way, u, v)
            light.colour, light.key = booth.colour, k * len(LIGHTS) + n
    return booths, lights


def make_lamps(arena: Arena) -> np.recarray:
    """Return the arena's lamps."""
    lamps = records(LAMP, len(arena.lamp))
    for lamp, drawn in zip(lamps, arena.lamp, strict=True):
        lamp.x, lamp.y, lamp.intensity = *drawn.at, drawn.reach
    return lamps


def free_places(count: int, arena: Arena, seed: int) -> np.ndarray:
    """Return (count, 3) uniform places and headings off walls, obstacles, mouths of booths and each other.

    Raises:
        NoRoom: if they do not fit.
    """
    draws = generator(seed, "layout")
    corners = np.array(arena.outline)
    low, high = corners.min(axis=0), corners.max(axis=0)
    if arena.start is not None:
        low, high = np.array(arena.start[:2]), np.array(arena.start[2:])
    segments = arena.segments()
    mouths = [placed(x, y, way, -HALF, 0.0) for x, y, way in arena.booths]
    places: list[tuple[float, float, float]] = []
    for _ in range(PLACING_ATTEMPTS):
        if len(places) == count:
            break
        x, y = draws.uniform(low, high)
        taken = any((x - a) ** 2 + (y - b) ** 2 < APART**2 for a, b, _ in places)
        taken = taken or any((x - a) ** 2 + (y - b) ** 2 < BOOTH_CLEARANCE**2 for a, b in mouths)
        if not taken and is_free(segments, x, y):
            places.append((float(x), float(y), draws.uniform(-np.pi, np.pi)))
    if len(places) < count:
        raise NoRoom(f"{count} robots do not fit into the arena: there is room for about {len(places)}")
    return np.array(places).reshape(count, 3)


def is_free(segments: np.recarray, x: float, y: float) -> bool:
    """Tell whether a robot can start at (x, y): inside the arena, outside every solid, off all walls."""
    ax, ay, bx, by = (np.asarray(segments[name]) for name in ("ax", "ay", "bx", "by"))
    along = np.clip(((x - ax) * (bx - ax) + (y - ay) * (by - ay)) / ((bx - ax) ** 2 + (by - ay) ** 2), 0.0, 1.0)
    if ((ax + along * (bx - ax) - x) ** 2 + (ay + along * (by - ay) - y) ** 2).min() < WALL_MARGIN**2:
        return False
    with np.errstate(divide="ignore", invalid="ignore"):
        crossed = ((ay > y) != (by > y)) & (x < ax + (y - ay) / (by - ay) * (bx - ax))
    odd = (
        np.bincount(segments.group, weights=crossed).astype(int) % 2
    )  # a ray leaves a closed line an odd number of times
    return bool(odd[0] == 1 and not odd[1:].any())

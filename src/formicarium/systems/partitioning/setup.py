"""The state of a partitioning trial and how it begins."""

import math
from typing import NamedTuple

import numpy as np

from formicarium.devices.booth import BAY_END, BAY_HALF_WIDTH, HALF, placed
from formicarium.devices.cache_pair import PAIR
from formicarium.devices.depot import DEPOT, INTERFACING
from formicarium.observers.objects import VISIT
from formicarium.physics.records import records
from formicarium.physics.world import World, make_world
from formicarium.robots.forager import COMMAND, GRIP, LAMP, NICHE_LIGHT, READING, VOICE
from formicarium.robots.records import Colour
from formicarium.streams import generator, stream, uniform
from formicarium.systems.partitioning.arena import Arena, Box, make_arena, shades_of, total_width
from formicarium.systems.partitioning.measures import SEEN
from formicarium.systems.partitioning.memory import CHART, MEMORY, NEVER, Ground
from formicarium.systems.partitioning.parameters import PartitioningParameters
from formicarium.trial.events import CLOCK, make_log
from formicarium.trial.setup import APART, PLACING_ATTEMPTS, WALL_MARGIN, NoRoom, make_crew

EVENTS_PER_LOOK = 100  # room in the log for each robot and each booth in one look of 100 cycles
LIGHT_OFF_WALL = 0.004  # m, from the bay's back wall, which would hide it otherwise
LEAST_REACH = 0.3  # m, of the neighbour lists, however short the camera's range
NO_SHADE = 1e9  # of parts of the floor that are not there
BEHIND_LAMP = 0.866  # cosine: the lamp lies so far behind at the end of the corridor's bottom
INTO_LEG = 0.09  # m, from a leg's inner wall to where that cosine is read, on the path
SUBSTEPS = 10  # physics steps in a cycle, with contact dynamics [model]


class PartitioningState(NamedTuple):
    """Everything that a partitioning trial is made of. A copy of the arrays is a snapshot."""

    clock: np.recarray  # CLOCK (1,)
    world: World
    robots: np.recarray  # ROBOT (N,)
    readings: np.recarray  # READING (N,)
    memories: np.recarray  # MEMORY (N,)
    commands: np.recarray  # COMMAND (N,)
    grips: np.recarray  # GRIP (N,)
    voices: np.recarray  # VOICE (N,)
    depots: np.recarray  # DEPOT (B,)
    pairs: np.recarray  # PAIR (c,)
    lights: np.recarray  # NICHE_LIGHT (B,), one a booth
    floor: np.recarray  # PATCH
    lamp: np.recarray  # LAMP (1,)
    visits: np.recarray  # VISIT (B,), the observer's
    seen: np.recarray  # SEEN (N,), the observer's
    events: np.recarray  # EVENT, scratch
    epuck: np.recarray  # tables of numbers, one record each
    sight: np.recarray
    interfacing: np.recarray
    behaviour: np.recarray
    strategy: np.recarray
    chart: np.recarray
    swarm: np.recarray


def begin(
    parameters: PartitioningParameters,
    seed: int,
    *,
    storage: np.ndarray | None = None,
    arena: Arena | None = None,
) -> PartitioningState:
    """Return the state of trial ``seed`` before its first cycle.

    Drawn from the seed: places and headings, identities, first estimates (TP-26, TP-66). ``storage`` permutes the
    robots in memory, ``arena`` replaces the arena of the parameters (both for tests).
    """
    p = parameters
    if arena is None:
        arena = make_arena(p.arena)
    count = p.swarm.robots
    places = start_places(arena, count, seed)
    crew = make_crew(places, p.epuck, seed, p.swarm.failure_rate, p.swarm.cycle_time, (), storage)
    world = make_world(
        crew.bodies,
        arena.segments,
        cycle_time=p.swarm.cycle_time,
        substeps=SUBSTEPS,
        reach=max(p.sight.range, LEAST_REACH) + 0.01,
    )
    clock = records(CLOCK, 1)
    clock[0].last_cycle = round(p.swarm.time_cap / p.swarm.cycle_time)
    depots, lights = make_depots(arena)
    lamp = records(LAMP, 1)
    lamp[0].x, lamp[0].y, lamp[0].intensity = *arena.lamp, p.arena.lamp_intensity
    return PartitioningState(
        clock=clock,
        world=world,
        robots=crew.robots,
        readings=records(READING, count),
        memories=make_memories(crew.robots, p, seed),
        commands=records(COMMAND, count),
        grips=records(GRIP, count),
        voices=records(VOICE, count),
        depots=depots,
        pairs=records(PAIR, p.arena.cache_pairs * (p.arena.subtasks - 1)),
        lights=lights,
        floor=arena.floor,
        lamp=lamp,
        visits=records(VISIT, len(depots)),
        seen=make_seen(count),
        events=make_log(EVENTS_PER_LOOK * (count + len(depots))),
        epuck=p.epuck.record(),
        sight=p.sight.record(),
        interfacing=make_interfacing(p),
        behaviour=p.behaviour.record(),
        strategy=p.strategy.record(),
        chart=make_chart(p, arena),
        swarm=p.swarm.record(),
    )


def make_seen(count: int) -> np.recarray:
    """Return the observer's sheet: no role seen yet."""
    seen = records(SEEN, count)
    seen.role = -1
    return seen


def start_places(arena: Arena, count: int, seed: int) -> np.ndarray:
    """Return (N, 3) places and headings: half of the robots in the nest area, the odd one in the source area.

    With three areas a third is in each, what is left over in the source area.

    Raises:
        NoRoom: if they do not fit.
    """
    draws = generator(seed, "layout")
    places: list[tuple[float, float, float]] = []
    areas = [arena.source_area, arena.nest_area]
    if arena.middle_area is not None:
        areas.append(arena.middle_area)
    share = count // len(areas)
    for number, area in zip((count - share * (len(areas) - 1), share, share), areas, strict=False):
        wanted = len(places) + number
        for _ in range(PLACING_ATTEMPTS):
            if len(places) == wanted:
                break
            x, y = place_in(draws, area)
            if all((x - a) ** 2 + (y - b) ** 2 >= APART**2 for a, b, _ in places):
                places.append((x, y, draws.uniform(-math.pi, math.pi)))
        if len(places) < wanted:
            raise NoRoom(f"{number} robots do not fit into one area")
    return np.array(places).reshape(count, 3)


def place_in(draws: np.random.Generator, area: Box) -> tuple[float, float]:
    """Return a uniform place in an area, off its walls."""
    left, bottom, right, top = area
    low, high = (left + WALL_MARGIN, bottom + WALL_MARGIN), (right - WALL_MARGIN, top - WALL_MARGIN)
    x, y = draws.uniform(low, high)
    return float(x), float(y)


def make_memories(robots: np.recarray, p: PartitioningParameters, seed: int) -> np.recarray:
    """Return the memories of newly switched-on robots: three streams and three first estimates each."""
    memories = records(MEMORY, len(robots))
    low, span = p.strategy.estimate_least, p.strategy.estimate_most - p.strategy.estimate_least
    for memory, robot in zip(memories, robots, strict=True):
        key = int(robot.key)
        memory.walks = stream(seed, "walks", key)
        memory.choices = stream(seed, "decisions", key)
        memory.patience = stream(seed, "patience", key)
        memory.harvest = low + span * uniform(stream(seed, "estimate of harvesting", key))
        memory.store = low + span * uniform(stream(seed, "estimate of storing", key))
        if p.arena.subtasks == 3:
            memory.middle = low + span * uniform(stream(seed, "estimate of the middle", key))
        if p.strategy.hierarchical:
            memory.ways[:] = first_ways(memory.middle, low, span, seed, key)
        memory.whole = 2.0 * (low + span * uniform(stream(seed, "estimate of the whole", key)))
        memory.look_side = 1.0
        memory.ground = -1
        memory.measured_at[:] = NEVER
        memory.stay = -1.0
        for name in ("timer", "deed_cycle", "path_seen", "swerve_until", "escape_until", "roam_until", "target_seen"):
            memory[name] = NEVER
    return memories


def first_ways(middle: float, low: float, span: float, seed: int, key: int) -> list[float]:
    """Return the first guesses (s) of the ways of a tree of tasks, there and back alike.

    Between the caches half of a sub-task's; past one cache, which is two sub-tasks, half of twice as much.
    """
    past_first = low + span * uniform(stream(seed, "estimate of the first two", key))
    past_second = low + span * uniform(stream(seed, "estimate of the last two", key))
    return [past_first, past_first, past_second, past_second, 0.5 * middle, 0.5 * middle]


def make_depots(arena: Arena) -> tuple[np.recarray, np.recarray]:
    """Return the booths and their lights, at the bottom of their bays."""
    depots = records(DEPOT, len(arena.booths))
    lights = records(NICHE_LIGHT, len(arena.booths))
    for k, (x, y, way) in enumerate(arena.booths):
        depot, light = depots[k], lights[k]
        depot.x, depot.y, depot.cosine, depot.sine = x, y, math.cos(way), math.sin(way)
        depot.place, depot.pair, depot.visitor = arena.places[k], arena.pairs[k], -1
        depot.cache = arena.caches[k]
        light.x, light.y = placed(x, y, way, BAY_END - LIGHT_OFF_WALL, 0.0)
        light.cosine, light.sine, light.key = depot.cosine, depot.sine, k
        light.depth, light.half_width = BAY_END - LIGHT_OFF_WALL + HALF, BAY_HALF_WIDTH
        light.colour = Colour.OFF
    return depots, lights


def make_interfacing(p: PartitioningParameters) -> np.recarray:
    """Return the interfacing times of each cache, of both sides, before and after the switch."""
    caches, extra = records(INTERFACING, p.arena.subtasks - 1), p.cache.taking_extra
    for number, cache in enumerate(caches):
        before, after = (
            time + number * p.cache.second_extra for time in (p.cache.interfacing_time, p.cache.switched_time)
        )
        cache.give_time, cache.take_time = before, before + extra
        cache.switch_cycle = round(p.cache.switch_time / p.swarm.cycle_time) if p.cache.switch_time >= 0 else -1
        cache.switched_give_time, cache.switched_take_time = after, after + extra
    return caches


def make_chart(p: PartitioningParameters, arena: Arena) -> np.recarray:
    """Return what robots are told of the arena: shades, and where the lamp is seen from areas and zones."""
    chart = records(CHART, 1)
    t, width = p.arena, total_width(p.arena)
    chart[0].shades[:] = NO_SHADE
    for ground, shade in shades_of(t).items():
        chart[0].shades[ground] = shade
    left, bottom, right, top = arena.source_area
    y = 0.5 * (bottom + top)
    across = {Ground.SOURCE_AREA: 0.5 * (left + right - t.zone_depth), Ground.DROP_ZONE: right - 0.5 * t.zone_depth}
    if arena.middle_area is not None:
        left, _, right, _ = arena.middle_area
        across[Ground.MIDDLE_PICK_ZONE] = left + 0.5 * t.zone_depth
        across[Ground.MIDDLE_AREA] = 0.5 * (left + right)
        across[Ground.MIDDLE_DROP_ZONE] = right - 0.5 * t.zone_depth
    for ground, x in across.items():
        chart[0].lamps[ground] = math.atan2(arena.lamp[1] - y, arena.lamp[0] - x)
    chart[0].lamps[Ground.NEST_AREA] = -math.pi - chart[0].lamps[Ground.SOURCE_AREA]
    chart[0].lamps[Ground.PICK_ZONE] = -math.pi - chart[0].lamps[Ground.DROP_ZONE]
    chart[0].lamp_behind = BEHIND_LAMP
    if t.subtasks == 3:
        away = 0.5 * width - t.leg_width + INTO_LEG
        chart[0].lamp_behind = away / math.sqrt(away**2 + (0.5 * t.bottom_width) ** 2)
    chart[0].subtasks = t.subtasks
    chart[0].cycle_time = p.swarm.cycle_time
    return chart

"""The state of a coverage trial and how it begins."""

import math
from typing import NamedTuple

import numpy as np

from formicarium.observers.graphs import CONNECTION, GRAPHS, PLACE
from formicarium.observers.prominences import AXIS, TARGETS
from formicarium.physics.records import records
from formicarium.physics.world import World, make_world
from formicarium.robots.footbot import CHASSIS, COMMAND, IDENTITIES, READING
from formicarium.streams import generator, stream
from formicarium.systems.coverage.arena import Arena, make_arena, start_half_side
from formicarium.systems.coverage.credit import TASK_SEEN
from formicarium.systems.coverage.failures import make_failures
from formicarium.systems.coverage.formation import write_formation
from formicarium.systems.coverage.measures import SEEN, SURVEY
from formicarium.systems.coverage.memory import CHART, MEMORY, NEVER
from formicarium.systems.coverage.parameters import PROGRAMMES, CoverageParameters
from formicarium.trial.events import CLOCK, make_log
from formicarium.trial.setup import PLACING_ATTEMPTS, NoRoom, make_crew
from formicarium.trial.situated import look

EVENTS_PER_LOOK = 130  # room in the log for each robot in one look of 100 cycles
ROOM = 1.02  # diameters between two robots at the start
MARGIN = 15.0  # m, the grids reach so far beyond the start
# The files' first three robots: x, y (m) and heading (degrees); the first, the master, stands at the origin (ST-44).
FILES = ((-0.25, 0.2, 180.0), (1.0, 1.0, 90.0), (1.0, -1.2, 15.0))
FILES_SD = math.radians(360.0)  # of the others' headings
TABLE_TARGETS = tuple(k * math.sqrt(2.0) for k in (2, 3, 5, 10, 15))  # m, of Table I


class CoverageState(NamedTuple):
    """Everything that a coverage trial is made of. A copy of the arrays is a snapshot."""

    clock: np.recarray  # CLOCK (1,)
    world: World
    robots: np.recarray  # ROBOT (N,); the master's key is 0
    chassis: np.recarray  # CHASSIS (N,)
    readings: np.recarray  # READING (N,)
    memories: np.recarray  # MEMORY (N,)
    commands: np.recarray  # COMMAND (N,)
    charts: np.recarray  # CHART (N,); only the master's tells of tasks
    beacons: np.recarray  # BEACON (T,)
    failures: np.recarray  # FAILURE (k,), still to come and past
    sight: np.ndarray  # (N, N): 1 if within range and no body between
    heard: np.ndarray  # (N, N): cycle at which i last heard j
    links: np.ndarray  # (N, N - 1): in which graphs body i and its n-th neighbour are linked, the observers'
    connections: np.recarray  # CONNECTION (3,), the observers'
    places: np.recarray  # PLACE (N,), the observers'
    axes: np.recarray  # AXIS (T,), the observers'
    tasks: np.recarray  # TASK_SEEN (T,), the observers'
    survey: np.recarray  # SURVEY (1,), the observers'
    seen: np.recarray  # SEEN (N,), the observers'
    laplacian: np.ndarray  # (N, N) scratch of the observers
    rows: np.ndarray  # (4, N) scratch
    entry_of: np.ndarray  # (IDENTITIES,) scratch: place of a robot's bearing in a message, and one more; 0: none
    events: np.recarray  # EVENT, scratch
    footbot: np.recarray  # tables of numbers, one record each
    behaviour: np.recarray


def begin(
    parameters: CoverageParameters,
    seed: int,
    *,
    storage: np.ndarray | None = None,
    places: np.ndarray | None = None,
    arena: Arena | None = None,
) -> CoverageState:
    """Return the state of trial ``seed`` before its first cycle.

    Drawn from the seed: places and headings, identities, random tasks, errors of the drives. ``storage`` permutes the
    robots in memory; ``places`` (N, 3), the master's first, and ``arena`` replace those drawn (all for tests).
    """
    p = parameters
    count = p.swarm.robots
    arena = make_arena(p, seed) if arena is None else arena
    if places is None:
        places = start_places(p, seed)
    crew = make_crew(places, p.footbot, seed, p.swarm.failure_rate, p.swarm.cycle_time, (), storage)
    world = make_world(
        crew.bodies,
        cycle_time=p.swarm.cycle_time,
        reach=max(p.footbot.radio_range + 0.01, 2.0 * p.footbot.radius + 0.2),
        margin=MARGIN,
    )
    clock = records(CLOCK, 1)
    clock[0].last_cycle = round(p.swarm.time_cap / p.swarm.cycle_time)
    charts = make_charts(crew.robots, p, arena)
    state = CoverageState(
        clock=clock,
        world=world,
        robots=crew.robots,
        chassis=make_chassis(crew.robots, p, seed),
        readings=records(READING, count),
        memories=make_memories(crew.robots, charts, p, seed),
        commands=records(COMMAND, count),
        charts=charts,
        beacons=arena.beacons.copy(),
        failures=make_failures(p, seed),
        sight=np.zeros((count, count), np.int64),
        heard=np.full((count, count), NEVER, np.int64),
        links=np.zeros((count, max(1, count - 1)), np.int64),
        connections=make_connections(),
        places=records(PLACE, count),
        axes=make_axes(arena),
        tasks=make_tasks(p, len(arena.beacons)),
        survey=make_survey(p, crew.robots),
        seen=make_seen(count),
        laplacian=np.zeros((count, count)),
        rows=np.zeros((4, count)),
        entry_of=np.zeros(IDENTITIES, np.int64),
        events=make_log(EVENTS_PER_LOOK * count),
        footbot=p.footbot.record(),
        behaviour=p.behaviour.record(),
    )
    look(state)
    return state


def start_places(p: CoverageParameters, seed: int) -> np.ndarray:
    """Return (N, 3) places and headings, the master's first: at the origin, heading along x.

    Raises:
        NoRoom: if they do not fit.
    """
    draws = generator(seed, "layout")
    half, apart = start_half_side(p), ROOM * 2.0 * p.footbot.radius
    places = [(0.0, 0.0, 0.0)]
    if p.swarm.start == "files":
        places += [(x, y, math.radians(degrees)) for x, y, degrees in FILES][: p.swarm.robots - 1]
    for _ in range(PLACING_ATTEMPTS):
        if len(places) == p.swarm.robots:
            break
        x, y = draws.uniform(-half, half, 2)
        if all((x - a) ** 2 + (y - b) ** 2 >= apart**2 for a, b, _ in places):
            places.append((x, y, draws.normal(0.0, FILES_SD)))
    if len(places) < p.swarm.robots:
        raise NoRoom(
            f"{p.swarm.robots} robots do not fit into the start square of {2 * half:.2f} m: there is room for about "
            f"{len(places)}. Make swarm.half_side larger or swarm.crowd smaller"
        )
    jitter = generator(seed, "start").uniform(-1e-6, 1e-6, (len(places), 3))
    return np.array(places) + jitter


def make_chassis(robots: np.recarray, p: CoverageParameters, seed: int) -> np.recarray:
    """Return the drives with their constant errors, each robot's own."""
    chassis = records(CHASSIS, len(robots))
    errors = generator(seed, "drives").normal(0.0, 1.0, (len(robots), 3))
    for own, robot in zip(chassis, robots, strict=True):
        left, path, turn = errors[robot.key]
        own.left_error = p.footbot.wheel_bias * left
        own.path_error, own.turn_error = p.footbot.odometry_drift * path, p.footbot.odometry_drift * turn
    return chassis


def make_memories(robots: np.recarray, charts: np.recarray, p: CoverageParameters, seed: int) -> np.recarray:
    """Return the memories of newly switched-on robots; the first is the master, with the plan of its chart in hand."""
    memories = records(MEMORY, len(robots))
    for memory, robot, chart in zip(memories, robots, charts, strict=True):
        memory.draws = stream(seed, "decisions", int(robot.key))
        memory.master = robot.key == 0
        memory.gradient = math.inf
        for name in ("parent_heard", "linked_at", "reference_heard", "corrected", "all_heard"):
            memory[name] = NEVER
        memory.reference_place = -1
        memory.slots, memory.slot_count = chart.slots, chart.slot_count
        if p.behaviour.silence_cycles > 0:
            memory.term = memory.office = 1
            memory.leader = robot.identity if memory.master else 0
            memory.placed = memory.master
    return memories


def make_charts(robots: np.recarray, p: CoverageParameters, arena: Arena) -> np.recarray:
    """Return what robots are told: all how many they are, the master of tasks and programme besides.

    Where another may follow the master, all are told the same.
    """
    charts = records(CHART, len(robots))
    t, cycle_time = p.tasks, p.swarm.cycle_time
    charts.robots, charts.stop, charts.cycle_time = p.swarm.robots, int(t.stop), cycle_time
    for chart, robot in zip(charts, robots, strict=True):
        write_formation(chart.formation, p.formation, cycle_time)
        if robot.key != 0 and p.behaviour.silence_cycles == 0:
            continue
        chart.programme = PROGRAMMES.index(t.programme)
        chart.slot_count = len(arena.sites)
        for number in range(len(arena.sites)):
            write_slot(chart.slots[number], p, arena, number)
        chart.attempts = t.attempts
        chart.erupt_cycles = round(t.erupt_limit / cycle_time)
        chart.gather_cycles = round(t.gather_limit / cycle_time)
        chart.correction_limit = round(p.behaviour.correction_limit / cycle_time)
        if p.behaviour.silence_cycles > 0 or p.mission.replans > 0:
            write_tasks(chart, p)
    return charts


def write_tasks(chart: np.record, p: CoverageParameters) -> None:
    """Write what a robot needs to know of the map to see what is left of it, and to plan it anew."""
    m = p.mission
    chart.replans, chart.planning_range, chart.paths = m.replans, m.planning_range, m.paths
    xs, ys = ([getattr(place, axis) for place in (*m.tasks, *m.slots)] for axis in ("x", "y"))
    chart.region[:] = m.region or (min(0.0, *xs), min(0.0, *ys), max(0.0, *xs), max(0.0, *ys))
    names = [task.name for task in m.tasks]
    chart.task_count = len(names)
    for charted, task in zip(chart.tasks, m.tasks, strict=False):
        charted.ahead, charted.aside = task.x, task.y
        charted.cycles = max(1, round(task.duration / p.swarm.cycle_time))
        charted.after = sum(1 << names.index(earlier) for earlier in set(task.after))


def write_slot(slot: np.record, p: CoverageParameters, arena: Arena, number: int) -> None:
    """Write what the master is told of one slot; without a plan arms are wanted by the distances of their tasks."""
    site, t = arena.sites[number], p.tasks
    planned = p.mission.slots[number] if p.mission.slots else None
    slot.point_ahead, slot.point_aside = site.point
    slot.travel = int(planned is not None or (t.programme == "tour" and t.travel > 0.0))
    slot.task_count = len(site.tasks)
    for k, beacon in enumerate(arena.beacons[site.tasks.start : site.tasks.stop]):
        slot.task[k], slot.task_ahead[k], slot.task_aside[k] = beacon.task, beacon.x, beacon.y
        distance = math.hypot(beacon.x - site.point[0], beacon.y - site.point[1])
        slot.wanted[k] = planned.tasks[k].robots if planned else distance
    slot.hold_cycles = round((planned.duration if planned else t.hold_time) / p.swarm.cycle_time)
    slot.hold_limit = round(t.erupt_limit / p.swarm.cycle_time) + (slot.hold_cycles if planned else 0)


def make_connections() -> np.recarray:
    """Return the observers' sheets for the three graphs."""
    connections = records(CONNECTION, GRAPHS)
    connections.lost_since = connections.first_loss = -1
    return connections


def make_axes(arena: Arena) -> np.recarray:
    """Return the arms' axes, from the point of deployment through the tasks, with Table I's distances as targets."""
    axes = records(AXIS, len(arena.beacons))
    points = [site.point for site in arena.sites for _ in site.tasks]
    for axis, beacon, point in zip(axes, arena.beacons, points, strict=True):
        dx, dy = beacon.x - point[0], beacon.y - point[1]
        length = math.hypot(dx, dy)
        axis.x, axis.y = point
        axis.cosine, axis.sine = (dx / length, dy / length) if length > 0.0 else (1.0, 0.0)
        axis.target[:] = (*TABLE_TARGETS, length)[:TARGETS]
        axis.since[:] = axis.first[:] = -1
        axis.longest_at = -1
    return axes


def make_tasks(p: CoverageParameters, count: int) -> np.recarray:
    """Return the observers' sheets for the tasks, with the work that a plan wants."""
    tasks = records(TASK_SEEN, count)
    tasks.done_at = -1
    for sheet, planned in zip(tasks, p.mission.tasks):
        sheet.needed = max(1, round(planned.duration / p.swarm.cycle_time))
    return tasks


def make_survey(p: CoverageParameters, robots: np.recarray) -> np.recarray:
    """Return the observers' sheet for the whole swarm."""
    survey = records(SURVEY, 1)
    survey[0].master = int(np.flatnonzero(robots.key == 0)[0])
    survey[0].structure_every = max(1, round(p.observer.structure_every / p.swarm.cycle_time))
    survey[0].spectrum_every = max(1, round(p.observer.spectrum_every / p.swarm.cycle_time))
    survey[0].least_lambda = math.inf
    return survey


def make_seen(count: int) -> np.recarray:
    """Return the observers' sheets for single robots: nothing seen yet."""
    seen = records(SEEN, count)
    seen.role = -1
    return seen

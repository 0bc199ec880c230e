"""A System out of the few things that only its writer knows: parameters, arena, memory, loop, kinds, outcome.

Everything else follows: how a trial begins and is run, its frames, timeline and scene, how it is shown and touched.
A memory may have fields with a meaning for everybody: ``role`` (number of a role, shown in colours), ``carried`` (a
small number, written on the robot) and ``draws`` (the robot's own random stream).
"""

import json
import sys
from collections.abc import Callable, Mapping, Sequence
from enum import IntEnum
from typing import Any, NamedTuple

import numpy as np
from pydantic import BaseModel

from formicarium.campaigns.errors import Explained
from formicarium.physics.floor import corners
from formicarium.systems.diagnosis import explain
from formicarium.systems.registry import System, Targets
from formicarium.trial.film import Film, shoot_robots
from formicarium.trial.onboard import Onboard
from formicarium.trial.record import FLOOR, Polygon, Scene, Span, Timeline, Trial
from formicarium.trial.showing import byte, colour, degrees, fields, metres, reading_sections, said
from formicarium.trial.simulate import Album, simulate
from formicarium.trial.swarm import castes as of_castes
from formicarium.trial.swarm import phases as of_one_caste
from formicarium.trial.swarm.arena import Arena, read_arena
from formicarium.trial.swarm.castes import Caste
from formicarium.trial.swarm.guard import guarded
from formicarium.trial.swarm.parameters import configuring
from formicarium.trial.swarm.phases import DIED, ROLE, move, serve
from formicarium.trial.swarm.state import SwarmState, begin_swarm
from formicarium.trial.touching import touch_robot
from formicarium.trial.watching import Impossible, Inspection, Intervention, Section, Watching

LAMP_SHAPE = 0.03 * np.array([(-1, 0), (0, -1), (1, 0), (0, 1)])  # m, how a lamp is drawn
EXPLAIN = (
    "import json, sys; sys.path[:] = json.loads(sys.argv[1]); from formicarium.systems.diagnosis import explain; "
    "print(explain(sys.argv[2], sys.argv[3], int(sys.argv[4]), int(sys.argv[5]), sys.argv[6]))"
)
Outcome = Callable[[Any, SwarmState, np.ndarray], Mapping[str, Any]]


class Swarm(NamedTuple):
    """What only the writer of a system knows."""

    name: str  # as it is announced
    summary: str  # one line
    parameters: type[BaseModel]  # SwarmParameters with groups arena and behaviour
    arena: Callable[[Any], Arena]  # parameters -> what stands still, unless a file says it
    memory: np.dtype  # of one robot
    loop: Callable[[SwarmState, int], None]  # the compiled main loop
    outcome: Outcome  # (parameters, state, events) -> row; "duration_s" and "robots" are added
    kinds: type[IntEnum]  # of events, ROLE and DIED first
    roles: type[IntEnum]  # what memory.role numbers
    notes: np.dtype | None = None  # what the observer keeps of one robot
    times: Mapping[str, str] = {}  # column of the row with a run time -> its label
    prepare: Callable[[SwarmState, Any, int], None] | None = None  # (state, parameters, seed) before the first cycle
    settings: Mapping[int, Mapping[str, Mapping[str, Any]]] = {}  # number -> group -> number -> value
    # (parameters) -> the robots' castes; the loop takes sense and act from trial.swarm.castes then
    castes: Callable[[Any], Sequence[Caste]] | None = None
    # For controllers in processes of their own: decide(reading, memory, command, behaviour, epuck, cycle_time)
    # and note(state), both as the loop calls them.
    decide: Callable[..., None] | None = None
    note: Callable[[SwarmState], None] | None = None


def assemble(swarm: Swarm) -> System:
    """Return the system that can be run, swept, watched, replayed and tested."""

    def begin(parameters: Any, seed: int, *, storage: np.ndarray | None = None) -> SwarmState:
        castes = swarm.castes(parameters) if swarm.castes is not None else ()
        state = begin_swarm(parameters, seed, arena_of(parameters), swarm.memory, swarm.notes, storage, castes)
        if swarm.prepare is not None:
            swarm.prepare(state, parameters, seed)
        return state

    def arena_of(parameters: Any) -> Arena:
        plan = getattr(parameters.arena, "plan", "")
        return read_arena(plan) if plan else swarm.arena(parameters)

    def scene(parameters: Any, state: SwarmState) -> Scene:
        return scene_of(arena_of(parameters), parameters, names)

    def row(parameters: Any, state: SwarmState, events: np.ndarray) -> dict[str, Any]:
        if state.trouble[0].robot:
            raise explained(parameters, int(state.seed[0]), int(state.trouble[0].cycle), None)
        duration = round(float(state.clock[0].cycle) * parameters.swarm.cycle_time, 6)
        return {"robots": parameters.swarm.robots, **swarm.outcome(parameters, state, events), "duration_s": duration}

    def run(
        parameters: Any,
        seed: int,
        *,
        frames_every: float | None = None,
        watch: Callable[[float, float], None] | None = None,
    ) -> Trial:
        state = begin(parameters, seed)
        every = 1 if frames_every is None else max(1, round(frames_every / parameters.swarm.cycle_time))
        album = Album(state, roles_of, carried_of)
        take = None if frames_every is None else lambda state: album.take(state, lit(state))
        try:
            swarm.loop(state, 0)  # compiles, which takes its time
            with guarded(explaining(parameters, seed)) as reached:

                def looked(now: float, end: float) -> None:
                    reached(int(state.clock[0].cycle))
                    if watch:
                        watch(now, end)

                events = simulate(swarm.loop, state, every=every, take=take, watch=looked)
        except Exception as error:
            raise explained(parameters, seed, int(state.clock[0].cycle), error) from error
        frames = album.frames() if frames_every is not None else None
        return Trial(row(parameters, state, events), events, frames, scene(parameters, state))

    def explaining(parameters: Any, seed: int) -> list[str]:
        content = parameters.model_dump_json()
        return [sys.executable, "-c", EXPLAIN, json.dumps(sys.path), place_of(swarm, home), content, str(seed)]

    def explained(
        parameters: Any, seed: int, cycle: int, error: Exception | None, failures: Sequence[str] = ()
    ) -> Exception:
        what = "a command is no number" if error is None else f"{type(error).__name__}: {error}"
        if isinstance(error, Explained):
            return error
        place = "+".join([place_of(swarm, home), *failures])
        return Explained(explain(place, parameters.model_dump_json(), seed, cycle, what))

    def roles_of(state: SwarmState) -> np.ndarray:
        roles = state.memories["role"] if "role" in (swarm.memory.names or ()) else 0
        return np.where(state.robots.alive == 1, roles, dead)

    def shoot(state: SwarmState, film: Film) -> None:
        moment = int(film.taken[0])
        shoot_robots(state, film)
        film.shots["role"][moment] = roles_of(state)
        film.shots["colour"][moment] = state.commands["colour"]
        film.shots["carried"][moment] = carried_of(state)
        film.lit[moment] = lit(state)

    def roll(state: SwarmState, cycles: int, every: int, film: Film) -> None:
        clock = state.clock[0]
        end = clock.cycle + cycles
        while clock.cycle < end and not clock.finished and film.taken[0] < len(film.cycle):
            swarm.loop(state, int(min(end - clock.cycle, every - clock.cycle % every)))
            if clock.cycle % every == 0:
                shoot(state, film)

    def tell(event: Any) -> str:
        who = f"robot {int(event['robot'])}" if event["robot"] else "the swarm"
        if event["kind"] == ROLE:
            return f"{who} becomes {names[int(event['value'])]}"
        if event["kind"] == DIED:
            return f"{who}, {names[int(event['value'])]}, dies"
        numbers = ", ".join(f"{name} {int(event[name])}" for name in ("subject", "value", "detail") if event[name])
        return f"{who}: {words(swarm.kinds(int(event['kind'])))}{': ' if numbers else ''}{numbers}"

    def seen(state: SwarmState, identity: int) -> Inspection:
        i = int(np.nonzero(np.asarray(state.robots["identity"]) == identity)[0][0])
        role = names[int(roles_of(state)[i])]
        return Inspection(identity, role, sections_of(state, i))

    home = sys._getframe(1).f_globals["__name__"]  # as namedtuple finds who calls it
    names = (*(words(role) for role in swarm.roles), "dead")
    dead = len(names) - 1
    check(swarm)
    return System(
        name=swarm.name,
        summary=swarm.summary,
        parameters=swarm.parameters,
        configure=configuring(swarm.parameters, swarm.settings),
        run=run,
        kinds=tuple(kind.name.lower() for kind in swarm.kinds),
        targets=Targets(columns=swarm.times, published={}, published_label="", published_cap=0.0),
        timeline=timeline,
        begin=begin,
        advance=swarm.loop,
        roles=roles_of,
        watching=Watching(scene, shoot, roll, seen, tell, intervene, row),
        onboard=taken_apart(swarm),
        home=home,
        explained=explained,
    )


def place_of(swarm: Swarm, home: str) -> str:
    """Return where the system of a swarm is found: "module:object"."""
    module = sys.modules[home]
    for name, value in vars(module).items():
        if isinstance(value, System) and value.advance is swarm.loop and value.name == swarm.name:
            return f"{home}:{name}"
    raise ValueError(f"{swarm.name}: assemble it in a module, and give the system a name there: SYSTEM = assemble(...)")


def taken_apart(swarm: Swarm) -> Onboard | None:
    """Return the loop in the parts before and after the robots' decisions, if the writer names those."""
    decide, note = swarm.decide, swarm.note
    if decide is None or note is None:
        return None

    phases = of_castes if swarm.castes is not None else of_one_caste

    def after(state: SwarmState) -> None:
        phases.act(state)
        move(state)
        serve(state)
        note(state)
        state.clock[0].cycle += 1

    plain = getattr(decide, "__wrapped__", decide)
    return Onboard(f"{plain.__module__}:{plain.__name__}", given, phases.sense, after)


def given(state: SwarmState) -> tuple[Any, ...]:
    """Return what every robot is told before it is switched on; castes have an e-puck's numbers each."""
    epuck = state.epuck if len(state.epuck) == 1 else state.epuck[state.castes]
    return state.behaviour, epuck, state.world.settings["cycle_time"]


def words(member: IntEnum) -> str:
    """Write the name of a role or kind."""
    return member.name.lower().replace("_", " ")


def check(swarm: Swarm) -> None:
    """Check what a writer can get wrong.

    Raises:
        ValueError: names what is missing and the way out.
    """
    missing = [group for group in ("swarm", "epuck", "sight", "arena", "behaviour") if group not in
               swarm.parameters.model_fields]  # fmt: skip
    if missing:
        raise ValueError(
            f"{swarm.name}: parameters have no group {' and no '.join(missing)}: derive from SwarmParameters"
        )
    for kinds, wanted in ((swarm.kinds, ("ROLE", "DIED")), (swarm.roles, ())):
        if [int(kind) for kind in kinds] != list(range(len(kinds))) or not len(kinds):
            raise ValueError(f"{swarm.name}: {kinds.__name__} must number its members 0, 1, 2, ...")
        if [kind.name for kind in kinds][: len(wanted)] != list(wanted):
            raise ValueError(f"{swarm.name}: {kinds.__name__} must begin with ROLE = 0 and DIED = 1")


def carried_of(state: SwarmState) -> np.ndarray:
    """Return the number that is written on each robot."""
    if "carried" in (state.memories.dtype.names or ()):
        return np.asarray(state.memories["carried"])
    return np.zeros(len(state.robots), "i8")


def lit(state: SwarmState) -> np.ndarray:
    """Return which booths are lit; lamps always are."""
    booths = (state.booths.occupied == 0) & (state.booths.blocked == 0)
    return np.concatenate([booths, np.ones(len(state.lamps), bool)])


def scene_of(arena: Arena, parameters: Any, roles: tuple[str, ...]) -> Scene:
    """Return what stands still: walls, obstacles and booths; floor where there is any."""
    polygons = [Polygon(np.array(arena.outline), "wall")]
    polygons += [Polygon(corners(patch), f"{FLOOR}{patch.shade:.2f}") for patch in arena.patches()]
    polygons += [Polygon(block, "wall") for block in arena.solids]
    segments = arena.segments()
    for k, booth in enumerate(arena.booth):
        own = segments[segments.group == k + 1]
        polygons.append(Polygon(np.stack([own.ax, own.ay], axis=1), booth.colour))
    polygons += [Polygon(np.array(lamp.at) + LAMP_SHAPE, "yellow") for lamp in arena.lamp]
    epuck = parameters.epuck
    ranges = (("camera", epuck.camera_range), ("radio", epuck.radio_range))
    return Scene(tuple(polygons), epuck.radius, roles, parameters.swarm.cycle_time, ranges)


def timeline(trial: Trial) -> Timeline:
    """Return who had which role when."""
    events, cycle_time = trial.events, trial.scene.cycle_time
    end = float(trial.outcome["duration_s"] or 0.0)
    identities = sorted({int(robot) for robot in events["robot"]} - {0})
    if trial.frames is not None:
        identities = sorted(int(robot) for robot in trial.frames.identity)
    spans = []
    for lane, identity in enumerate(identities):
        role, start = 0, 0.0
        for event in events[(events["robot"] == identity) & np.isin(events["kind"], (ROLE, DIED))]:
            time = float(event["cycle"] + 1) * cycle_time
            spans.append(Span(lane, start, time, role))
            start = time
            role = len(trial.scene.roles) - 1 if event["kind"] == DIED else int(event["value"])
        spans.append(Span(lane, start, end, role))
    return Timeline(tuple(map(str, identities)), tuple(spans), (), (), end)


def sections_of(state: SwarmState, i: int) -> tuple[Section, ...]:
    """Return what robot ``i`` remembers, hears, says, senses and commands."""
    reading, memory, command = (np.asarray(part)[i] for part in (state.readings, state.memories, state.commands))
    packets = reading["packets"][: int(reading["packet_count"])]
    heard = {f"{metres(p['distance'])}, {degrees(p['bearing'])}": p["payload"] for p in packets}
    wheels = tuple((side, f"{float(command[side]):.4f} m/s") for side in ("left", "right"))
    lights = (("colour", colour(command["colour"])), ("infrared", byte(command["infrared"])))
    return (
        Section("Memory", ("field", "value"), tuple(fields(memory, {}))),
        _bytes("Messages heard", heard),
        _bytes("Messages sent", said(command)),
        *reading_sections(reading),
        Section("Command", ("field", "value"), (*wheels, *lights)),
    )


def _bytes(title: str, contents: Mapping[str, np.ndarray]) -> Section:
    return Section(
        title, ("from", "bytes"), tuple((head, bytes(content).hex(" ")) for head, content in contents.items())
    )


def intervene(state: SwarmState, intervention: Intervention) -> None:
    """Move or kill a robot, block or unblock a booth.

    Raises:
        Impossible: if it cannot be done; nothing has changed then.
    """
    if intervention.deed not in ("block", "unblock"):
        return touch_robot(state, intervention)
    if not 0 <= intervention.subject < len(state.booths):
        raise Impossible(f"there is no booth {intervention.subject}")
    state.booths[intervention.subject].blocked = 1 if intervention.deed == "block" else 0
    return None

"""How the partitioning system is shown and touched: frames, what is in a robot, what a person may do."""

from typing import Any

import numpy as np

from formicarium.compiled import compiled
from formicarium.devices.cache_pair import Pair
from formicarium.devices.depot import Place
from formicarium.robots.records import Colour
from formicarium.systems.partitioning.loop import run
from formicarium.systems.partitioning.measures import EventKind, Role, role_of
from formicarium.systems.partitioning.memory import NEVER, Area, Deed, Estimate, Ground, Label, State
from formicarium.trial.film import shoot_robots
from formicarium.trial.showing import degrees, fields, metres, reading_sections
from formicarium.trial.touching import touch_robot
from formicarium.trial.watching import Impossible, Inspection, Intervention, Section

DEAD = 4  # as frames number the dead


@compiled
def shoot(state, film):
    """Take one moment: bodies, roles, who carries an object, what the booths show, where the cache holds an object."""
    moment = film.taken[0]
    shoot_robots(state, film)
    for i in range(len(state.robots)):
        shot = film.shots[moment, i]
        shot.carried = state.memories[i].loaded
        if state.robots[i].alive == 0:
            shot.role = DEAD
        else:
            shot.role = role_of(state.memories[i].state)
    count = len(state.depots)
    for b in range(count):
        film.lit[moment, b] = shown(state.lights[b].colour)
    for k in range(len(state.pairs)):
        film.lit[moment, count + k] = holds(state, k)


@compiled
def shown(colour):
    """Return what a frame says of a booth's lights: 0 dark, 1 its own colour, 2 red."""
    if colour == Colour.OFF:
        return 0
    return 2 if colour == Colour.RED else 1


@compiled
def holds(state, k):
    """Return 1 if cache pair ``k`` has an object that no visitor has in its gripper."""
    pair = state.pairs[k].state
    if pair == Pair.EMPTY or pair == Pair.FULL:
        return 1 if pair == Pair.FULL else 0
    side = Place.CACHE_DROP if pair == Pair.DROPPING else Place.CACHE_PICK
    for b in range(len(state.depots)):
        depot = state.depots[b]
        if depot.pair == k and depot.place == side:
            return 1 - state.memories[depot.visitor].loaded
    return 0


@compiled
def roll(state, cycles, every, film):
    """Advance by so many cycles and take a moment every so many, until the film is full or the trial finished."""
    clock = state.clock[0]
    end = clock.cycle + cycles
    while clock.cycle < end and clock.finished == 0 and film.taken[0] < len(film.cycle):
        run(state, min(end - clock.cycle, every - clock.cycle % every))
        if clock.cycle % every == 0:
            shoot(state, film)


def inspect(state: Any, identity: int) -> Inspection:
    """Return what one robot senses, remembers and does."""
    i = int(np.nonzero(np.asarray(state.robots["identity"]) == identity)[0][0])
    reading, memory, command = (np.asarray(part)[i] for part in (state.readings, state.memories, state.commands))
    words = words_at(int(reading["cycle"]), float(state.world.settings["cycle_time"][0]))
    doing = State(int(memory["state"])).name.lower().replace("_", " ") if state.robots["alive"][i] == 1 else "dead"
    load = ", with an object" if memory["loaded"] else ""
    target = memory["target"]
    aim = f"{metres(np.hypot(target['x'], target['y']))} at {degrees(np.arctan2(target['y'], target['x']))}"
    estimates = (
        ("harvesting (phi 1)", seconds(memory["harvest"])),
        ("storing (phi 2)", seconds(memory["store"])),
        ("the whole task", seconds(memory["whole"])),
        ("partition with probability", f"{float(memory['probability']):.3f}"),
    )
    wheels = tuple((side, f"{float(command[side]):.4f} m/s") for side in ("left", "right"))
    streams = ("walks", "choices", "patience")
    shown = fields(memory, words, (*streams, "target", "harvest", "store", "whole", "probability"))
    rows = (*shown, ("target", aim if target["known"] else "none"), *((name, f"{memory[name]:#x}") for name in streams))
    return Inspection(
        identity,
        doing + load,
        (
            Section("Estimates", ("of", "value"), estimates),
            Section("Memory", ("field", "value"), rows),
            *reading_sections(reading),
            Section("Command", ("field", "value"), wheels),
        ),
    )


def seconds(value: float) -> str:
    """Write a time."""
    return f"{float(value):.1f} s"


def words_at(cycle: int, cycle_time: float) -> dict[str, Any]:
    """Return how the fields of a memory are written at a cycle."""

    def moment(value: int) -> str:
        apart = (int(value) - cycle) * cycle_time
        if value <= NEVER:
            return "never"
        if apart == 0:
            return "now"
        return f"in {apart:.1f} s" if apart > 0 else f"{-apart:.1f} s ago"

    moments = ("since", "timer", "wait_began", "draw_due", "path_seen", "swerve_until", "escape_until", "target_seen")
    return {
        **dict.fromkeys((*moments, "leaving_since", "roam_until", "deed_cycle"), moment),
        **dict.fromkeys(("compass", "lamp", "exit_heading", "roam_heading", "turn"), degrees),
        **dict.fromkeys(("travelled", "forward"), metres),
        **dict.fromkeys(("loaded", "waiting", "oriented"), lambda value: "yes" if value else "no"),
        "state": lambda value: State(int(value)).name.lower(),
        "label": lambda value: Label(int(value)).name.lower(),
        "ground": lambda value: "unknown" if value < 0 else Ground(int(value)).name.lower(),
        "deed": lambda value: Deed(int(value)).name.lower(),
        "updated": lambda value: Estimate(int(value)).name.lower(),
        "measured": seconds,
        "stay": seconds,
        "middle": seconds,
        "ways": lambda value: ", ".join(map(seconds, value)),
        **dict.fromkeys(("area", "set_out", "far"), lambda value: Area(int(value)).name.lower()),
        "measured_at": lambda value: ", ".join(moment(cycle) for cycle in value[1:]),
        "path_side": lambda value: "left" if value > 0 else "right" if value < 0 else "unknown",
    }


def intervene(state: Any, intervention: Intervention) -> None:
    """Move or kill a robot, block or unblock a booth.

    A blocked booth is dark; the cache takes no notice of who comes in. A visit that it has noticed runs to its end.

    Raises:
        Impossible: if it cannot be done; nothing has changed then.
    """
    if intervention.deed not in ("block", "unblock"):
        return touch_robot(state, intervention)
    if not 0 <= intervention.subject < len(state.depots):
        raise Impossible(f"there is no booth {intervention.subject}")
    state.depots[intervention.subject].blocked = 1 if intervention.deed == "block" else 0
    return None


def tell(event: Any) -> str:
    """Say in a sentence what happened; times in control cycles, as measured."""
    kind, robot, subject, value, detail = (int(event[name]) for name in ("kind", "robot", "subject", "value", "detail"))
    who = f"robot {robot}"
    match kind:
        case EventKind.BEGAN:
            return f"{who} begins, {TRIPS[Label(subject)]}"
        case EventKind.HARVESTED | EventKind.STORED:
            what = "harvests" if kind == EventKind.HARVESTED else "stores"
            took = f" after {value} cycles" if detail != Estimate.NONE else ""
            return f"{who} {what} an object{took}, {TRIPS[Label(subject)]}"
        case EventKind.DROPPED | EventKind.PICKED:
            what = "drops an object into" if kind == EventKind.DROPPED else "picks an object out of"
            return f"{who} {what} the cache, pair {subject}"
        case EventKind.GAVE_UP:
            return f"{who} gives up the cache after {value} cycles"
        case EventKind.VISIT:
            return f"{who} leaves the cache, pair {value}, {SIDES[Place(subject)]}, after {detail} cycles"
        case EventKind.PHANTOM:
            return f"{who} leaves the cache, pair {value}, with an object that nobody dropped"
        case EventKind.LOST:
            return f"{who} loses the object of the cache, pair {value}"
        case EventKind.UNFOUNDED:
            return f"{who} believes to have {Deed(subject).name.lower()} what the cache knows nothing of"
        case EventKind.ESCAPED:
            return f"{who} was stuck and backs off, {value} times so far"
        case EventKind.DIED:
            return f"{who} dies"
        case EventKind.PROBABILITY:
            return f"{who} decides with probability {value / 1e6:.3f}"
        case EventKind.PASSED_ON:
            return f"{who} has passed an object on, {TRIPS[Label(subject)]}"
        case EventKind.TAKEN_ON:
            return f"{who} has taken an object over, {TRIPS[Label(subject)]}"
        case EventKind.ESTIMATES:
            return f"{who} reckons {subject}, {value} and {detail} cycles to harvest, to store and for the whole"
        case _:
            return f"{who}: {ROLES[Role(value)]}"


TRIPS = {Label.NONE: "undecided", Label.CACHE: "on to the cache", Label.CORRIDOR: "on through the corridor"}
TRIPS |= {Label.GAVE_UP: "on through the corridor, having given up"}
SIDES = {Place.CACHE_DROP: "source side", Place.CACHE_PICK: "nest side"}
ROLES = {
    Role.HARVEST: "to the source",
    Role.CACHE: "to the cache",
    Role.CORRIDOR: "into the corridor",
    Role.STORE: "to the nest",
}

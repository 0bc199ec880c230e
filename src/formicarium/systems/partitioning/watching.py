"""How the partitioning system is shown and touched: frames, what is in a robot, what a person may do."""

from typing import Any

import numpy as np

from formicarium.compiled import compiled
from formicarium.devices.depot import Place
from formicarium.systems.partitioning.loop import run
from formicarium.systems.partitioning.measures import EventKind, Role, role_of
from formicarium.systems.partitioning.memory import NEVER, Deed, Estimate, Ground, Label, State
from formicarium.trial.film import shoot_bodies
from formicarium.trial.showing import degrees, fields, metres, plain, reading_sections
from formicarium.trial.touching import touch_robot
from formicarium.trial.watching import Impossible, Inspection, Intervention, Section

DEAD = 4  # as frames number the dead
PLACES = ("source", "nest", "cache, source side", "cache, nest side")


@compiled
def shoot(state, film):
    """Take one moment: bodies, roles, who carries an object, which booths are lit in their own colour."""
    moment = film.taken[0]
    shoot_bodies(state, film)
    for i in range(len(state.robots)):
        shot = film.shots[moment, i]
        shot.carried = state.memories[i].loaded
        shot.role = role_of(state.memories[i].state) if state.robots[i].alive == 1 else DEAD
    for b in range(len(state.depots)):
        film.lit[moment, b] = 1 if state.lights[b].colour != 0 and state.depots[b].occupied == 0 else 0


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
    """Return what one robot senses and remembers."""
    i = int(np.nonzero(np.asarray(state.robots["identity"]) == identity)[0][0])
    reading, memory, command = (np.asarray(part)[i] for part in (state.readings, state.memories, state.commands))
    words = words_at(int(reading["cycle"]), float(state.world.settings["cycle_time"][0]))
    wheels = tuple((side, f"{float(command[side]):.4f} m/s") for side in ("left", "right"))
    doing = State(int(memory["state"])).name.lower().replace("_", " ")
    load = ", with an object" if memory["loaded"] else ""
    summary = f"{doing}{load}" if state.robots["alive"][i] == 1 else "dead"
    return Inspection(
        identity,
        summary,
        (
            Section("Memory", ("field", "value"), tuple(fields(memory, words))),
            *reading_sections(reading),
            Section("Command", ("field", "value"), wheels),
        ),
    )


def words_at(cycle: int, cycle_time: float) -> dict[str, Any]:
    """Return how the fields of a memory are written at a cycle."""

    def moment(value: Any) -> str:
        if value <= NEVER:
            return "never"
        seconds = (int(value) - cycle) * cycle_time
        return f"in {seconds:.1f} s" if seconds > 0 else f"{-seconds:.1f} s ago"

    def seconds(value: Any) -> str:
        return f"{float(value):.1f} s"

    def named(names: Any) -> Any:
        return lambda value: names(int(value)).name.lower().replace("_", " ")

    moments: tuple[str, ...] = (
        "since",
        "timer",
        "wait_began",
        "draw_due",
        "deed_cycle",
        "path_seen",
        "swerve_until",
        "escape_until",
    )
    moments += ("target_seen", "leaving_since", "roam_until")
    times = ("harvest", "store", "whole", "measured", "stay")
    return {
        **dict.fromkeys(moments, moment),
        **dict.fromkeys(times, seconds),
        **dict.fromkeys(("compass", "lamp", "exit_heading", "roam_heading", "turn"), degrees),
        **dict.fromkeys(("travelled", "forward"), metres),
        "measured_at": lambda value: ", ".join(moment(cycle) for cycle in value[1:]),
        "state": named(State),
        "label": named(Label),
        "deed": named(Deed),
        "updated": named(Estimate),
        "ground": lambda value: named(Ground)(value) if value >= 0 else "unknown",
        **dict.fromkeys(("walks", "choices", "patience"), lambda value: f"{int(value):#x}"),
        "loaded": lambda value: "an object" if value else plain(value),
    }


def intervene(state: Any, intervention: Intervention) -> None:
    """Move or kill a robot, block or unblock a booth: a blocked one is dark and takes no notice of who comes in.

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
    """Say in a sentence what happened."""
    kind, robot, subject, value, detail = (int(event[name]) for name in ("kind", "robot", "subject", "value", "detail"))
    who = f"robot {robot}"
    match kind:
        case EventKind.BEGAN:
            return f"{who} begins in the nest area and chooses the {Label(subject).name.lower()}"
        case EventKind.HARVESTED | EventKind.STORED:
            did = "harvests" if kind == EventKind.HARVESTED else "stores"
            timed = f", {Estimate(detail).name.lower()} took {value} cycles" if detail else ""
            return f"{who} {did} an object and chooses the {Label(subject).name.lower()}{timed}"
        case EventKind.DROPPED | EventKind.PICKED:
            did = "drops an object at" if kind == EventKind.DROPPED else "picks up an object from"
            return f"{who} {did} pair {subject}" + (f" after waiting {value} cycles" if value else "")
        case EventKind.GAVE_UP:
            return f"{who} gives up the cache after {value} cycles and {detail} draws"
        case EventKind.VISIT:
            return f"{who} leaves the {PLACES[Place(subject)]}, pair {value}, after {detail} cycles"
        case EventKind.PHANTOM:
            return f"{who} leaves pair {value} an object that nobody dropped"
        case EventKind.LOST:
            return f"{who} loses the object of pair {value}: it took none"
        case EventKind.UNFOUNDED:
            return f"{who} believes to have {Deed(subject).name.lower()} what the cache knows nothing of"
        case EventKind.ESCAPED:
            return f"{who} is stuck and backs off, for the {value}. time"
        case EventKind.DIED:
            return f"{who} dies"
        case EventKind.PROBABILITY:
            return f"{who}: probability {value / 1e6:.6f} on having {Deed(detail).name.lower().replace('_', ' ')}"
        case EventKind.PASSED_ON:
            return f"{who} has passed an object on and chooses the {Label(subject).name.lower()}"
        case EventKind.ESTIMATES:
            return f"{who} reckons {subject}, {value} and {detail} cycles to harvest, to store and for the whole"
        case _:
            return f"{who} turns to the {Role(value).name.lower()}"

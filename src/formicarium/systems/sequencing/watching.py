"""How the sequencing systems are shown and touched: frames, what is in a robot, what a person may do."""

from typing import Any

import numpy as np

from formicarium.compiled import compiled
from formicarium.robots.records import SILENCE
from formicarium.systems.sequencing.log import EventKind
from formicarium.systems.sequencing.loop import run
from formicarium.systems.sequencing.memory import NEVER, Role, State
from formicarium.systems.sequencing.messages import MESSAGE, decode
from formicarium.systems.sequencing.messages_ii import decode_ii
from formicarium.trial.film import NOWHERE, shoot_robots
from formicarium.trial.showing import (
    byte,
    colour,
    degrees,
    fields,
    metres,
    plain,
    reading_sections,
    said,
    side_by_side,
)
from formicarium.trial.touching import touch_robot
from formicarium.trial.watching import Impossible, Inspection, Intervention, Section

DEAD = 4  # as frames number the dead
ROOM = 100  # places of a branch
REACHED = 0.35  # m, a branch ends this near to the guardian that it has reached


@compiled
def shoot(state, film):
    """Take one moment: bodies, roles, tasks done, who stands where in the chain, which booths are lit."""
    moment = film.taken[0]
    shoot_robots(state, film)
    for i in range(len(state.robots)):
        memory = state.memories[i]
        shot = film.shots[moment, i]
        shot.carried = memory.count
        shot.colour = state.commands[i].colour
        if state.robots[i].alive == 0:
            shot.role = DEAD
        elif memory.role == Role.RUNNER:
            shot.role = 0
        elif memory.role == Role.GUARDIAN:
            shot.role = 1
            if state.behaviour[0].mark == 2:  # a branch is named by the guardian that it starts from
                shot.place = state.robots[i].identity * ROOM
                shot.after = place_of_visitor(state, i) if memory.established == 1 else NOWHERE
            else:
                shot.place = memory.branch * ROOM
                if memory.established == 1 and memory.branch > 1:
                    shot.after = last_place(state, memory.branch - 1)
        else:
            shot.role = 3 if memory.role == Role.TAIL else 2
            shot.place = memory.branch * ROOM + memory.link_number
            shot.after = shot.place - 1
    for b in range(len(state.booths)):
        booth = state.booths[b]
        film.lit[moment, b] = 1 if booth.occupied == 0 and booth.blocked == 0 else 0


@compiled
def place_of_visitor(state, i):
    """Return the place of the nearest link or tail of another branch: the one that has reached guardian ``i``."""
    body = state.world.bodies[i]
    nearest = REACHED * REACHED
    place = NOWHERE
    for j in range(len(state.robots)):
        memory = state.memories[j]
        if state.robots[j].alive == 1 and (memory.role == Role.LINK or memory.role == Role.TAIL):
            dx = state.world.bodies[j].x - body.x
            dy = state.world.bodies[j].y - body.y
            if memory.branch != state.robots[i].identity and dx * dx + dy * dy < nearest:
                nearest = dx * dx + dy * dy
                place = memory.branch * ROOM + memory.link_number
    return place


@compiled
def last_place(state, branch):
    """Return the place of a branch's last member; its guardian is number 0."""
    last = branch * ROOM
    for i in range(len(state.robots)):
        memory = state.memories[i]
        if state.robots[i].alive == 1 and memory.branch == branch:
            if memory.role == Role.LINK or memory.role == Role.TAIL:
                last = max(last, branch * ROOM + memory.link_number)
    return last


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
    """Return what one robot senses, remembers, hears and says."""
    i = int(np.nonzero(np.asarray(state.robots["identity"]) == identity)[0][0])
    reading, memory, command = (np.asarray(part)[i] for part in (state.readings, state.memories, state.commands))
    words = words_at(int(reading["cycle"]), float(state.world.settings["cycle_time"][0]))
    mark = int(state.behaviour["mark"][0])
    packets = reading["packets"][: int(reading["packet_count"])]
    heard = {f"{metres(p['distance'])}, {degrees(p['bearing'])}": message_of(p["payload"], mark) for p in packets}
    sent = {head: message_of(content, mark) for head, content in said(command).items()}
    leave = ("message", "heard", "adverts", "target", "predecessor", "successor")
    tracks = [(name, track(memory[name])) for name in leave[3:]]
    adverts = {colour(c): advert for c, advert in enumerate(memory["adverts"]) if c and advert["heard"] > NEVER}
    wheels = tuple((side, f"{float(command[side]):.4f} m/s") for side in ("left", "right"))
    role = Role(int(memory["role"])).name.lower() if state.robots["alive"][i] == 1 else "dead"
    summary = f"{role}, {State(int(memory['state'])).name.lower().replace('_', ' ')}"
    return Inspection(
        identity,
        summary,
        (
            Section("Memory", ("field", "value"), (*fields(memory, words, leave), *tracks)),
            side_by_side("Guardians heard of", adverts, words),
            side_by_side("Messages heard", heard, {"colour": colour}),
            side_by_side("Messages sent", sent, {"colour": colour}),
            *reading_sections(reading),
            Section(
                "Command",
                ("field", "value"),
                (*wheels, ("colour", colour(command["colour"])), ("infrared", byte(command["infrared"]))),
            ),
        ),
    )


def message_of(payload: np.ndarray, mark: int) -> Any:
    """Return four bytes as a message of Mark I or II."""
    message = np.zeros(1, MESSAGE).view(np.recarray)
    (decode_ii if mark == 2 else decode)(payload, message[0])
    return np.asarray(message)[0]


def track(record: Any) -> str:
    """Write where a robot believes something to be."""
    if not record["known"]:
        return "nowhere"
    distance, bearing = np.hypot(record["x"], record["y"]), np.arctan2(record["y"], record["x"])
    return f"{metres(distance)} at {degrees(bearing)}"


def words_at(cycle: int, cycle_time: float) -> dict[str, Any]:
    """Return how the fields of a memory are written at a cycle."""

    def moment(value: int) -> str:
        seconds = (int(value) - cycle) * cycle_time
        if value <= NEVER:
            return "never"
        if seconds == 0:
            return "now"
        return f"in {seconds:.1f} s" if seconds > 0 else f"{-seconds:.1f} s ago"

    moments = (
        *(
            "since",
            "inhibition_heard",
            "inhibition_ahead",
            "echo_heard",
            "chain_seen",
            "watched_since",
            "verdict_heard",
        ),
        *("inhibiting_until", "refuse_until", "abstain_until", "wander_until", "requested", "settled", "echo_until"),
        "heard",
    )
    return {
        **dict.fromkeys(moments, moment),
        **dict.fromkeys(("colour", "watched", "last_success"), colour),
        **dict.fromkeys(("turn_left", "sector", "bearing", "turn"), degrees),
        **dict.fromkeys(("travelled", "forward"), metres),
        "role": lambda value: Role(int(value)).name.lower(),
        "state": lambda value: State(int(value)).name.lower(),
        "exchange": lambda value: byte(SILENCE if value < 0 else value),
        "draws": lambda value: f"{int(value):#x}",
        "candidate": lambda value: "guards it next" if value else plain(value),
    }


def intervene(state: Any, intervention: Intervention) -> None:
    """Move or kill a robot, block or unblock a booth.

    A blocked booth is dark and answers nobody; a visitor that is inside waits in vain, as at a failed exchange.

    Raises:
        Impossible: if it cannot be done; nothing has changed then.
    """
    if intervention.deed not in ("block", "unblock"):
        return touch_robot(state, intervention)
    if not 0 <= intervention.subject < len(state.booths):
        raise Impossible(f"there is no booth {intervention.subject}")
    booth = state.booths[intervention.subject]
    booth.blocked = 1 if intervention.deed == "block" else 0
    if booth.blocked == 1:
        booth.mute = 1
    return None


def tell(event: Any) -> str:
    """Say in a sentence what happened."""
    kind, robot, subject, value, detail = (int(event[name]) for name in ("kind", "robot", "subject", "value", "detail"))
    who = f"robot {robot}" if robot else "the visitor"
    match kind:
        case EventKind.ROLE:
            what = f"of {colour(subject)}" if value == Role.GUARDIAN else f"in branch {subject}" if subject else ""
            return f"{who} becomes {Role(value).name.lower()} {what}".strip()
        case EventKind.VISIT:
            return f"{who} {'enters' if value else 'leaves'} the {colour(subject)} booth"
        case EventKind.EXECUTED:
            return f"{who} does {colour(subject)} as task {detail}: {('failure', 'success', 'noted')[value]}"
        case EventKind.SEQUENCE:
            return f"{who} completes sequence {value}"
        case EventKind.CONDITION:
            return f"guardian {robot} of {colour(subject)}: place {value}{', confident' if detail else ''}"
        case EventKind.BRANCH:
            return f"branch {subject} reaches guardian {robot} with {value} links"
        case EventKind.CHAIN:
            return f"the chain is complete: {value} members"
        case EventKind.DISPLACED:
            return f"{who}, {Role(value).name.lower()}, is pushed off its place"
        case EventKind.DIED:
            return f"{who}, {Role(value).name.lower()}, dies"
        case EventKind.LABEL:
            return f"guardian {robot} of {colour(subject)} has label {chr(ord('a') + value - 1)}"
        case EventKind.STEP | EventKind.SOLVED:
            what = "goes on to" if kind == EventKind.STEP else "has found"
            return f"guardian {robot} of {colour(subject)} {what} permutation {value}"
        case EventKind.CROSSING:
            return f"{who} crosses the loop {'inwards' if value else 'outwards'}"
        case EventKind.HOPELESS:
            why = "nothing has gone on" if value else "nobody has been a runner"
            return f"{why} for long: the trial ends"
        case EventKind.STATE:
            return f"{who}: {State(detail).name.lower()} to {State(value).name.lower()}"
        case EventKind.MESSAGE:
            return f"{who} sends {subject:08x}"
        case EventKind.UNFOUNDED:
            return f"guardian {robot} of {colour(subject)} learns from {value}, which did not do it last"
        case _:
            return f"{who}: {EventKind(kind).name.lower().replace('_', ' ')} at {colour(subject)}"

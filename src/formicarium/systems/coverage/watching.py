"""How the coverage system is shown and touched: frames, what is in a robot, what a person may do."""

from collections.abc import Mapping
from typing import Any

import numpy as np

from formicarium.compiled import compiled
from formicarium.control.turning import Turning
from formicarium.observers.graphs import Graph
from formicarium.systems.coverage.arena import HALF_SIDE, circle
from formicarium.systems.coverage.fractals import fractal_columns
from formicarium.systems.coverage.loop import run
from formicarium.systems.coverage.measures import EventKind, Role, outcome, role_of
from formicarium.systems.coverage.memory import NEVER, Mode, Stage
from formicarium.systems.coverage.networks import network_columns
from formicarium.systems.coverage.parameters import CoverageParameters
from formicarium.systems.coverage.replanning import answer
from formicarium.trial.film import NOWHERE, Film, shoot_robots
from formicarium.trial.record import FLOOR, Polygon, Scene
from formicarium.trial.showing import colour, degrees, fields, metres, side_by_side
from formicarium.trial.situated import look
from formicarium.trial.touching import touch_robot
from formicarium.trial.watching import Impossible, Inspection, Intervention, Section

ROLES = ("master", "waiting", "flocking", "spiralling", "in an arm", "holding", "lost", "gathering", "dead")
HEARD_SHOWN = 8  # messages shown, the nearest speakers'
COLOURS = ("red", "green", "blue", "orange", "cyan", "yellow")  # of arms, as lights show them


def frame_roles(state: Any) -> np.ndarray:
    """Return every robot's role as frames number them."""
    return np.array([role_of(robot, memory) for robot, memory in zip(state.robots, state.memories, strict=True)])


def scene_of(parameters: CoverageParameters, state: Any) -> Scene:
    """Return what stands still: the part of the floor that is shown, and the places round tasks that count."""
    points = np.array([(beacon.x, beacon.y) for beacon in state.beacons])
    bodies = np.array([(axis.x, axis.y) for axis in state.axes])
    low = np.minimum(points.min(axis=0), bodies.min(axis=0) - 1.0) - 1.5
    high = np.maximum(points.max(axis=0), bodies.max(axis=0) + 1.0) + 1.5
    corners = np.array([(low[0], low[1]), (high[0], low[1]), (high[0], high[1]), (low[0], high[1])])
    reach = parameters.footbot.beacon_range
    slots = state.charts[state.survey[0].master].slots
    arms = [k for slot in slots for k in range(int(slot.task_count))]
    tasks = [Polygon(circle(b.x, b.y, reach), COLOURS[k]) for b, k in zip(state.beacons, arms, strict=True)]
    ranges = (("radio", parameters.footbot.radio_range), ("beacon", reach))
    return Scene(
        (Polygon(corners, f"{FLOOR}0.90"), *tasks),
        parameters.footbot.radius,
        ROLES,
        parameters.swarm.cycle_time,
        ranges,
        number="its arm",
    )


@compiled
def shoot(state, film):
    """Take one moment: bodies, roles, arms, who goes through whom to the master, which tasks are covered."""
    moment = film.taken[0]
    shoot_robots(state, film)
    for i in range(len(state.robots)):
        memory = state.memories[i]
        shot = film.shots[moment, i]
        shot.role = role_of(state.robots[i], memory)
        shot.carried = memory.arm
        shot.colour = state.commands[i].colour
        shot.place = state.robots[i].identity
        shot.after = memory.parent if memory.linked == 1 and memory.parent > 0 else NOWHERE
        if state.robots[i].alive == 0:
            shot.after = NOWHERE
    for k in range(len(state.tasks)):
        film.lit[moment, k] = state.tasks[k].covered


def roll(state: Any, cycles: int, every: int, film: Film) -> None:
    """Advance by so many cycles and take a moment every so many, until the film is full or the trial finished."""
    clock = state.clock[0]
    end = int(clock.cycle) + cycles
    roll_on(state, cycles, every, film)
    while state.survey[0].asked == 1 and clock.cycle < end:
        answer(state)
        roll_on(state, end - int(clock.cycle), every, film)


@compiled
def roll_on(state, cycles, every, film):
    """Do so until a master waits for a new plan."""
    clock = state.clock[0]
    survey = state.survey[0]
    end = clock.cycle + cycles
    while clock.cycle < end and clock.finished == 0 and survey.asked == 0 and film.taken[0] < len(film.cycle):
        run(state, min(end - clock.cycle, every - clock.cycle % every))
        if clock.cycle % every == 0:
            shoot(state, film)


def outcome_row(parameters: CoverageParameters, state: Any, events: np.ndarray) -> Mapping[str, Any]:
    """Return the row of a finished trial with the numbers that say which trial it was."""
    columns = {"fractal": fractal_columns, "network": network_columns}.get(parameters.formation.shape)
    return (
        {
            "robots": parameters.swarm.robots,
            "tasks": len(parameters.mission.tasks) or parameters.tasks.count,
            "spacing_m": parameters.behaviour.spacing,
            "variant": parameters.behaviour.variant,
        }
        | outcome(state, events)
        | (columns(parameters, state) if columns else {})
    )


def inspect(state: Any, identity: int) -> Inspection:
    """Return what one robot senses, remembers, hears and says."""
    i = int(np.nonzero(np.asarray(state.robots["identity"]) == identity)[0][0])
    reading, memory, command = (np.asarray(part)[i] for part in (state.readings, state.memories, state.commands))
    cycle, cycle_time = int(reading["cycle"]), float(state.world.settings["cycle_time"][0])
    words = words_at(cycle, cycle_time)
    packets = sorted(reading["packets"][: int(reading["packet_count"])], key=lambda packet: packet["range"])
    heard = {f"{p['sender']}: {metres(p['range'])}, {degrees(p['bearing'])}": p for p in packets[:HEARD_SHOWN]}
    told = [(str(e["receiver"]), degrees(e["bearing"])) for e in command["message"]["entries"]]
    links = memory["links"][: int(memory["link_count"])]
    message = command["message"]
    return Inspection(
        identity,
        f"{ROLES[role_of(state.robots[i], state.memories[i])]}, {Mode(int(memory['mode'])).name.lower()}",
        (
            Section("Memory", ("field", "value"), tuple(fields(memory, words, ("arms", "links", "slots", "worked")))),
            side_by_side("Arms", arms_of(memory), words),
            side_by_side("Links kept", {str(link["who"]): link for link in links}, words),
            side_by_side("Messages heard", {head: head_of(packet) for head, packet in heard.items()}, words),
            Section("Message sent", ("field", "value"), tuple(fields(message, words, ("arms", "entries")))),
            Section("Bearings told", ("to", "bearing"), tuple(told[: int(message["entry_count"])])),
            Section("Reading", ("field", "value"), tuple(fields(reading, words, ("packets",)))),
            Section("Command", ("field", "value"), tuple(fields(command, words, ("message", "enabled")))),
        ),
    )


def arms_of(record: Any) -> dict[str, Any]:
    """Return what a memory holds of each arm."""
    return {str(k + 1): record["arms"][k] for k in range(int(record["arm_count"]))}


def head_of(packet: Any) -> Any:
    """Return a packet without what it says of arms."""
    return packet[[name for name in packet.dtype.names if name != "arms"]]


def words_at(cycle: int, cycle_time: float) -> dict[str, Any]:
    """Return how the fields of a robot are written at a cycle."""

    def moment(value: int) -> str:
        return "never" if value <= NEVER else f"{(cycle - int(value)) * cycle_time:.1f} s ago"

    return {
        **dict.fromkeys(
            ("since", "parent_heard", "linked_at", "reference_heard", "corrected", "all_heard", "heard"), moment
        ),
        **dict.fromkeys(
            ("direction", "bearing", "bearing_of_me", "way_back", "offset", "spiral", "facing", "turned"), degrees
        ),
        "beacon_bearing": degrees,
        **dict.fromkeys(("gradient", "range", "farthest", "spacing", "way_ahead", "way_aside"), metres),
        "mode": lambda value: Mode(int(value)).name.lower(),
        "stage": lambda value: Stage(int(value)).name.lower(),
        "turning": lambda value: Turning(int(value)).name.lower(),
        "colour": colour,
        "draws": lambda value: f"{int(value):#x}",
    }


def intervene(state: Any, intervention: Intervention) -> None:
    """Move or kill a robot.

    Raises:
        Impossible: if it cannot be done; nothing has changed then.
    """
    if intervention.deed in ("block", "unblock"):
        raise Impossible("there are no booths to block")
    if intervention.deed == "move" and not (
        abs(intervention.x) <= 2 * HALF_SIDE and abs(intervention.y) <= 2 * HALF_SIDE
    ):
        raise Impossible("that is outside the arena")
    touch_robot(state, intervention)
    look(state)


def tell(event: Any) -> str:
    """Say in a sentence what happened."""
    kind, robot, subject, value, detail = (int(event[name]) for name in ("kind", "robot", "subject", "value", "detail"))
    match kind:
        case EventKind.PHASE:
            return f"robot {robot} hears of phase {value}: {Mode(subject).name.lower()}"
        case EventKind.ARM:
            if subject == 0:
                return f"robot {robot} leaves arm {value}"
            return f"robot {robot} joins arm {subject}" + (f", leaves arm {value}" if value else "")
        case EventKind.ROLE:
            return f"robot {robot} becomes {ROLES[Role(value)]}"
        case EventKind.PARTED:
            return f"the {Graph(subject).name.lower()} graph parts: {value} robots away, {detail} components"
        case EventKind.JOINED:
            return f"the {Graph(subject).name.lower()} graph is whole again after {value} cycles"
        case EventKind.TARGET:
            return f"arm {subject} has reached {value / 1000.0:.2f} m"
        case EventKind.COVERED:
            return f"the task of arm {subject} is covered"
        case EventKind.UNCOVERED:
            return f"the task of arm {subject} is left after {value} cycles"
        case EventKind.WORKED:
            return f"task {subject} is done after {value} cycles of work"
        case EventKind.FOLLOWED:
            return f"robot {robot} takes the master's part, the {value}. to have it"
        case EventKind.PLANNED:
            return f"the master plans what is left anew, in {subject} slot{'s' * (subject > 1)}"
        case EventKind.AIMED:
            return f"arm {subject} is for task {value} now"
        case EventKind.DIED:
            return f"robot {robot} dies"
        case _:
            return "the master's programme is over"

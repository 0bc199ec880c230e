"""A swarm in one file whose robots use every sensor of the e-puck.

A booth tells its number to whoever comes in. A robot looks for its red light (camera), keeps off what is near
(proximity), hears the number inside (infrared), and backs out until its wheels have turned far enough (wheel steps).
Then it drives to the lamp (light), stops where the floor is white (ground), and says the number to all in reach
(radio): those who hear it need not go in.
"""

import math
from enum import IntEnum

import numpy as np

from formicarium.compiled import compiled
from formicarium.control.moves import drive, steer
from formicarium.control.speech import be_quiet, broadcast
from formicarium.robots.epuck import PROXIMITY_COSINES, PROXIMITY_SINES
from formicarium.robots.records import SILENCE, Colour
from formicarium.streams import advanced, uniform
from formicarium.systems.own import Swarm, assemble
from formicarium.tables import Table, number
from formicarium.trial.swarm.arena import Arena, ArenaTable, Booth, Floor, Lamp
from formicarium.trial.swarm.parameters import SwarmParameters, SwarmTable
from formicarium.trial.swarm.phases import act, move, note_roles, sense, serve

NUMBER = 42  # what the booth says


class Errand(Table):
    """What a robot does."""

    speed: float = number(0.08, "m/s", "on its way", gt=0, le=0.12)
    back: int = number(1200, "1", "wheel steps out of the booth", gt=0)
    white: float = number(0.5, "1", "ground readings above this are the goal", gt=0, lt=1)


class Parameters(SwarmParameters):
    """All of a trial."""

    swarm: SwarmTable = SwarmTable(robots=6, time_cap=120.0)
    arena: ArenaTable = ArenaTable()
    behaviour: Errand = Errand()


class Role(IntEnum):
    """What a robot is at."""

    LOOKING = 0
    LEAVING = 1
    RETURNING = 2
    THERE = 3


class EventKind(IntEnum):
    """What the log tells."""

    ROLE = 0
    DIED = 1


MEMORY = np.dtype(
    [
        ("role", "i8"),
        ("number", "i8"),  # 0: not known
        ("told", "i8"),  # 1 if another robot said it
        ("steps", "i8"),  # of the left wheel when it began to leave
        ("draws", "u8"),
        ("turn", "f8"),  # rad/s, of its walk
    ],
    align=True,
)


@compiled
def decide(reading, memory, command, table, epuck, cycle_time):
    """Read, remember, decide."""
    be_quiet(command)
    listen(reading, memory)
    if memory.role == Role.LOOKING:
        look(reading, memory, command, table, epuck)
    elif memory.role == Role.LEAVING:
        drive(command, -0.5 * table.speed, 0.0, epuck.wheel_distance)
        if memory.steps - reading.left_steps > table.back:
            memory.role = Role.RETURNING
    elif memory.role == Role.RETURNING:
        ahead, aside = 0.0, 0.0
        for k in range(8):
            ahead += reading.light[k] * PROXIMITY_COSINES[k]
            aside += reading.light[k] * PROXIMITY_SINES[k]
        go(reading, command, math.atan2(aside, ahead), table, epuck)
        if min(reading.ground[0], reading.ground[1], reading.ground[2]) > table.white:
            memory.role = Role.THERE
    else:
        command.colour = Colour.GREEN
        command.payload[0, 0] = memory.number
        broadcast(command)


@compiled
def listen(reading, memory):
    """Take in the number: from the booth that one is in, or from robots that have it."""
    if reading.infrared != SILENCE and memory.number == 0:
        memory.number = reading.infrared
        memory.steps = reading.left_steps
        memory.role = Role.LEAVING
    if memory.role == Role.LOOKING and reading.packet_count > 0:
        memory.number = reading.packets[0].payload[0]
        memory.told = 1
        memory.role = Role.RETURNING


@compiled
def look(reading, memory, command, table, epuck):
    """Drive to the nearest red light; where none is seen, walk about."""
    for n in range(reading.blob_count):
        if reading.blobs[n].colour == Colour.RED:
            steer(command, reading.blobs[n].bearing, 0.5 * table.speed, 4.0, 3.0, epuck.wheel_distance)
            return
    memory.draws = advanced(memory.draws)
    memory.turn = 0.9 * memory.turn + 0.6 * (uniform(memory.draws) - 0.5)
    go(reading, command, memory.turn, table, epuck)


@compiled
def go(reading, command, direction, table, epuck):
    """Drive in a direction, away from what is near."""
    ahead, aside = math.cos(direction), math.sin(direction)
    for k in range(8):
        ahead -= 3.0 * reading.proximity[k] * PROXIMITY_COSINES[k]
        aside -= 3.0 * reading.proximity[k] * PROXIMITY_SINES[k]
    steer(command, math.atan2(aside, ahead), table.speed, 4.0, 3.0, epuck.wheel_distance)


@compiled
def note(state):
    """Log changes of role; end when all are there. And the booth speaks to who is inside."""
    note_roles(state)
    for i in range(len(state.robots)):
        state.robots[i].infrared_heard = SILENCE
    for b in range(len(state.booths)):
        if state.booths[b].occupied == 1:
            state.robots[state.booths[b].visitor].infrared_heard = NUMBER
    for i in range(len(state.robots)):
        if state.robots[i].alive == 1 and state.memories[i].role != Role.THERE:
            return
    state.clock[0].finished = 1


@compiled
def run(state, cycles):
    """Sense, decide, act, move, serve, note."""
    clock = state.clock[0]
    for _ in range(cycles):
        if clock.finished == 1:
            return
        sense(state)
        for i in range(len(state.robots)):
            if state.robots[i].alive == 1:
                decide(
                    state.readings[i],
                    state.memories[i],
                    state.commands[i],
                    state.behaviour[0],
                    state.epuck[0],
                    state.world.settings[0].cycle_time,
                )
        act(state)
        move(state)
        serve(state)
        note(state)
        clock.cycle += 1


def arena(parameters):
    """Return a room with a booth at one end, and a lamp over white floor at the other."""
    return Arena(
        outline=((-0.7, -0.5), (0.7, -0.5), (0.7, 0.5), (-0.7, 0.5)),
        start=(-0.3, -0.4, 0.3, 0.4),
        booth=(Booth(at=(0.6, 0.0)),),
        lamp=(Lamp(at=(-0.6, 0.0)),),
        floor=(Floor(rectangle=(-0.7, -0.5, -0.25, 0.5), shade=1.0),),
    )


def outcome(parameters, state, events):
    """Return the row of a finished trial."""
    told = np.asarray(state.memories.told) == 1
    return {
        "there": int((state.memories.role == Role.THERE).sum()),
        "by_infrared": int(((state.memories.number == NUMBER) & ~told).sum()),
        "by_radio": int(((state.memories.number == NUMBER) & told).sum()),
    }


SYSTEM = assemble(
    Swarm(
        name="every-sensor",
        summary="An errand that takes every sensor of the e-puck",
        parameters=Parameters,
        arena=arena,
        memory=MEMORY,
        loop=run,
        outcome=outcome,
        kinds=EventKind,
        roles=Role,
    )
)

if __name__ == "__main__":
    for seed in (1, 2, 3):
        row = SYSTEM.run(SYSTEM.configure(), seed).outcome
        print(f"seed {seed}: " + ", ".join(f"{name} {value}" for name, value in row.items()))

"""A stage: real robots, put where a test wants them, in the real loop, with a hand on everything in transit."""

import math
from collections.abc import Callable

import numpy as np

from formicarium.control.odometry import place
from formicarium.devices.booth import HALF, placed
from formicarium.devices.service import serve_booths
from formicarium.physics.grid import find_neighbours
from formicarium.physics.records import records
from formicarium.robots.records import Colour
from formicarium.systems.sequencing.behaviour import decide
from formicarium.systems.sequencing.guardian import become_guardian
from formicarium.systems.sequencing.measures import note
from formicarium.systems.sequencing.memory import Role, State
from formicarium.systems.sequencing.messages import MESSAGE, decode, encode
from formicarium.systems.sequencing.parameters import mark_i3_parameters
from formicarium.systems.sequencing.setup import SequencingState, begin
from formicarium.trial.phases import act, move, sense
from formicarium.trial.simulate import drain

Edit = Callable[[SequencingState], None]


def step(state: SequencingState, cycles: int = 1, edit: Edit | None = None, after: Edit | None = None) -> None:
    """Run the loop from outside, cycle by cycle: ``edit`` may change the readings before anybody decides."""
    clock = state.clock[0]
    for _ in range(cycles):
        sense(state)
        if edit:
            edit(state)
        for i in range(len(state.robots)):
            if state.robots[i].alive == 1:
                decide(state.readings[i], state.memories[i], state.commands[i], state.behaviour[0], state.epuck[0])
        act(state)
        move(state)
        serve_booths(
            *(state.booths, state.lights, state.coordinator[0], state.robots, state.world.bodies, state.commands),
            *(state.booth_table[0], clock.cycle, state.world.settings[0].cycle_time),
        )
        note(state)
        clock.cycle += 1
        if after:
            after(state)


def wide_stage(robots: int, seed: int = 1, setting: int = 4, **groups) -> SequencingState:
    """Return a trial in a wide arena, all robots parked far from its middle, where the test plays."""
    state = begin(mark_i3_parameters(setting, robots, **groups), seed)
    for i in range(robots):
        put(state, i, 2.0 + 0.1 * (i % 5), 0.1 * (i // 5))
    return state


def put(state: SequencingState, i: int, x: float, y: float, heading: float = 0.0) -> None:
    """Set a robot down somewhere, at rest."""
    body = state.world.bodies[i]
    body.x, body.y, body.heading = x, y, heading
    body.speed_x = body.speed_y = body.turn_rate = 0.0
    find_neighbours(state.world)


def put_before_booth(state: SequencingState, i: int, booth: int, out: float, aside: float = 0.0) -> None:
    """Set a robot down ``out`` metres in front of a booth's mouth, facing the bay."""
    b = state.booths[booth]
    way = math.atan2(b.sine, b.cosine)
    put(state, i, *placed(b.x, b.y, way, -HALF - out, aside), way)


def guardian(state: SequencingState, i: int, colour: int, success: bool, claim: int = 1, in_chain: int = 0) -> None:
    """Make a robot the guardian of a task that it did as number ``claim``; its booth is at its back."""
    memory = state.memories[i]
    become_guardian(memory, int(state.clock[0].cycle), success, claim)
    memory.colour = colour
    memory.in_chain = in_chain
    place(memory.target, 0.28, math.pi, int(state.clock[0].cycle))


def chain(state: SequencingState, links: int, spacing: float, established: int = 0) -> None:
    """Put guardian 0 at the origin, its right-hand side towards +x, and robots 1..links along x as its branch."""
    put(state, 0, 0.0, 0.0, math.pi / 2)
    guardian(state, 0, Colour.RED, True, in_chain=1)
    state.memories[0].tail, state.memories[0].state = 0, State.STAY
    for k in range(1, links + 1):
        put(state, k, k * spacing, 0.0)
        memory = state.memories[k]
        memory.role, memory.state = Role.LINK, State.STAY
        memory.branch, memory.link_number, memory.established = 1, k, established
        place(memory.predecessor, spacing, math.pi, 0)
        place(memory.successor, spacing, 0.0, 0)


def end_in_tail(state: SequencingState, k: int) -> None:
    """Make the last link of a chain its tail, in place and ready to recruit."""
    memory = state.memories[k]
    memory.role, memory.state, memory.successor.known = Role.TAIL, State.OPEN, 0
    memory.sweep_due = state.behaviour[0].sweep_idle


def tails(state: SequencingState) -> int:
    """Return how many robots take themselves for the tail of a branch."""
    return int((state.memories.role == Role.TAIL).sum() + (state.memories.tail == 1).sum())


def read(payload) -> np.record:
    """Return the message in four bytes."""
    message = records(MESSAGE, 1)[0]
    decode(np.asarray(payload, np.uint8), message)
    return message


def written(**fields: int) -> np.ndarray:
    """Return the four bytes of a message; what is not named is 0."""
    message = records(MESSAGE, 1)[0]
    for name, value in fields.items():
        message[name] = value
    payload = np.zeros(4, np.uint8)
    encode(message, payload)
    return payload


def add_packet(reading, payload, distance: float, bearing: float) -> None:
    """Let a robot hear one more packet."""
    packet = reading.packets[reading.packet_count]
    packet.payload[:] = payload
    packet.distance, packet.bearing = distance, bearing
    reading.packet_count += 1


def keep_packets(reading, wanted: Callable[[np.record], bool]) -> None:
    """Let a robot hear only the packets whose message is wanted."""
    kept = [np.array(packet) for packet in reading.packets[: reading.packet_count] if wanted(read(packet.payload))]
    for n, packet in enumerate(kept):
        reading.packets[n] = packet
    reading.packet_count = len(kept)


def events_of(state: SequencingState, *kinds: int) -> np.ndarray:
    """Empty the log; return the events of these kinds."""
    events = drain(state)
    return events[np.isin(events["kind"], kinds)]

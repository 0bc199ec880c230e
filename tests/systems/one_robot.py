"""One robot alone with what a test shows it: Reading in, Command out, no world."""

import math

import numpy as np

from formicarium.control.odometry import place
from formicarium.physics.records import records
from formicarium.robots.epuck import Epuck
from formicarium.robots.records import COMMAND, READING, ROBOT, SILENCE
from formicarium.systems.sequencing.behaviour import decide
from formicarium.systems.sequencing.guardian import become_guardian
from formicarium.systems.sequencing.memory import Role, State
from formicarium.systems.sequencing.parameters import BehaviourTable
from formicarium.systems.sequencing.setup import make_memories
from systems.stage import add_packet, read

EPUCK = Epuck().record()[0]


class OneRobot:
    """A controller with its Reading and Memory; ``live`` lets it decide once."""

    def __init__(self, identity: int = 7, seed: int = 1, **numbers) -> None:
        self.table = BehaviourTable(**numbers).record()[0]
        robots = records(ROBOT, 1)
        robots.identity = identity
        self.memory = make_memories(robots, seed)[0]
        self.reading = records(READING, 1)[0]
        self.command = records(COMMAND, 1)[0]
        self.reading.identity = identity
        self.reading.cycle = 1000
        self.forget()

    def forget(self) -> None:
        """Sense nothing."""
        self.reading.blob_count = 0
        self.reading.packet_count = 0
        self.reading.infrared = SILENCE

    def see(self, *blobs: tuple[int, float, float]) -> "OneRobot":
        """See lights (colour, distance, bearing)."""
        for n, (colour, distance, bearing) in enumerate(sorted(blobs, key=lambda blob: blob[1])):
            blob = self.reading.blobs[n]
            blob.colour, blob.distance, blob.bearing = colour, distance, bearing
        self.reading.blob_count = len(blobs)
        return self

    def hear(self, payload, distance: float = 0.2, bearing: float = 0.0) -> "OneRobot":
        """Hear one more packet."""
        add_packet(self.reading, payload, distance, bearing)
        return self

    def live(self) -> "OneRobot":
        """Decide once; the next cycle begins with nothing in view."""
        decide(self.reading, self.memory, self.command, self.table, EPUCK)
        self.reading.cycle += 1
        self.forget()
        return self

    def guard(self, colour: int, success: bool, claim: int = 1) -> "OneRobot":
        """Become the guardian of a task done as number ``claim``, its booth at the back."""
        become_guardian(self.memory, self.reading.cycle, success, claim)
        self.memory.colour = colour
        place(self.memory.target, 0.28, math.pi, self.reading.cycle)
        return self

    def lead(self, branch: int = 1, link_number: int = 1) -> "OneRobot":
        """Become a tail that is ready to recruit, its predecessor straight behind."""
        m = self.memory
        m.role, m.state, m.since = Role.TAIL, State.OPEN, self.reading.cycle
        m.branch, m.link_number, m.requested = branch, link_number, self.reading.cycle
        m.sweep_due = self.table.sweep_idle
        place(m.predecessor, self.table.spacing, math.pi, self.reading.cycle)
        return self

    def turn_to(self, state: State) -> "OneRobot":
        """Enter a state."""
        self.memory.state, self.memory.since = state, self.reading.cycle
        return self

    def sent(self) -> dict[int, bytes]:
        """Return the bytes of every emitter that is on."""
        return {k: bytes(self.command.payload[k]) for k in range(12) if self.command.enabled[k] == 1}

    def message(self) -> np.record | None:
        """Return what emitter 0 says, None if it is off."""
        return read(self.command.payload[0]) if self.command.enabled[0] == 1 else None

    def motion(self) -> tuple[float, float]:
        """Return the commanded (forward speed, turn rate)."""
        left, right = float(self.command.left), float(self.command.right)
        return 0.5 * (left + right), (right - left) / float(EPUCK.wheel_distance)

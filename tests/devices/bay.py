"""A booth with its coordinator, and robots that are put into the bay by hand or drive into it."""

import numpy as np

from formicarium.devices.booth import BOOTH, HALF, LIGHTS, BoothTable, booth_outline, placed
from formicarium.devices.coordinator import COORDINATOR
from formicarium.devices.service import serve_booths
from formicarium.physics.grid import find_neighbours
from formicarium.physics.records import records
from formicarium.physics.step import step
from formicarium.physics.world import make_bodies, make_world
from formicarium.robots.epuck import Epuck
from formicarium.robots.infrared import CLAIM, HEARD_HIGH, HEARD_LOW, HIGH_HALF, LOW_HALF
from formicarium.robots.records import COMMAND, LIGHT, ROBOT, SILENCE, Colour
from formicarium.streams import stream

POSE = (0.4, -0.3, 2.0)  # x, y (m) and direction into the bay (rad): nowhere special
FREE = -0.3  # m, depth of a place well outside


class Bay:
    """One booth. Robots stand at (depth, side) in the booth's frame, facing into the bay."""

    def __init__(self, *places, identity=0xA7, order=(1, 2, 3), colour=Colour.RED, seed=1, **table):
        self.table = BoothTable(**({"exchange_failure": 0.0} | table)).record()[0]
        x, y, way = POSE
        self.booths, self.lights = records(BOOTH, 1), records(LIGHT, len(LIGHTS))
        booth = self.booths[0]
        booth.x, booth.y, booth.cosine, booth.sine = x, y, np.cos(way), np.sin(way)
        booth.colour, booth.visitor, booth.draws = colour, -1, stream(seed, "booth")
        self.lights.colour = colour
        self.coordinator = records(COORDINATOR, 1)
        self.coordinator[0].tasks = len(order)
        self.coordinator[0].order[: len(order)] = order
        self.robots, self.commands = records(ROBOT, len(places)), records(COMMAND, len(places))
        self.robots.identity = identity + np.arange(len(places))
        self.robots.infrared_heard = self.commands.infrared = SILENCE
        epuck = Epuck()
        fields = {name: getattr(epuck, name) for name in ("radius", "mass", "inertia", "force_limit", "torque_limit")}
        bodies = make_bodies(len(places), **fields)
        self.world = make_world(bodies, booth_outline(x, y, way, 0.1, 1))
        for i, place in enumerate(places):
            self.put(i, *place)
        self.cycle = 1000

    def put(self, i, depth, side=0.0, heading=0.0):
        """Put robot i at a place of the booth's frame."""
        body = self.world.bodies[i]
        body.x, body.y = placed(*POSE, depth, side)
        body.heading = POSE[2] + heading
        body.forward = body.turning = body.speed_x = body.speed_y = body.turn_rate = 0.0
        find_neighbours(self.world)

    def place(self, i=0):
        """Return where robot i is: depth and side."""
        body, (x, y, way) = self.world.bodies[i], POSE
        dx, dy = body.x - x, body.y - y
        return np.cos(way) * dx + np.sin(way) * dy, np.cos(way) * dy - np.sin(way) * dx

    def drive(self, i, forward, cycles):
        """Let physics run while robot i drives on; return its places."""
        self.world.bodies[i].forward = forward
        track = [self.place(i)]
        for _ in range(cycles):
            step(self.world)
            find_neighbours(self.world)
            track.append(self.place(i))
        return np.array(track)

    def serve(self):
        """Let the booth work for one cycle; return what robot 0 hears."""
        serve_booths(
            self.booths, self.lights, self.coordinator[0], self.robots, self.world.bodies, self.commands,
            self.table, self.cycle, 0.1,
        )  # fmt: skip
        self.cycle += 1
        return int(self.robots[0].infrared_heard)

    def say(self, byte, i=0):
        """Let robot i send a byte from now on."""
        self.commands[i].infrared = byte

    @property
    def occupied(self):
        return bool(self.booths[0].occupied)

    @property
    def lit(self):
        return bool((self.lights.colour != Colour.OFF).all())


def visit(bay, claim=1, cycles=80, i=0, identity=None):
    """Put a robot into the bay and let it take part in the exchange; return what it hears, cycle by cycle."""
    identity = int(bay.robots[i].identity) if identity is None else identity
    bay.put(i, 0.0)
    heard, last = [], SILENCE
    for _ in range(cycles):
        words = {SILENCE: HIGH_HALF | identity >> 4, HEARD_HIGH: LOW_HALF | identity & 0x0F}
        bay.say(words.get(last, CLAIM | claim), i)
        bay.serve()
        byte = int(bay.robots[i].infrared_heard)
        heard.append(byte)
        last = byte if byte != SILENCE else last
    return heard


def leave(bay, i=0):
    """Take a robot out of the bay and let the booth notice."""
    bay.put(i, FREE)
    bay.say(SILENCE, i)
    bay.serve()


__all__ = ["FREE", "HALF", "HEARD_HIGH", "HEARD_LOW", "POSE", "Bay", "leave", "visit"]

"""A stage: a few robots put by hand, whose sensors are asked one at a time."""

import numpy as np

from formicarium.physics.grid import find_neighbours
from formicarium.physics.records import records
from formicarium.physics.world import make_bodies, make_world
from formicarium.robots.epuck import Epuck
from formicarium.robots.records import COMMAND, EMITTERS, LIGHT, QUEUE, READING, ROBOT, SILENCE
from formicarium.robots.simulated.camera import sense_blobs
from formicarium.robots.simulated.proximity import sense_proximity
from formicarium.robots.simulated.radio import sense_packets
from formicarium.robots.simulated.wheels import sense_steps, turn_wheels
from formicarium.streams import derived, stream

QUIET = {
    "wheel_noise": 0.0,
    "proximity_noise": 0.0,
    "radio_loss": 0.0,
    "radio_distance_noise": 0.0,
    "radio_distance_noise_floor": 0.0,
    "radio_bearing_noise": 0.0,
    "camera_distance_noise": 0.0,
    "camera_bearing_noise": 0.0,
    "camera_miss": 0.0,
}


class Stage:
    """Robots at places (x, y) with headings; all numbers of the e-puck but those given are the default ones."""

    def __init__(self, places, headings=0.0, segments=None, lights=(), seed=1, **epuck):
        self.table = Epuck(**epuck)
        self.epuck = self.table.record()[0]
        count = len(places)
        self.robots = records(ROBOT, count)
        self.robots.key = np.arange(count)
        self.robots.identity = np.arange(count) + 1
        self.robots.alive = 1
        self.robots.noise = [stream(seed, "noise", key) for key in range(count)]
        xs, ys = np.asarray(places, float).T
        bodies = make_bodies(count, x=xs, y=ys, heading=headings, **self.body_fields())
        self.world = make_world(bodies, segments, reach=self.table.radio_range + 0.01)
        self.readings = records(READING, count)
        self.commands = records(COMMAND, count)
        self.commands.infrared = SILENCE
        self.queue = records(QUEUE, count)
        self.lights = records(LIGHT, len(lights))
        for n, (x, y, colour) in enumerate(lights):
            self.lights[n] = (x, y, colour, n)

    def body_fields(self):
        names = ("radius", "mass", "inertia", "force_limit", "torque_limit")
        return {name: getattr(self.table, name) for name in names}

    def put(self, i, x, y, heading=0.0):
        """Put a robot somewhere else."""
        body = self.world.bodies[i]
        body.x, body.y, body.heading = x, y, heading
        find_neighbours(self.world)

    def say(self, i, payload, emitters=range(EMITTERS)):
        """Let a robot send four bytes, the same or a row for each emitter."""
        self.commands[i].payload[:] = payload
        self.commands[i].enabled[:] = 0
        self.commands[i].enabled[list(emitters)] = 1
        self.robots[i].speaking = int(len(list(emitters)) > 0)

    def moment(self, i, cycle):
        return np.uint64(derived(self.robots[i].noise, cycle))

    def hear(self, i=0, cycle=0):
        """Return the packets robot i receives."""
        reading = self.readings[i]
        moment = self.moment(i, cycle)
        sense_packets(self.world, i, self.robots, self.commands, self.queue, self.epuck, moment, reading)
        return reading.packets[: reading.packet_count].copy().view(np.recarray)

    def look(self, i=0, cycle=0):
        """Return the blobs robot i sees."""
        reading = self.readings[i]
        moment = self.moment(i, cycle)
        sense_blobs(self.world, i, self.robots, self.commands, self.lights, self.epuck, moment, reading)
        return reading.blobs[: reading.blob_count].copy().view(np.recarray)

    def feel(self, i=0, cycle=0):
        """Return the proximity values of robot i."""
        sense_proximity(self.world, i, self.epuck, self.moment(i, cycle), self.readings[i])
        return self.readings[i].proximity.copy()

    def wheels(self, left, right, i=0, cycle=0):
        """Command the wheels of robot i for one cycle of 0.1 s; return its drive's forward and turning speeds."""
        command, body = self.commands[i], self.world.bodies[i]
        command.left, command.right = left, right
        turn_wheels(body, self.robots[i], command, self.epuck, self.moment(i, cycle), 0.1)
        return float(body.forward), float(body.turning)

    def steps(self, i=0):
        """Return the wheel steps robot i has counted."""
        sense_steps(self.robots[i], self.epuck, self.readings[i])
        return int(self.readings[i].left_steps), int(self.readings[i].right_steps)


def around(count, distance, start=0.0):
    """Return places on a circle round the origin."""
    angles = start + 2.0 * np.pi * np.arange(count) / count
    return list(zip(distance * np.cos(angles), distance * np.sin(angles)))

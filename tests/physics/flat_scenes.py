"""Scenes for the tests and the benchmark of the flat world, and Chipmunk as a second opinion on them."""

import math

import numpy as np
import pymunk

from formicarium.physics.grid import find_neighbours
from formicarium.physics.step import step
from formicarium.physics.world import make_bodies, make_world, polygon_walls, regular_polygon

# The disc on which the cases of docs/choices.md were measured.
DISC = {"radius": 0.035, "mass": 0.4, "inertia": 9.8e-4, "force_limit": 1.5, "torque_limit": 1.5}
SLOP = 0.0001  # m, the default of make_world


def discs(places, headings=0.0, forward=0.0, **fields):
    """Return discs at these places (m) with these headings and commanded speeds."""
    xs, ys = np.asarray(places, float).T
    return make_bodies(len(xs), **(DISC | {"x": xs, "y": ys, "heading": headings, "forward": forward} | fields))


def run(world, seconds):
    """Run a world with its commands held; return it."""
    for _ in range(round(seconds / world.settings[0].cycle_time)):
        step(world)
        find_neighbours(world)
    return world


def overlaps(world):
    """Return the greatest overlap (m) among the bodies, negative if none touch."""
    bodies = world.bodies
    gaps = np.hypot(bodies.x[:, None] - bodies.x, bodies.y[:, None] - bodies.y) - (
        bodies.radius[:, None] + bodies.radius
    )
    return -gaps[~np.eye(len(bodies), dtype=bool)].min()


def hexagon(count, side, seed=1, forward=0.1):
    """Return a world of driven discs with random headings, spread evenly over a hexagon."""
    columns, rows = np.meshgrid(np.arange(-60, 61), np.arange(-60, 61))
    spots = np.stack([(columns + 0.5 * (rows % 2)).ravel(), (rows * math.sqrt(0.75)).ravel()], axis=1)
    normals = [(math.cos(angle), math.sin(angle)) for angle in np.radians((30, 90, 150))]
    size = np.max([np.abs(spots @ normal) for normal in normals], axis=0)
    chosen = np.argsort(size, kind="stable")[:count]
    room = side * math.sqrt(0.75) - DISC["radius"] - 0.01
    places = spots[chosen] * room / size[chosen[-1]]
    headings = np.random.default_rng(seed).uniform(-math.pi, math.pi, count)
    return make_world(discs(places, headings, forward), polygon_walls(regular_polygon(6, side)))


class Chipmunk:
    """The same scene in Chipmunk, driven as the reference simulator drives its robots."""

    def __init__(self, bodies, segments=(), iterations=10, slop=SLOP, friction=0.7):
        self.space = pymunk.Space()
        self.space.iterations = iterations
        self.space.collision_slop = slop
        self.space.collision_bias = 0.9**60
        self.bodies, self.controls = [], []
        for body in bodies:
            disc = pymunk.Body(body.mass, body.inertia)
            disc.position, disc.angle = (body.x, body.y), body.heading
            disc.velocity, disc.angular_velocity = (body.speed_x, body.speed_y), body.turn_rate
            rim = pymunk.Circle(disc, body.radius)
            rim.friction = friction
            control = pymunk.Body(body_type=pymunk.Body.KINEMATIC)
            pivot = pymunk.PivotJoint(control, disc, (0, 0), (0, 0))
            pivot.max_bias, pivot.max_force = 0, body.force_limit
            gear = pymunk.GearJoint(control, disc, 0, 1)
            gear.max_bias, gear.max_force = 0, body.torque_limit
            self.space.add(disc, rim, control, pivot, gear)
            self.bodies.append(disc)
            self.controls.append((control, body.forward, body.turning))
        for segment in segments:
            face = pymunk.Segment(self.space.static_body, (segment.ax, segment.ay), (segment.bx, segment.by), 0.0)
            face.friction = segment.friction
            self.space.add(face)

    def run(self, seconds):
        for _ in range(round(seconds / 0.1)):
            for disc, (control, forward, turning) in zip(self.bodies, self.controls):
                control.velocity = forward * math.cos(disc.angle), forward * math.sin(disc.angle)
                control.angular_velocity = turning
            for _ in range(10):
                self.space.step(0.01)
        return self

    @property
    def places(self):
        return np.array([tuple(body.position) for body in self.bodies])

    @property
    def speeds(self):
        return np.array([tuple(body.velocity) for body in self.bodies])


def places(world):
    return np.stack([world.bodies.x, world.bodies.y], axis=1)


def speeds(world):
    return np.stack([world.bodies.speed_x, world.bodies.speed_y], axis=1)

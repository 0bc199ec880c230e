"""The omnidirectional camera: coloured blobs with distance and bearing."""

import math

from formicarium.angles import wrapped
from formicarium.compiled import compiled
from formicarium.physics.rays import open_line
from formicarium.robots.records import BLOBS, Colour
from formicarium.robots.simulated.channels import CAMERA
from formicarium.streams import advanced, derived, normal, uniform

DEVICE_LIGHTS = 1 << 16  # added to the key of a device's light: lights and robots draw apart


@compiled
def see(robot, epuck, moment, key, distance, direction, colour, reading):
    """Add the blob of one light, with noise, in its place among the nearer and farther ones.

    distance + N(0, sigma_d), bearing + N(0, sigma_b), missed with probability ``camera_miss``.
    """
    noise = advanced(derived(moment, CAMERA + key))
    if uniform(noise) < epuck.camera_miss:
        return
    noise = advanced(noise)
    distance = max(0.0, distance + epuck.camera_distance_noise * normal(noise))
    noise = advanced(noise)
    bearing = wrapped(direction + epuck.camera_bearing_noise * normal(noise))
    place = reading.blob_count
    if place == BLOBS:
        robot.blobs_dropped += 1
        place -= 1
        if reading.blobs[place].distance <= distance:
            return
    else:
        reading.blob_count += 1
    while place > 0 and reading.blobs[place - 1].distance > distance:
        reading.blobs[place].colour = reading.blobs[place - 1].colour
        reading.blobs[place].distance = reading.blobs[place - 1].distance
        reading.blobs[place].bearing = reading.blobs[place - 1].bearing
        place -= 1
    reading.blobs[place].colour = colour
    reading.blobs[place].distance = distance
    reading.blobs[place].bearing = bearing


@compiled
def sense_blobs(world, i, robots, commands, lights, epuck, moment, reading):
    """See the lit robots and device lights within range that no tall wall hides.

    Robots do not hide each other: the camera (0.122 m) looks over the bodies (0.076 m) at lights above them
    (TS-13). The three lights of a robot shine as one, at its axis; those of a booth are seen one by one.
    """
    body = world.bodies[i]
    reading.blob_count = 0
    for n in range(world.neighbour_count[i]):
        neighbour = world.neighbours[i, n]
        colour = commands[neighbour.index].colour
        if colour == Colour.OFF or neighbour.distance > epuck.camera_range:
            continue
        if open_line(world, body.x, body.y, body.x + neighbour.dx, body.y + neighbour.dy):
            direction = math.atan2(neighbour.dy, neighbour.dx) - body.heading
            key = robots[neighbour.index].key
            see(robots[i], epuck, moment, key, neighbour.distance, direction, colour, reading)
    for light in lights:
        if light.colour == Colour.OFF:
            continue
        dx = light.x - body.x
        dy = light.y - body.y
        squared = dx * dx + dy * dy
        if squared <= epuck.camera_range**2 and open_line(world, body.x, body.y, light.x, light.y):
            direction = math.atan2(dy, dx) - body.heading
            key = DEVICE_LIGHTS + light.key
            see(robots[i], epuck, moment, key, math.sqrt(squared), direction, light.colour, reading)

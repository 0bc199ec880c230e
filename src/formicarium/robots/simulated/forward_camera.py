"""The forward camera: coloured lights with distance and bearing."""

import math

from formicarium.angles import wrapped
from formicarium.compiled import compiled
from formicarium.physics.rays import open_line
from formicarium.robots.forager import SIGHTS
from formicarium.robots.records import Colour
from formicarium.robots.simulated.channels import CAMERA
from formicarium.streams import advanced, derived, normal


@compiled
def through_opening(light, x, y):
    """Tell whether the line from a place (m) to the light passes through the niche's opening, or starts inside."""
    dx = x - light.x
    dy = y - light.y
    out = -(light.cosine * dx + light.sine * dy)
    aside = light.cosine * dy - light.sine * dx
    if out <= light.depth:
        return math.fabs(aside) < light.half_width
    return math.fabs(aside) * light.depth < light.half_width * out


@compiled
def hidden_by_body(world, i, dx, dy, squared):
    """Tell whether another body stands on the line from body i to the place (dx, dy) metres away."""
    for k in range(world.neighbour_count[i]):
        near = world.neighbours[i, k]
        across = near.dx * dy - near.dy * dx
        hidden = across * across < world.bodies[near.index].radius ** 2 * squared
        if hidden and 0.0 < near.dx * dx + near.dy * dy < squared:
            return True
    return False


@compiled
def sense_sights(world, i, lights, camera, moment, reading):
    """See the lit lights ahead: within the field of view and range, not behind bodies or walls (TP-64).

    distance (1 + N(0, sigma_d)), bearing + N(0, sigma_b), from the robot's centre.
    """
    body = world.bodies[i]
    ahead_x = math.cos(body.heading)
    ahead_y = math.sin(body.heading)
    edge = math.tan(camera.half_field)
    reading.blob_count = 0
    for light in lights:
        dx = light.x - body.x
        dy = light.y - body.y
        forward = dx * ahead_x + dy * ahead_y
        aside = dy * ahead_x - dx * ahead_y
        if light.colour == Colour.OFF or math.fabs(aside) > edge * forward:
            continue
        squared = dx * dx + dy * dy
        if squared > camera.range**2 or not through_opening(light, body.x, body.y):
            continue
        if hidden_by_body(world, i, dx, dy, squared) or not open_line(world, body.x, body.y, light.x, light.y):
            continue
        if reading.blob_count < SIGHTS:
            blob = reading.blobs[reading.blob_count]
            noise = advanced(derived(moment, CAMERA + light.key))
            blob.colour = light.colour
            blob.distance = math.sqrt(squared) * max(0.0, 1.0 + camera.distance_noise * normal(noise))
            noise = advanced(noise)
            blob.bearing = wrapped(math.atan2(aside, forward) + camera.bearing_noise * normal(noise))
            reading.blob_count += 1

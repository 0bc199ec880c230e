"""Three infrared sensors that look at the floor."""

import math

from formicarium.compiled import compiled
from formicarium.physics.floor import shade_at
from formicarium.robots.forager import GROUND_SENSORS
from formicarium.robots.simulated.channels import GROUND
from formicarium.streams import advanced, derived, uniform


@compiled
def sense_ground(body, floor, sensors, moment, reading):
    """Read the shade below each sensor: shade + U(-noise, noise), cut to [0, 1].

    Sensor k sits ``ahead`` of the centre, (1 - k) ``apart`` to the left.
    """
    cosine = math.cos(body.heading)
    sine = math.sin(body.heading)
    noise = derived(moment, GROUND)
    for k in range(GROUND_SENSORS):
        left = (1 - k) * sensors.ground_apart
        x = body.x + cosine * sensors.ground_ahead - sine * left
        y = body.y + sine * sensors.ground_ahead + cosine * left
        noise = advanced(noise)
        value = shade_at(floor, x, y) + sensors.ground_noise * (2.0 * uniform(noise) - 1.0)
        reading.ground[k] = min(1.0, max(0.0, value))

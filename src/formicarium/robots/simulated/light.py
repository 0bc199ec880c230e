"""The eight infrared sensors as sensors of ambient light."""

import math

from formicarium.angles import wrapped
from formicarium.compiled import compiled
from formicarium.robots.epuck import PROXIMITY_ANGLES
from formicarium.robots.records import PROXIMITY_SENSORS
from formicarium.robots.simulated.channels import AMBIENT
from formicarium.streams import advanced, derived, uniform


@compiled
def sense_light(body, lamp, sensors, moment, reading):
    """Read the lamp, which hangs above walls and robots (TP-55).

    exp(-2 d / intensity) max(0, 1 - 2 delta / pi) + U(-noise, noise), cut to [0, 1], with the distance d from the
    robot to the lamp and the angle delta between sensor and lamp.
    """
    dx = lamp.x - body.x
    dy = lamp.y - body.y
    strength = math.exp(-2.0 * math.sqrt(dx * dx + dy * dy) / lamp.intensity)
    bearing = wrapped(math.atan2(dy, dx) - body.heading)
    noise = derived(moment, AMBIENT)
    for k in range(PROXIMITY_SENSORS):
        noise = advanced(noise)
        away = math.fabs(wrapped(PROXIMITY_ANGLES[k] - bearing))
        value = strength * max(0.0, 1.0 - away * (2.0 / math.pi))
        reading.light[k] = min(1.0, max(0.0, value + sensors.light_noise * (2.0 * uniform(noise) - 1.0)))


@compiled
def sense_lamps(body, lamps, sensors, moment, reading):
    """Read any number of lamps: their light adds up, otherwise as ``sense_light``."""
    for k in range(PROXIMITY_SENSORS):
        reading.light[k] = 0.0
    for n in range(len(lamps)):
        dx = lamps[n].x - body.x
        dy = lamps[n].y - body.y
        strength = math.exp(-2.0 * math.sqrt(dx * dx + dy * dy) / lamps[n].intensity)
        bearing = wrapped(math.atan2(dy, dx) - body.heading)
        for k in range(PROXIMITY_SENSORS):
            away = math.fabs(wrapped(PROXIMITY_ANGLES[k] - bearing))
            reading.light[k] += strength * max(0.0, 1.0 - away * (2.0 / math.pi))
    noise = derived(moment, AMBIENT)
    for k in range(PROXIMITY_SENSORS):
        noise = advanced(noise)
        value = reading.light[k] + sensors.light_noise * (2.0 * uniform(noise) - 1.0)
        reading.light[k] = min(1.0, max(0.0, value))

"""Eight infrared proximity sensors."""

from formicarium.compiled import compiled
from formicarium.physics.rays import cast
from formicarium.robots.epuck import PROXIMITY_COSINES, PROXIMITY_SINES
from formicarium.robots.records import PROXIMITY_SENSORS
from formicarium.robots.simulated.channels import PROXIMITY
from formicarium.streams import advanced, derived, uniform


@compiled
def response(distance):
    """Return the noiseless value at ``distance`` metres along the ray.

    298.701 d^2 - 36.8961 d + 1.08212, cut to [0, 1]: 1 below 2.3 mm, 0 beyond 47.9 mm. The parabola's rising
    half, beyond its lowest point at 61.8 mm, is out of reach.
    """
    value = 298.701 * distance * distance - 36.8961 * distance + 1.08212
    return min(1.0, max(0.0, value))


@compiled
def sense_proximity(world, i, epuck, moment, reading):
    """Fill in the proximity values of body ``i``: response(distance) + U(-noise, noise), cut to [0, 1]."""
    cast(
        world,
        i,
        epuck.proximity_start,
        epuck.proximity_reach,
        PROXIMITY_COSINES,
        PROXIMITY_SINES,
        reading.proximity,
    )
    noise = derived(moment, PROXIMITY)
    for k in range(PROXIMITY_SENSORS):
        distance = reading.proximity[k]
        value = response(distance) if distance < epuck.proximity_reach else 0.0
        noise = advanced(noise)
        value += epuck.proximity_noise * (2.0 * uniform(noise) - 1.0)
        reading.proximity[k] = min(1.0, max(0.0, value))

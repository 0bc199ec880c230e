"""The e-puck as a table. Rows: Garattoni & Birattari 2018 [paper], the e-puck's data sheet and the public
simulator model of the same laboratory [model], and engineering choices where both are silent [choice].
"""

import math

import numpy as np

from formicarium.tables import Table, number

# Directions of the eight proximity sensors from the heading, rad, counter-clockwise (the real robot's).
PROXIMITY_ANGLES = np.radians([-17.0, -50.0, -90.0, -150.0, 150.0, 90.0, 50.0, 17.0])
PROXIMITY_COSINES = np.cos(PROXIMITY_ANGLES)
PROXIMITY_SINES = np.sin(PROXIMITY_ANGLES)


class Epuck(Table):
    """Body, wheels, sensors and their noise."""

    radius: float = number(0.035, "m", "body radius [paper: diameter 70 mm]", gt=0, le=0.04)
    mass: float = number(0.4, "kg", "[model]", gt=0)
    inertia: float = number(9.8e-4, "kg m2", "moment of inertia, four times a disc's [model]", gt=0)
    force_limit: float = number(1.5, "N", "largest force of the drive [model]", gt=0)
    torque_limit: float = number(1.5, "N m", "largest torque of the drive [model]", gt=0)
    wheel_distance: float = number(0.053, "m", "between the wheels [model]", gt=0)
    wheel_radius: float = number(0.0205, "m", "[model]", gt=0)
    steps_per_turn: float = number(1000.0, "1", "stepper motor: 20 steps, gear 50 to 1 [data sheet]", gt=0)
    speed_limit: float = number(0.12, "m/s", "wheel speed at the rim is cut to this [choice U1]", gt=0)
    wheel_noise: float = number(0.05, "1", "standard deviation of a wheel's speed, relative [choice TS-19]", ge=0, le=1)

    proximity_start: float = number(0.035, "m", "distance of the sensors from the centre [choice]", gt=0)
    proximity_reach: float = number(0.05, "m", "[model]", gt=0)
    proximity_noise: float = number(0.05, "1", "half-width of the uniform noise [choice TS-19]", ge=0, le=1)

    radio_range: float = number(0.8, "m", "centre to centre [model]", gt=0, le=3)
    radio_capacity: int = number(5, "1/cycle", "packets received in a cycle, drawn at random [model]", ge=0, le=10)
    radio_loss: float = number(0.05, "1", "probability that a packet is lost [choice TS-19]", ge=0, le=1)
    radio_distance_noise: float = number(0.25, "1", "relative standard deviation [choice TS-19]", ge=0)
    radio_distance_noise_floor: float = number(0.03, "m", "least standard deviation [choice TS-19]", ge=0)
    radio_bearing_noise: float = number(math.radians(8.0), "rad", "standard deviation [choice TS-19]", ge=0)

    camera_range: float = number(
        0.332, "m", "to a robot's light: 0.122 m tan 70 deg, less height [model]", gt=0, le=0.8
    )
    camera_distance_noise: float = number(0.013, "m", "standard deviation [model]", ge=0)
    camera_bearing_noise: float = number(math.radians(2.0), "rad", "standard deviation [choice TS-19]", ge=0)
    camera_miss: float = number(0.05, "1", "probability that a light is missed in a cycle [choice TS-19]", ge=0, le=1)


class EpuckSight(Table):
    """The forward camera, the ground sensors and the sensors of ambient light."""

    half_field: float = number(
        math.radians(28.0), "rad", "half the camera's field of view [choice TP-64]", gt=0, le=1.5
    )
    range: float = number(1.0, "m", "to a light in a booth [choice TP-64]", gt=0, le=3)
    distance_noise: float = number(0.05, "1", "standard deviation, relative [choice TP-64]", ge=0, le=0.5)
    bearing_noise: float = number(math.radians(2.0), "rad", "standard deviation [choice TP-64]", ge=0)
    ground_ahead: float = number(0.03, "m", "ground sensors from the centre [model]", gt=0)
    ground_apart: float = number(0.009, "m", "between two of them [model]", gt=0)
    ground_noise: float = number(0.02, "1", "half-width of the uniform noise [choice TP-54]", ge=0, le=1)
    light_noise: float = number(0.02, "1", "half-width of the uniform noise [choice]", ge=0, le=1)


# Rows: the numbers in which a published setting differs from the table's own.
PINI_2011 = {
    "speed_limit": 0.035,  # m/s [Pini et al. 2011: speed set to 3.5 cm/s]
    "wheel_noise": 0.02,  # [choice TP-65]
}

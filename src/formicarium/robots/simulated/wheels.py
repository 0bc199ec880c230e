"""Two wheels with stepper motors."""

import math

from formicarium.compiled import compiled
from formicarium.robots.simulated.channels import WHEELS
from formicarium.streams import advanced, derived, normal


@compiled
def limited(speed, limit):
    """Return a wheel speed cut to [-limit, limit]; what is not a number stands still."""
    if speed != speed:
        return 0.0
    return min(limit, max(-limit, speed))


@compiled
def turn_wheels(body, robot, command, epuck, moment, cycle_time):
    """Turn the commanded wheel speeds l, r into the drive of the body.

    forward = (l' + r') / 2 and turning = (r' - l') / wheel distance, with l' = l (1 + N(0, noise)): the motors
    make the commanded steps, the wheels slip.
    """
    left = limited(command.left, epuck.speed_limit)
    right = limited(command.right, epuck.speed_limit)
    robot.left_path += left * cycle_time
    robot.right_path += right * cycle_time
    noise = advanced(derived(moment, WHEELS))
    left *= 1.0 + epuck.wheel_noise * normal(noise)
    noise = advanced(noise)
    right *= 1.0 + epuck.wheel_noise * normal(noise)
    body.forward = 0.5 * (left + right)
    body.turning = (right - left) / epuck.wheel_distance


@compiled
def sense_steps(robot, epuck, reading):
    """Count the wheel steps made so far."""
    steps_per_metre = epuck.steps_per_turn / (2.0 * math.pi * epuck.wheel_radius)
    reading.left_steps = int(math.floor(robot.left_path * steps_per_metre))
    reading.right_steps = int(math.floor(robot.right_path * steps_per_metre))

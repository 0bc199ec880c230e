"""The drive of a foot-bot and its odometer."""

import math

from formicarium.compiled import compiled
from formicarium.robots.simulated.channels import WHEELS
from formicarium.streams import advanced, derived, normal


@compiled
def turn_foot_wheels(body, robot, chassis, command, footbot, moment, cycle_time):
    """Turn wheel speeds into the drive of the body.

    Each wheel nears its command with the time constant ``lag``, times (1 + N(0, noise)), the left one also times one
    plus its constant error. The odometer counts what was commanded to the motors, not what slipped.
    """
    share = 1.0 if footbot.lag <= cycle_time else cycle_time / footbot.lag
    chassis.left_now += share * (command.left - chassis.left_now)
    chassis.right_now += share * (command.right - chassis.right_now)
    left, right = chassis.left_now, chassis.right_now
    robot.left_path += left * cycle_time
    robot.right_path += right * cycle_time
    turned = (right - left) / footbot.wheel_distance * cycle_time
    path = 0.5 * (left + right) * cycle_time
    chassis.moved_ahead = path * math.cos(0.5 * turned)
    chassis.moved_aside = path * math.sin(0.5 * turned)
    chassis.turned = turned
    noise = advanced(derived(moment, WHEELS))
    left *= (1.0 + chassis.left_error) * (1.0 + footbot.wheel_noise * normal(noise))
    noise = advanced(noise)
    right *= 1.0 + footbot.wheel_noise * normal(noise)
    forward = 0.5 * (left + right)
    body.forward = min(footbot.speed, max(-footbot.speed, forward))
    body.turning = (right - left) / footbot.wheel_distance


@compiled
def push_off(body, robot, chassis, command, footbot, cycle_time):
    """Move a holonomic robot with the velocity it wants, cut to its top speed; it does not turn."""
    length = math.sqrt(command.ahead * command.ahead + command.aside * command.aside)
    share = footbot.speed / length if length > footbot.speed else 1.0
    ahead, aside = share * command.ahead, share * command.aside
    cosine = math.cos(body.heading)
    sine = math.sin(body.heading)
    body.speed_x = cosine * ahead - sine * aside
    body.speed_y = sine * ahead + cosine * aside
    body.turning = 0.0
    chassis.moved_ahead = ahead * cycle_time
    chassis.moved_aside = aside * cycle_time
    chassis.turned = 0.0
    robot.left_path += ahead * cycle_time
    robot.right_path += aside * cycle_time


@compiled
def sense_way(chassis, reading):
    """Read the odometer: way and turn of the last cycle, each with its robot's constant relative error."""
    reading.moved_ahead = chassis.moved_ahead * (1.0 + chassis.path_error)
    reading.moved_aside = chassis.moved_aside * (1.0 + chassis.path_error)
    reading.turned = chassis.turned * (1.0 + chassis.turn_error)

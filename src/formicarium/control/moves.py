"""Ways to move: from a wanted direction and speed to two wheel speeds."""

import math

from formicarium.angles import wrapped
from formicarium.compiled import compiled


@compiled
def stop(command):
    """Stand still."""
    command.left = 0.0
    command.right = 0.0


@compiled
def drive(command, forward, turn_rate, wheel_distance):
    """Drive at ``forward`` m/s while turning at ``turn_rate`` rad/s."""
    half = 0.5 * turn_rate * wheel_distance
    command.left = forward - half
    command.right = forward + half


@compiled
def steer(command, direction, speed, gain, turn_limit, wheel_distance):
    """Drive towards ``direction``: turn at gain times the error, and forward the more the better aligned."""
    turn_rate = min(turn_limit, max(-turn_limit, gain * direction))
    drive(command, speed * max(0.0, math.cos(direction)), turn_rate, wheel_distance)


@compiled
def shift(command, direction, speed, gain, turn_limit, wheel_distance):
    """Move towards ``direction``, forwards or backwards, whichever end of the robot is nearer."""
    ahead = math.cos(direction)
    error = direction if ahead >= 0.0 else wrapped(direction + math.pi)
    turn_rate = min(turn_limit, max(-turn_limit, gain * error))
    drive(command, speed * ahead, turn_rate, wheel_distance)

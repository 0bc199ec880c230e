"""Motion: bodies move with their speeds and drives change the speeds.

A drive is a motor with a limited force that strives for a commanded velocity: forward along the heading at the
start of the cycle, nothing sideways. So it also resists being pushed. A passive disc is a drive towards rest,
and its force limit is the friction of the floor.
"""

import math

from formicarium.compiled import compiled


@compiled
def aim_drives(world):
    """Start a cycle: take a working copy of every body and the velocity its drive strives for."""
    settings = world.settings[0]
    time = settings.cycle_time / settings.substeps
    for i in range(len(world.bodies)):
        body = world.bodies[i]
        motion = world.motions[i]
        motion.x = body.x
        motion.y = body.y
        motion.speed_x = body.speed_x
        motion.speed_y = body.speed_y
        motion.turn_rate = body.turn_rate
        motion.radius = body.radius
        motion.inverse_mass = 1.0 / body.mass
        motion.inverse_inertia = 1.0 / body.inertia
        motion.target_x = body.forward * math.cos(body.heading)
        motion.target_y = body.forward * math.sin(body.heading)
        motion.target_turn = body.turning
        motion.limit = body.force_limit * time
        motion.turn_limit = body.torque_limit * time
        motion.impulse_x = 0.0
        motion.impulse_y = 0.0
        motion.impulse_turn = 0.0
        motion.shift_x = 0.0
        motion.shift_y = 0.0
        motion.involved = 0


@compiled
def fastest(world):
    """Return the greatest speed (m/s) that any body has or strives for."""
    speed = 0.0
    for i in range(len(world.bodies)):
        motion = world.motions[i]
        speed = max(speed, motion.speed_x * motion.speed_x + motion.speed_y * motion.speed_y)
        speed = max(speed, motion.target_x * motion.target_x + motion.target_y * motion.target_y)
    return math.sqrt(speed)


@compiled
def drive(motion):
    """Give the drive's impulse: towards its target, at most its limit.

    Called once it is exact for a free body. Called after each pass over the contacts it is the drive's share of
    the solution: what is limited is the sum of its impulses in this sub-step.
    """
    missing_x = motion.target_x - motion.speed_x
    missing_y = motion.target_y - motion.speed_y
    if missing_x != 0.0 or missing_y != 0.0:
        impulse_x = motion.impulse_x + missing_x / motion.inverse_mass
        impulse_y = motion.impulse_y + missing_y / motion.inverse_mass
        square = impulse_x * impulse_x + impulse_y * impulse_y
        if square > motion.limit * motion.limit:
            share = motion.limit / math.sqrt(square)
            impulse_x *= share
            impulse_y *= share
            motion.speed_x += (impulse_x - motion.impulse_x) * motion.inverse_mass
            motion.speed_y += (impulse_y - motion.impulse_y) * motion.inverse_mass
        else:
            motion.speed_x = motion.target_x
            motion.speed_y = motion.target_y
        motion.impulse_x = impulse_x
        motion.impulse_y = impulse_y
    missing = motion.target_turn - motion.turn_rate
    if missing != 0.0:
        impulse = motion.impulse_turn + missing / motion.inverse_inertia
        if impulse > motion.turn_limit or impulse < -motion.turn_limit:
            impulse = min(motion.turn_limit, max(-motion.turn_limit, impulse))
            motion.turn_rate += (impulse - motion.impulse_turn) * motion.inverse_inertia
        else:
            motion.turn_rate = motion.target_turn
        motion.impulse_turn = impulse


@compiled
def drive_freely(motion):
    """Give the whole impulse of a sub-step to a body that touches nothing."""
    motion.impulse_x = 0.0
    motion.impulse_y = 0.0
    motion.impulse_turn = 0.0
    drive(motion)


@compiled
def glide(world):
    """Move the bodies that can touch nothing in this cycle through all its sub-steps at once."""
    settings = world.settings[0]
    time = settings.cycle_time / settings.substeps
    for i in range(len(world.bodies)):
        motion = world.motions[i]
        if motion.involved == 0:
            heading = world.bodies[i].heading
            for _ in range(settings.substeps):
                motion.x += motion.speed_x * time
                motion.y += motion.speed_y * time
                heading += motion.turn_rate * time
                drive_freely(motion)
            world.bodies[i].heading = heading


@compiled
def move(world, involved_count, time):
    """Move the bodies that can touch something through one sub-step (s), with the speeds they have."""
    for place in range(involved_count):
        i = world.involved[place]
        motion = world.motions[i]
        motion.x += motion.speed_x * time
        motion.y += motion.speed_y * time
        world.bodies[i].heading += motion.turn_rate * time
        motion.touched = 0


@compiled
def settle(world):
    """End a cycle: write places and speeds back to the bodies."""
    for i in range(len(world.bodies)):
        body = world.bodies[i]
        motion = world.motions[i]
        body.x = motion.x
        body.y = motion.y
        body.speed_x = motion.speed_x
        body.speed_y = motion.speed_y
        body.turn_rate = motion.turn_rate

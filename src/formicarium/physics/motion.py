"""Motion: bodies move with their speeds and drives change the speeds.

A drive is a motor with a limited force that strives for a commanded velocity: forward along the heading at
the start of the cycle, nothing sideways. So it also resists being pushed. A passive disc is a drive towards
rest, and its force limit is the friction of the floor.
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
        motion = world.solver.motions[i]
        motion.x = body.x
        motion.y = body.y
        motion.heading = body.heading
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
def fastest(motions):
    """Return the greatest speed (m/s) that any body has or strives for."""
    square = 0.0
    for i in range(len(motions)):
        motion = motions[i]
        square = max(square, motion.speed_x * motion.speed_x + motion.speed_y * motion.speed_y)
        square = max(square, motion.target_x * motion.target_x + motion.target_y * motion.target_y)
    return math.sqrt(square)


@compiled
def drive(motion):
    """Give the drive's impulse: towards its target, at most its limit. Return the greatest change (N s).

    Called once it is exact for a free body. Called in each pass over the contacts it is the drive's share of
    the solution: what is limited is the sum of its impulses in this sub-step.
    """
    change = 0.0
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
        change = max(abs(impulse_x - motion.impulse_x), abs(impulse_y - motion.impulse_y))
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
        change = max(change, abs(impulse - motion.impulse_turn))
        motion.impulse_turn = impulse
    return change


@compiled
def drive_freely(motion):
    """Give the whole impulse of a sub-step to a body that touches nothing."""
    motion.impulse_x = 0.0
    motion.impulse_y = 0.0
    motion.impulse_turn = 0.0
    drive(motion)


@compiled
def glide(solver, substeps, time):
    """Move the bodies that can touch nothing in this cycle through all its sub-steps (s) at once."""
    for i in range(len(solver.motions) - 1):
        motion = solver.motions[i]
        if motion.involved == 0:
            for _ in range(substeps):
                advance(motion, time)
                drive_freely(motion)


@compiled
def move(solver, involved_count, time):
    """Move the bodies that can touch something through one sub-step (s), with the speeds they have."""
    for place in range(involved_count):
        motion = solver.motions[solver.motions[place].listed]
        advance(motion, time)
        motion.touched = 0


@compiled
def advance(motion, time):
    """Move one body with the speeds it has (s)."""
    motion.x += motion.speed_x * time
    motion.y += motion.speed_y * time
    motion.heading += motion.turn_rate * time


@compiled
def settle(world):
    """End a cycle: write places and speeds back to the bodies."""
    for i in range(len(world.bodies)):
        body = world.bodies[i]
        motion = world.solver.motions[i]
        body.x = motion.x
        body.y = motion.y
        body.heading = motion.heading
        body.speed_x = motion.speed_x
        body.speed_y = motion.speed_y
        body.turn_rate = motion.turn_rate

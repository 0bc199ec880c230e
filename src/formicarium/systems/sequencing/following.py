"""How a runner moves along a chain: on a circle round the nearest place of it, chain on the left (Figs S11, S12)."""

import math

from formicarium.angles import wrapped
from formicarium.compiled import compiled
from formicarium.control.moves import steer
from formicarium.robots.epuck import PROXIMITY_ANGLES, PROXIMITY_COSINES, PROXIMITY_SINES
from formicarium.robots.records import PROXIMITY_SENSORS, Colour
from formicarium.systems.sequencing.perception import is_member

MEMBER_SIDE = math.pi / 3.0  # rad, proximity sensors this near to the reference's bearing look at the chain


@compiled
def foot(ax, ay, bx, by, literal):
    """Return the foot of the perpendicular from the origin to the line a-b, clamped to the segment (TS-94, TS-97)."""
    dx = bx - ax
    dy = by - ay
    squared = dx * dx + dy * dy
    if squared == 0.0:
        return ax, ay
    share = -(ax * dx + ay * dy) / squared
    if literal == 0:
        share = min(1.0, max(0.0, share))
    return ax + share * dx, ay + share * dy


@compiled
def reference_point(reading, memory, table):
    """Return (members seen: 0, 1 or 2, x, y): the place of the chain to circle round, from the two nearest members."""
    members = 0
    ax = 0.0
    ay = 0.0
    for n in range(reading.blob_count):  # nearest first
        blob = reading.blobs[n]
        if not is_member(blob, memory, reading.cycle, table):
            continue
        x = blob.distance * math.cos(blob.bearing)
        y = blob.distance * math.sin(blob.bearing)
        if members == 1:
            x, y = foot(ax, ay, x, y, table.literal_line)
            return 2, x, y
        ax = x
        ay = y
        members = 1
    return members, ax, ay


@compiled
def circle_direction(x, y, distance, gain):
    """Return (vx, vy), the direction of motion round a point at (x, y), kept at ``distance`` on the left (TS-96).

    v = gain * clip((d - distance) / distance, -1, 1) * u + t, with u the unit vector to the point and t = u
    turned by -90 degrees.
    """
    away = math.sqrt(x * x + y * y)
    if away < 1e-6:
        return 1.0, 0.0
    ux = x / away
    uy = y / away
    radial = gain * min(1.0, max(-1.0, (away - distance) / distance))
    return radial * ux + uy, radial * uy - ux


@compiled
def repulsion(reading, bearing, threshold):
    """Return (vx, vy), a push away from what the proximity sensors feel, except on the side of the chain (U44)."""
    x = 0.0
    y = 0.0
    for k in range(PROXIMITY_SENSORS):
        value = reading.proximity[k]
        if value > threshold and abs(wrapped(PROXIMITY_ANGLES[k] - bearing)) > MEMBER_SIDE:
            x -= value * PROXIMITY_COSINES[k]
            y -= value * PROXIMITY_SINES[k]
    return x, y


@compiled
def presses_member(reading, clearance):
    """Tell whether a chain member is so near ahead that driving on would push it out of its place."""
    for n in range(reading.blob_count):
        blob = reading.blobs[n]
        if blob.distance > clearance:
            return False
        if blob.colour >= Colour.CYAN and abs(blob.bearing) < MEMBER_SIDE:
            return True
    return False


@compiled
def stands_ahead(reading, threshold):
    """Tell whether something stands right ahead."""
    return max(reading.proximity[0], reading.proximity[7]) > threshold


@compiled
def queues(reading, memory, beside_guardian, table):
    """Tell whether a runner beside a guardian waits for who stands right ahead; its patience has an end."""
    blocked = beside_guardian and stands_ahead(reading, table.queue_value)
    memory.queued = memory.queued + 1 if blocked else 0
    return 0 < memory.queued <= table.queue_patience


@compiled
def follow_chain(reading, memory, command, x, y, beside_guardian, table, wheel_distance):
    """Steer along the chain whose nearest place is (x, y); beside a guardian walls do not repel, but queues wait."""
    vx, vy = circle_direction(x, y, table.follow_distance, table.radial_gain)
    if not beside_guardian:
        push_x, push_y = repulsion(reading, math.atan2(y, x), table.repulsion_value)
        vx += table.repulsion_weight * push_x
        vy += table.repulsion_weight * push_y
    waits = presses_member(reading, table.member_clearance) or queues(reading, memory, beside_guardian, table)
    speed = 0.0 if waits else table.follow_speed
    steer(command, math.atan2(vy, vx), speed, table.steering_gain, table.turn_rate, wheel_distance)

"""The booth (TAM) that stands for a task: a bay with two light barriers, lights and an infrared transceiver.

Booth frame: origin in the middle of the 0.12 m cube, x into the bay; the mouth is at x = -0.06 m. Shape and
barriers: the public simulator model (docs/choices.md); behaviour: TS-20 to TS-30.
"""

import math

import numpy as np

from formicarium.compiled import compiled
from formicarium.physics.world import outline
from formicarium.robots.infrared import (
    CLAIM,
    HEARD_HIGH,
    HEARD_LOW,
    HIGH_HALF,
    LOW_HALF,
    WORKING,
)
from formicarium.robots.records import SILENCE, Colour
from formicarium.streams import advanced, uniform
from formicarium.tables import Table, number

HALF = 0.06  # m, half the side of the cube
BAY_HALF_WIDTH = 0.05  # m, free on both sides of the axis
BAY_END = 0.036  # m, x of the back wall's face
FRONT_BARRIER = -0.052  # m
BACK_BARRIER = -0.012  # m
LIGHTS = ((0.035, -0.025), (0.035, 0.0), (0.035, 0.025))  # m, places of the lights that cameras see


class BoothTable(Table):
    """Timing and reliability of the booths."""

    task_time: float = number(
        7.0, "s", "a robot must stay this long; 3 to 10 [tuned on the pace of sequences, U25]", gt=0, le=3600
    )
    byte_period: float = number(0.2, "s", "the booth sends a byte this often [device firmware]", gt=0, le=60)
    exchange_failure: float = number(0.02, "1", "probability that a visit gets no answer [choice TS-25]", ge=0, le=1)
    friction: float = number(0.1, "1", "of the walls [model]", ge=0)
    delayed_feedback: bool = number(False, "1", "no verdict on a task, only on a whole sequence of them [paper]")


BOOTH = np.dtype(
    [
        ("x", "f8"),
        ("y", "f8"),
        ("cosine", "f8"),  # of the direction into the bay
        ("sine", "f8"),
        ("colour", "i8"),  # Colour of its task
        ("occupied", "i8"),  # as the light barriers have it
        ("visitor", "i8"),  # index of the robot in the bay, -1 if none
        ("mute", "i8"),  # 1 if the exchange of this visit fails
        ("since", "i8"),  # cycle at which the visit began
        ("high", "i8"),  # halves of the visitor's identity, -1 until heard
        ("low", "i8"),
        ("claim", "i8"),  # task number the visitor announced, 0 until heard
        ("verdict", "i8"),  # byte that ends the visit, 0 until judged
        ("judged", "i8"),  # cycle of the last verdict
        ("draws", "u8"),  # the booth's own random stream
        ("blocked", "i8"),  # 1 while a person keeps it dark and mute
    ],
    align=True,
)


def booth_outline(x: float, y: float, direction: float, friction: float, group: int) -> np.ndarray:
    """Return the segments of a booth whose bay points in ``direction`` (rad): two side walls and a back."""
    corners = [
        (-HALF, HALF),
        (HALF, HALF),
        (HALF, -HALF),
        (-HALF, -HALF),
        (-HALF, -BAY_HALF_WIDTH),
        (BAY_END, -BAY_HALF_WIDTH),
        (BAY_END, BAY_HALF_WIDTH),
        (-HALF, BAY_HALF_WIDTH),
    ]
    return outline([placed(x, y, direction, u, v) for u, v in corners], friction, True, group)


def placed(x: float, y: float, direction: float, u: float, v: float) -> tuple[float, float]:
    """Return the world coordinates (m) of the point (u, v) of a booth's frame."""
    cosine, sine = math.cos(direction), math.sin(direction)
    return x + cosine * u - sine * v, y + sine * u + cosine * v


@compiled
def barrier_blocked(depth, side, radius, barrier):
    """Tell whether a disc at (depth, side) in the booth frame interrupts the light barrier across the bay."""
    away = depth - barrier
    if away * away >= radius * radius:
        return False
    chord = math.sqrt(radius * radius - away * away)
    return side - chord < BAY_HALF_WIDTH and side + chord > -BAY_HALF_WIDTH


@compiled
def watch_barriers(booth, bodies):
    """Read both barriers: a visit begins when only the back one is blocked and ends when both are free.

    Returns the index of the robot deepest in the bay, -1 if none.
    """
    front = False
    back = False
    deepest = -1
    best = 0.0
    for i in range(len(bodies)):
        body = bodies[i]
        dx = body.x - booth.x
        dy = body.y - booth.y
        reach = HALF + body.radius
        if dx > reach or dx < -reach or dy > reach or dy < -reach:
            continue
        depth = booth.cosine * dx + booth.sine * dy
        side = -booth.sine * dx + booth.cosine * dy
        if side > BAY_HALF_WIDTH or side < -BAY_HALF_WIDTH or depth > BAY_END:
            continue
        front = front or barrier_blocked(depth, side, body.radius, FRONT_BARRIER)
        hit = barrier_blocked(depth, side, body.radius, BACK_BARRIER)
        back = back or hit
        if hit and (deepest < 0 or depth > best):
            deepest = i
            best = depth
    if booth.occupied == 0 and back and not front:
        booth.occupied = 1
    elif booth.occupied == 1 and not back and not front:
        booth.occupied = 0
    return deepest


@compiled
def begin_visit(booth, table, visitor, cycle):
    """Start the clock of a visit and draw whether its infrared exchange works."""
    booth.visitor = visitor
    booth.since = cycle
    booth.high = -1
    booth.low = -1
    booth.claim = 0
    booth.verdict = 0
    booth.draws = advanced(booth.draws)
    booth.mute = 1 if uniform(booth.draws) < table.exchange_failure or booth.blocked == 1 else 0


@compiled
def hear(booth, byte):
    """Take in one byte of the visitor."""
    if byte == SILENCE or booth.mute == 1:
        return
    upper = byte & 0xF0
    if upper == HIGH_HALF:
        booth.high = byte & 0x0F
    elif upper == LOW_HALF:
        booth.low = byte & 0x0F
    elif upper == CLAIM and booth.high >= 0 and booth.low >= 0:
        booth.claim = byte & 0x0F


@compiled
def answer(booth):
    """Return the byte that the booth sends now: the next step of the exchange, or the verdict."""
    if booth.mute == 1 or booth.high < 0:
        return SILENCE
    if booth.low < 0:
        return HEARD_HIGH
    if booth.claim == 0:
        return HEARD_LOW
    return WORKING if booth.verdict == 0 else booth.verdict


@compiled
def show_lights(booth, lights, first):
    """Show the task's colour, or nothing while a robot is inside (TS-23) or the booth is blocked."""
    colour = Colour.OFF if booth.occupied == 1 or booth.blocked == 1 else booth.colour
    for k in range(first, first + len(LIGHTS)):
        lights[k].colour = colour

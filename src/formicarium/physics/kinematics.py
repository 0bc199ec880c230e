"""Motion without forces: discs go where their drives send them, and no further than others and walls allow.

What overlaps after a cycle's arc loses the part of its own motion that led into the other (TP-65): discs slide
along each other and along walls, and nobody is pushed. A few passes settle everybody; who still overlaps then
stays where it was. The alternative, ``physics.step``, has masses and friction.
"""

import math

from formicarium.compiled import compiled
from formicarium.physics.geometry import beyond, place_along
from formicarium.physics.grid import scenery_cell

PASSES = 5  # over all pairs and walls (TP-65)
TOLERANCE = 0.0005  # m, greatest overlap at the end of a cycle (TP-65)
TOUCH = 1e-9  # m, overlap below this is contact


@compiled
def glide(world):
    """Advance the world by one control cycle without forces. Neighbour lists as for ``step``."""
    time = world.settings[0].cycle_time
    for i in range(len(world.bodies)):
        roll(world.bodies[i], world.solver.motions[i], time)
    disentangle(world, time)


@compiled
def disentangle(world, time):
    """Take back what led into others and walls, and write down the speeds that are left (s, one cycle)."""
    for _ in range(PASSES):
        if not part_all(world):
            break
    else:
        while hold_back(world):
            pass
    note_speeds(world, time)


@compiled
def note_speeds(world, time):
    """Write down how fast the bodies really were (s, one cycle)."""
    for i in range(len(world.bodies)):
        body = world.bodies[i]
        start = world.solver.motions[i]
        body.speed_x = (body.x - start.x) / time
        body.speed_y = (body.y - start.y) / time
        body.turn_rate = body.turning


@compiled
def roll(body, start, time):
    """Remember where a body is and move it along the exact arc of its two wheels.

    With v, w and t: it turns by wt along a chord of length vt sin(wt/2) / (wt/2), in the direction heading + wt/2.
    """
    start.x = body.x
    start.y = body.y
    start.touched = 0
    half = 0.5 * body.turning * time
    square = half * half
    chord = body.forward * time * (1.0 - square / 6.0 * (1.0 - square / 20.0))
    body.x += chord * math.cos(body.heading + half)
    body.y += chord * math.sin(body.heading + half)
    body.heading += 2.0 * half


@compiled
def part_all(world):
    """Take back, contact by contact in the order of keys, what leads into others and walls; tell if any overlapped."""
    found = False
    motions = world.solver.motions
    for place in range(len(world.bodies)):
        i = world.lists[place].order
        body = world.bodies[i]
        for k in range(world.neighbour_count[i]):
            near = world.neighbours[i, k]
            other = world.bodies[near.index]
            if near.distance > 2.0 * (body.radius + other.radius) or world.lists[near.index].rank < place:
                continue
            if part_pair(body, other, motions[i], motions[near.index]):
                found = True
        cell = scenery_cell(world.settings[0], body.x, body.y)
        for member in range(world.scenery[cell], world.scenery[cell + 1]):
            if part_from_face(body, world.segments[world.scenery[member]]):
                found = True
    return found


@compiled
def part_pair(first, second, first_start, second_start):
    """Part two overlapping discs, each by its share in the approach; tell if they overlapped."""
    dx = second.x - first.x
    dy = second.y - first.y
    reach = first.radius + second.radius
    square = dx * dx + dy * dy
    if square >= (reach - TOUCH) * (reach - TOUCH):
        return False
    distance = math.sqrt(square)
    normal_x = dx / distance if distance > 0.0 else 1.0
    normal_y = dy / distance if distance > 0.0 else 0.0
    own = max(0.0, (first.x - first_start.x) * normal_x + (first.y - first_start.y) * normal_y)
    other = max(0.0, (second_start.x - second.x) * normal_x + (second_start.y - second.y) * normal_y)
    if own + other <= 0.0:
        return True
    back = min(1.0, (reach - distance) / (own + other))
    first.x -= back * own * normal_x
    first.y -= back * own * normal_y
    second.x += back * other * normal_x
    second.y += back * other * normal_y
    return True


@compiled
def part_from_face(body, face):
    """Move a disc out of a piece of scenery; tell if it overlapped."""
    if beyond(face.ax, face.ay, face.bx, face.by, body.x, body.y, body.radius):
        return False
    place = place_along(face.ax, face.ay, face.bx, face.by, body.x, body.y)
    dx = body.x - (face.ax + place * (face.bx - face.ax))
    dy = body.y - (face.ay + place * (face.by - face.ay))
    square = dx * dx + dy * dy
    if square >= (body.radius - TOUCH) * (body.radius - TOUCH):
        return False
    distance = math.sqrt(square)
    if distance == 0.0:
        return True
    body.x += dx / distance * (body.radius - distance)
    body.y += dy / distance * (body.radius - distance)
    return True


@compiled
def hold_back(world):
    """Put whoever still overlaps back where it was at the start of the cycle; tell if anybody was."""
    found = False
    motions = world.solver.motions
    for place in range(len(world.bodies)):
        i = world.lists[place].order
        body = world.bodies[i]
        held = False
        for k in range(world.neighbour_count[i]):
            near = world.neighbours[i, k]
            other = world.bodies[near.index]
            if near.distance > 2.0 * (body.radius + other.radius):
                continue
            reach = body.radius + other.radius - TOLERANCE
            held = held or (other.x - body.x) ** 2 + (other.y - body.y) ** 2 < reach * reach
        cell = scenery_cell(world.settings[0], body.x, body.y)
        for member in range(world.scenery[cell], world.scenery[cell + 1]):
            face = world.segments[world.scenery[member]]
            at = place_along(face.ax, face.ay, face.bx, face.by, body.x, body.y)
            dx = body.x - (face.ax + at * (face.bx - face.ax))
            dy = body.y - (face.ay + at * (face.by - face.ay))
            held = held or dx * dx + dy * dy < (body.radius - TOLERANCE) ** 2
        if held and motions[i].touched == 0:
            motions[i].touched = 1
            body.x = motions[i].x
            body.y = motions[i].y
            found = True
    return found

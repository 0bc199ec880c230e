"""Rays: what a beam from a body hits first, and whether two places see each other."""

import math

from formicarium.compiled import compiled
from formicarium.physics.geometry import crosses, square_distance
from formicarium.physics.grid import scenery_cell


@compiled
def cast(world, i, start_radius, reach, cosines, sines, distances):
    """Write how far (m) each beam of body i gets before it meets a body or scenery; reach if it meets nothing.

    A beam in the direction (cosine, sine) in the body's frame starts at start_radius from the centre. A beam that
    starts inside something gets 0. Needs start_radius + reach <= settings.scenery_reach.
    """
    distances[: len(cosines)] = reach
    body = world.bodies[i]
    end = start_radius + reach
    ahead_x = 2.0  # the heading as a unit vector, found when first needed
    ahead_y = 0.0

    for k in range(world.neighbour_count[i]):
        near = world.neighbours[i, k]
        radius = world.bodies[near.index].radius
        if near.distance < end + radius:
            if ahead_x > 1.0:
                ahead_x = math.cos(body.heading)
                ahead_y = math.sin(body.heading)
            x = near.dx * ahead_x + near.dy * ahead_y
            y = near.dy * ahead_x - near.dx * ahead_y
            for ray in range(len(cosines)):
                across = cosines[ray] * y - sines[ray] * x
                half_square = radius * radius - across * across
                if half_square > 0.0:
                    half = math.sqrt(half_square)
                    along = cosines[ray] * x + sines[ray] * y
                    if along + half > start_radius:
                        distances[ray] = min(distances[ray], max(0.0, along - half - start_radius))

    cell = scenery_cell(world, body.x, body.y)
    for member in range(world.scenery_first[cell], world.scenery_first[cell + 1]):
        face = world.segments[world.scenery_members[member]]
        if square_distance(face.ax, face.ay, face.bx, face.by, body.x, body.y) < end * end:
            if ahead_x > 1.0:
                ahead_x = math.cos(body.heading)
                ahead_y = math.sin(body.heading)
            x = (face.ax - body.x) * ahead_x + (face.ay - body.y) * ahead_y
            y = (face.ay - body.y) * ahead_x - (face.ax - body.x) * ahead_y
            along_x = (face.bx - face.ax) * ahead_x + (face.by - face.ay) * ahead_y
            along_y = (face.by - face.ay) * ahead_x - (face.bx - face.ax) * ahead_y
            for ray in range(len(cosines)):
                # Solve  distance * (cosine, sine) = (x, y) + place * (along_x, along_y)  by Cramer's rule.
                area = cosines[ray] * along_y - sines[ray] * along_x
                if area != 0.0:
                    place = (x * sines[ray] - y * cosines[ray]) / area
                    distance = (x * along_y - y * along_x) / area
                    if 0.0 <= place <= 1.0 and distance >= 0.0:
                        distances[ray] = min(distances[ray], max(0.0, distance - start_radius))


@compiled
def bodies_in_line_of_sight(world, i, k):
    """Tell whether body i sees its k-th neighbour: no third disc and nothing tall is on the line between centres."""
    body = world.bodies[i]
    other = world.neighbours[i, k]
    for between in range(world.neighbour_count[i]):
        near = world.neighbours[i, between]
        along = near.dx * other.dx + near.dy * other.dy
        if between != k and 0.0 < along < other.distance * other.distance:
            across = near.dx * other.dy - near.dy * other.dx
            hidden = world.bodies[near.index].radius * other.distance
            if across * across < hidden * hidden:
                return False
    return open_line(world, body.x, body.y, body.x + other.dx, body.y + other.dy)


@compiled
def open_line(world, ax, ay, bx, by):
    """Tell whether nothing tall is on the straight line between two places (m)."""
    for k in range(len(world.obstacles)):
        obstacle = world.obstacles[k]
        near = square_distance(ax, ay, bx, by, obstacle.x, obstacle.y) <= obstacle.radius * obstacle.radius
        if near and blocked(world, obstacle.first, obstacle.count, ax, ay, bx, by):
            return False
    if world.settings[0].tall_walls:
        return not blocked(world, 0, len(world.segments), ax, ay, bx, by)
    return True


@compiled
def blocked(world, first, count, ax, ay, bx, by):
    """Tell whether any tall segment of a range crosses the line between two places (m)."""
    for number in range(first, first + count):
        face = world.segments[number]
        if face.tall != 0 and crosses(ax, ay, bx, by, face.ax, face.ay, face.bx, face.by):
            return True
    return False

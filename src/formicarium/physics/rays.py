"""Rays: what a beam from a body hits first, and whether two places see each other.

The functions that take a world hand on only what is needed of it: few arguments are cheap arguments.
"""

import math

from formicarium.compiled import compiled
from formicarium.physics.geometry import beyond, crosses, square_distance
from formicarium.physics.grid import scenery_cell


@compiled
def cast(world, i, start_radius, reach, cosines, sines, distances):
    """Write how far (m) each beam of body i gets before it meets a body or scenery; reach if nothing.

    A beam in the direction (cosine, sine) in the body's frame starts at start_radius from the centre. A beam
    that starts inside something gets 0. Needs start_radius + reach <= settings.scenery_reach.
    """
    body = world.bodies[i]
    for ray in range(len(cosines)):
        distances[ray] = reach
    end = start_radius + reach
    for k in range(world.neighbour_count[i]):
        near = world.neighbours[i, k]
        radius = world.bodies[near.index].radius
        if near.distance < end + radius:
            cast_at_disc(body, near, radius, start_radius, cosines, sines, distances)
    cell = scenery_cell(world.settings[0], body.x, body.y)
    for member in range(world.scenery[cell], world.scenery[cell + 1]):
        face = world.segments[world.scenery[member]]
        if beyond(face.ax, face.ay, face.bx, face.by, body.x, body.y, end):
            continue
        if square_distance(face.ax, face.ay, face.bx, face.by, body.x, body.y) < end * end:
            cast_at_face(body, face, start_radius, cosines, sines, distances)


@compiled
def cast_at_disc(body, near, radius, start_radius, cosines, sines, distances):
    """Shorten the beams of a body that a neighbour's disc (m) stops."""
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


@compiled
def cast_at_face(body, face, start_radius, cosines, sines, distances):
    """Shorten the beams of a body that a segment stops.

    Solves  distance * (cosine, sine) = (x, y) + place * (along_x, along_y)  by Cramer's rule.
    """
    ahead_x = math.cos(body.heading)
    ahead_y = math.sin(body.heading)
    x = (face.ax - body.x) * ahead_x + (face.ay - body.y) * ahead_y
    y = (face.ay - body.y) * ahead_x - (face.ax - body.x) * ahead_y
    along_x = (face.bx - face.ax) * ahead_x + (face.by - face.ay) * ahead_y
    along_y = (face.by - face.ay) * ahead_x - (face.bx - face.ax) * ahead_y
    for ray in range(len(cosines)):
        area = cosines[ray] * along_y - sines[ray] * along_x
        if area != 0.0:
            place = (x * sines[ray] - y * cosines[ray]) / area
            distance = (x * along_y - y * along_x) / area
            if 0.0 <= place <= 1.0 and distance >= 0.0:
                distances[ray] = min(distances[ray], max(0.0, distance - start_radius))


@compiled
def look_round(world, i):
    """Note the outlines of the neighbours of body i, of which ``bodies_in_line_of_sight`` is asked next."""
    outlines = world.solver.outlines
    for k in range(world.neighbour_count[i]):
        near = world.neighbours[i, k]
        outlines[0, k] = near.dx
        outlines[1, k] = near.dy
        outlines[2, k] = world.bodies[near.index].radius


@compiled
def bodies_in_line_of_sight(world, i, k):
    """Tell whether body i sees its k-th neighbour: no third disc and nothing tall between the centres.

    Body i must be the one that was last told to ``look_round``.
    """
    other = world.neighbours[i, k]
    if hidden_by_others(world.solver.outlines, world.neighbour_count[i], k, other.distance):
        return False
    body = world.bodies[i]
    return open_line(world, body.x, body.y, body.x + other.dx, body.y + other.dy)


@compiled
def open_line(world, ax, ay, bx, by):
    """Tell whether nothing tall is on the straight line between two places (m)."""
    tall_walls = world.settings[0].tall_walls
    return not hidden_by_scenery(world.obstacles, world.segments, tall_walls, ax, ay, bx, by)


@compiled
def hidden_by_others(outlines, count, k, distance):
    """Tell whether any of so many outlines is on the line to the k-th of them, which is at a distance (m)."""
    x = outlines[0, k]
    y = outlines[1, k]
    hiding = 0
    # Without a branch, and all of them: a processor takes several at once.
    for between in range(count):
        across = outlines[0, between] * y - outlines[1, between] * x
        along = outlines[0, between] * x + outlines[1, between] * y
        hidden = outlines[2, between] * distance
        inside = (across * across < hidden * hidden) & (along > 0.0) & (along < distance * distance)
        hiding += inside & (between != k)
    return hiding > 0


@compiled
def hidden_by_scenery(obstacles, segments, tall_walls, ax, ay, bx, by):
    """Tell whether a box, a booth or a tall wall is on the line between two places (m)."""
    for k in range(len(obstacles)):
        obstacle = obstacles[k]
        square = obstacle.radius * obstacle.radius
        if square_distance(ax, ay, bx, by, obstacle.x, obstacle.y) <= square:
            for number in range(obstacle.first, obstacle.first + obstacle.count):
                if hidden_by_face(segments[number], ax, ay, bx, by):
                    return True
    if tall_walls != 0:
        for number in range(len(segments)):
            if hidden_by_face(segments[number], ax, ay, bx, by):
                return True
    return False


@compiled
def hidden_by_face(face, ax, ay, bx, by):
    """Tell whether a segment is tall and crosses the line between two places (m)."""
    return face.tall != 0 and crosses(ax, ay, bx, by, face.ax, face.ay, face.bx, face.by)

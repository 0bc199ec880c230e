"""Motion without forces on an open floor: discs slide along each other, and what still overlaps is pushed out.

As in ``kinematics``, a disc loses the part of its own motion that leads into another. There, who still overlaps stays
where it was, whole: right for robots that turn away from what they touch. Robots that drive on against each other would
stand so for ever, held by the fraction of a millimetre that earlier cycles left. Here that fraction is pushed out, by
each disc's share in the motion of the cycle: who stands is not pushed, and nobody gets farther than it drives.
"""

import math

from formicarium.compiled import compiled
from formicarium.physics.kinematics import hold_back, note_speeds, roll

SLIDING = 8  # passes over all pairs that are close, in which a disc loses no more than its approach
PASSES = 60  # with those in which overlap is shared out, whoever approaches
SETTLED = 0.0001  # m, the passes end when no overlap was deeper
TOLERANCE = 0.0005  # m, who overlaps more than this after the last pass stays where it was (ST-23, trap 11)


@compiled
def slide(world):
    """Advance robots on two wheels by one control cycle. Neighbour lists as for ``physics.step``."""
    time = world.settings[0].cycle_time
    for i in range(len(world.bodies)):
        roll(world.bodies[i], world.solver.motions[i], time)
    slide_apart(world, time)


@compiled
def drift(world):
    """Advance holonomic bodies by one control cycle: each goes straight on with its speed_x and speed_y."""
    time = world.settings[0].cycle_time
    for i in range(len(world.bodies)):
        body = world.bodies[i]
        start = world.solver.motions[i]
        start.x = body.x
        start.y = body.y
        start.touched = 0
        body.x += body.speed_x * time
        body.y += body.speed_y * time
        body.heading += body.turning * time
    slide_apart(world, time)


@compiled
def slide_apart(world, time):
    """Take back what led into others, push out what is left, and write down the speeds that remain (s, one cycle)."""
    farthest = note_ways(world)
    count = list_close(world, farthest)
    deepest = 0.0
    for number in range(PASSES):
        deepest = part_all(world, count, number < SLIDING)
        if deepest == 0.0:
            break
        shorten_ways(world)
        if deepest < SETTLED:
            break
    if deepest > TOLERANCE:
        while hold_back(world):
            pass
    note_speeds(world, time)


@compiled
def note_ways(world):
    """Note how far every body drives in this cycle (m, as ``target_x`` and ``target_y``); return the greatest way."""
    farthest = 0.0
    for i in range(len(world.bodies)):
        body = world.bodies[i]
        start = world.solver.motions[i]
        start.target_x = body.x - start.x
        start.target_y = body.y - start.y
        farthest = max(farthest, way(start))
    return farthest


@compiled
def way(start):
    """Return how far a body drives in this cycle (m)."""
    return math.sqrt(start.target_x * start.target_x + start.target_y * start.target_y)


@compiled
def list_close(world, farthest):
    """List the pairs that can touch in this cycle, in the order of keys; return how many they are."""
    contacts = world.solver.contacts
    count = 0
    for place in range(len(world.bodies)):
        i = world.lists[place].order
        reach = world.bodies[i].radius + 2.0 * farthest
        for k in range(world.neighbour_count[i]):
            near = world.neighbours[i, k]
            if near.distance <= reach + world.bodies[near.index].radius and world.lists[near.index].rank > place:
                contacts[count].first = i
                contacts[count].second = near.index
                count += 1
    return count


@compiled
def part_all(world, count, slides):
    """Part the pairs listed, one after the other; return the deepest overlap met (m)."""
    deepest = 0.0
    for number in range(count):
        i = world.solver.contacts[number].first
        j = world.solver.contacts[number].second
        motions = world.solver.motions
        deepest = max(deepest, part(world.bodies[i], world.bodies[j], motions[i], motions[j], slides))
    return deepest


@compiled
def part(first, second, first_start, second_start, slides):
    """Part two discs and return their overlap (m): if it ``slides``, each first loses its approach, at most all of it.

    The rest is shared out by how far each drives in this cycle.
    """
    dx = second.x - first.x
    dy = second.y - first.y
    reach = first.radius + second.radius
    square = dx * dx + dy * dy
    if square >= reach * reach:
        return 0.0
    distance = math.sqrt(square)
    normal_x = dx / distance if distance > 0.0 else 1.0
    normal_y = dy / distance if distance > 0.0 else 0.0
    overlap = reach - distance
    own = 0.0
    other = 0.0
    if slides:
        own = max(0.0, (first.x - first_start.x) * normal_x + (first.y - first_start.y) * normal_y)
        other = max(0.0, (second_start.x - second.x) * normal_x + (second_start.y - second.y) * normal_y)
    if own + other > overlap:
        own *= overlap / (own + other)
        other = overlap - own
    elif way(first_start) + way(second_start) > 0.0:
        share = way(first_start) / (way(first_start) + way(second_start))
        left = overlap - own - other
        own += share * left
        other += (1.0 - share) * left
    first.x -= own * normal_x
    first.y -= own * normal_y
    second.x += other * normal_x
    second.y += other * normal_y
    return overlap


@compiled
def shorten_ways(world):
    """Let nobody get farther than it drives: who was pushed may have been."""
    for i in range(len(world.bodies)):
        body = world.bodies[i]
        start = world.solver.motions[i]
        dx = body.x - start.x
        dy = body.y - start.y
        most = way(start)
        length = math.sqrt(dx * dx + dy * dy)
        if length > most:
            body.x = start.x + dx * (most / length)
            body.y = start.y + dy * (most / length)

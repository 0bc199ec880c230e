"""Contacts: discs that touch push each other apart and rub.

Sequential impulses as in Box2D-Lite (Catto, "Iterative dynamics with temporal coherence", 2005) and Chipmunk:
each contact in turn gets the impulse that stops its approach and, within Coulomb's cone, its sliding; a few passes
over all contacts and drives settle everybody. Nothing bounces. Overlap is mended by a speed of its own that is
forgotten at once, so mending gives nobody momentum. Contacts are taken in the order of keys.
"""

import math

from formicarium.compiled import compiled
from formicarium.physics.geometry import place_along, square_distance
from formicarium.physics.grid import scenery_cell
from formicarium.physics.motion import drive, drive_freely, fastest

SLACK = 0.005  # m, added to the distance two bodies can travel towards each other: overlap being mended


@compiled
def find_contacts(world):
    """List the pairs that can touch in this cycle, by keys; return how many, and how many bodies they involve."""
    ground = len(world.bodies)
    travel = fastest(world) * world.settings[0].cycle_time + SLACK
    count = 0
    involved_count = 0
    for place in range(len(world.bodies)):
        i = world.order[place]
        motion = world.motions[i]
        before = count
        for k in range(world.neighbour_count[i]):
            near = world.neighbours[i, k]
            j = near.index
            if near.distance < motion.radius + world.motions[j].radius + 2.0 * travel:
                motion.involved = 1
                if world.rank[j] > place:
                    # Sorted by insertion: a body has few candidates.
                    at = note_contact(world, count, i, j, -1)
                    while at > before and world.rank[world.contacts[at - 1].second] > world.rank[j]:
                        note_contact(world, at, i, world.contacts[at - 1].second, -1)
                        at = note_contact(world, at - 1, i, j, -1)
                    count += 1
        reach = motion.radius + travel
        cell = scenery_cell(world, motion.x, motion.y)
        for member in range(world.scenery_first[cell], world.scenery_first[cell + 1]):
            number = world.scenery_members[member]
            segment = world.segments[number]
            square = square_distance(segment.ax, segment.ay, segment.bx, segment.by, motion.x, motion.y)
            if square < reach * reach:
                motion.involved = 1
                note_contact(world, count, i, ground, number)
                count += 1
        if motion.involved == 1:
            world.involved[involved_count] = i
            involved_count += 1
    return count, involved_count


@compiled
def note_contact(world, at, i, j, segment):
    """Write a contact that can happen between body i and body j or a segment; return its number."""
    if at >= len(world.contacts):
        raise ValueError("more bodies overlap than a world has room for")
    contact = world.contacts[at]
    first = world.motions[i]
    second = world.motions[j]
    friction = world.settings[0].friction
    contact.first = i
    contact.second = j
    contact.segment = segment
    contact.friction = friction * (friction if segment < 0 else world.segments[segment].friction)
    inverse = first.inverse_mass + second.inverse_mass
    contact.normal_mass = 1.0 / inverse
    inverse += first.radius * first.radius * first.inverse_inertia
    inverse += second.radius * second.radius * second.inverse_inertia
    contact.tangent_mass = 1.0 / inverse
    contact.normal_impulse = 0.0
    contact.tangent_impulse = 0.0
    return at


@compiled
def touch(world, contact_count):
    """Find the contacts that touch now and their normals; return how many touch, and the deepest overlap (m)."""
    settings = world.settings[0]
    touching_count = 0
    deepest = 0.0
    for number in range(contact_count):
        contact = world.contacts[number]
        first = world.motions[contact.first]
        second = world.motions[contact.second]
        if contact.segment < 0:
            dx = second.x - first.x
            dy = second.y - first.y
            reach = first.radius + second.radius
        else:
            face = world.segments[contact.segment]
            place = place_along(face.ax, face.ay, face.bx, face.by, first.x, first.y)
            dx = face.ax + place * (face.bx - face.ax) - first.x
            dy = face.ay + place * (face.by - face.ay) - first.y
            reach = first.radius
        square = dx * dx + dy * dy
        if square >= reach * reach:
            contact.normal_impulse = 0.0
            contact.tangent_impulse = 0.0
            continue
        distance = math.sqrt(square)
        contact.normal_x = dx / distance if distance > 0.0 else 1.0
        contact.normal_y = dy / distance if distance > 0.0 else 0.0
        contact.parting_speed = settings.mending * max(0.0, reach - distance - settings.slop)
        contact.parting_impulse = 0.0
        deepest = max(deepest, reach - distance)
        first.touched = 1
        second.touched = 1
        world.touching[touching_count] = number
        touching_count += 1
    return touching_count, deepest


@compiled
def rub(contact, first, second, normal_impulse, tangent_impulse):
    """Change the speeds of two touching bodies by an impulse (N s) along the normal and one along the rim."""
    impulse_x = normal_impulse * contact.normal_x - tangent_impulse * contact.normal_y
    impulse_y = normal_impulse * contact.normal_y + tangent_impulse * contact.normal_x
    first.speed_x -= impulse_x * first.inverse_mass
    first.speed_y -= impulse_y * first.inverse_mass
    first.turn_rate -= tangent_impulse * first.radius * first.inverse_inertia
    second.speed_x += impulse_x * second.inverse_mass
    second.speed_y += impulse_y * second.inverse_mass
    second.turn_rate -= tangent_impulse * second.radius * second.inverse_inertia


@compiled
def begin(world, involved_count, touching_count):
    """Give free bodies their drive's impulse, and touching ones the impulses of the sub-step before."""
    for place in range(involved_count):
        motion = world.motions[world.involved[place]]
        if motion.touched == 0:
            drive_freely(motion)
        else:
            motion.speed_x += motion.impulse_x * motion.inverse_mass
            motion.speed_y += motion.impulse_y * motion.inverse_mass
            motion.turn_rate += motion.impulse_turn * motion.inverse_inertia
    for place in range(touching_count):
        contact = world.contacts[world.touching[place]]
        first = world.motions[contact.first]
        second = world.motions[contact.second]
        rub(contact, first, second, contact.normal_impulse, contact.tangent_impulse)


@compiled
def press(world, involved_count, touching_count):
    """Make one pass: every drive of a touching body, then every contact, corrects its impulse."""
    for place in range(involved_count):
        motion = world.motions[world.involved[place]]
        if motion.touched == 1:
            drive(motion)
    for place in range(touching_count):
        contact = world.contacts[world.touching[place]]
        first = world.motions[contact.first]
        second = world.motions[contact.second]
        speed_x = second.speed_x - first.speed_x
        speed_y = second.speed_y - first.speed_y
        approach = speed_x * contact.normal_x + speed_y * contact.normal_y
        sliding = speed_y * contact.normal_x - speed_x * contact.normal_y
        sliding -= first.turn_rate * first.radius + second.turn_rate * second.radius
        normal = max(0.0, contact.normal_impulse - approach * contact.normal_mass)
        most = contact.friction * normal
        tangent = contact.tangent_impulse - sliding * contact.tangent_mass
        tangent = min(most, max(-most, tangent))
        rub(contact, first, second, normal - contact.normal_impulse, tangent - contact.tangent_impulse)
        contact.normal_impulse = normal
        contact.tangent_impulse = tangent


@compiled
def part(world, involved_count, touching_count, time):
    """Mend overlap: move touching bodies apart by a share of their overlap, without giving them speed."""
    for _ in range(world.settings[0].iterations):
        for place in range(touching_count):
            contact = world.contacts[world.touching[place]]
            first = world.motions[contact.first]
            second = world.motions[contact.second]
            parting = (second.shift_x - first.shift_x) * contact.normal_x
            parting += (second.shift_y - first.shift_y) * contact.normal_y
            impulse = contact.parting_impulse + (contact.parting_speed - parting) * contact.normal_mass
            impulse = max(0.0, impulse)
            change = impulse - contact.parting_impulse
            contact.parting_impulse = impulse
            first.shift_x -= change * contact.normal_x * first.inverse_mass
            first.shift_y -= change * contact.normal_y * first.inverse_mass
            second.shift_x += change * contact.normal_x * second.inverse_mass
            second.shift_y += change * contact.normal_y * second.inverse_mass
    for place in range(involved_count):
        motion = world.motions[world.involved[place]]
        motion.x += motion.shift_x * time
        motion.y += motion.shift_y * time
        motion.shift_x = 0.0
        motion.shift_y = 0.0

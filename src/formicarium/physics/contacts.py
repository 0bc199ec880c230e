"""Contacts: discs that touch push each other apart and rub.

Sequential impulses as in Box2D-Lite (Catto, "Iterative dynamics with temporal coherence", 2005) and Chipmunk:
each contact in turn gets the impulse that stops its approach and, within Coulomb's cone, its sliding; a few
passes over all contacts and drives settle everybody. Nothing bounces. Overlap is mended by a speed of its own
that is forgotten at once, so mending gives nobody momentum. Contacts are taken in the order of keys.
"""

import math

from formicarium.compiled import compiled
from formicarium.physics.geometry import place_along, square_distance
from formicarium.physics.grid import scenery_cell
from formicarium.physics.motion import drive, drive_freely, fastest

SLACK = 0.005  # m, added to what bodies can travel in a cycle: overlap being mended moves them, too
SETTLED = 1e-9  # N s, a pass that changes no impulse by more is the last one
RESTING = 1.1  # overlap that is mended only asymptotically is left alone at this multiple of the slop


@compiled
def find_contacts(world):
    """List the pairs that can touch in this cycle, by keys; return their number and that of their bodies."""
    settings = world.settings[0]
    motions = world.solver.motions
    contacts = world.solver.contacts
    lists = world.lists
    ground = len(world.bodies)
    travel = fastest(motions) * settings.cycle_time + SLACK
    count = 0
    involved_count = 0
    for place in range(len(world.bodies)):
        i = lists[place].order
        motion = motions[i]
        before = count
        for k in range(world.neighbour_count[i]):
            near = world.neighbours[i, k]
            j = near.index
            if near.distance < motion.radius + motions[j].radius + 2.0 * travel:
                motion.involved = 1
                if lists[j].rank > place:
                    # Sorted by insertion: a body has few candidates.
                    at = count
                    while at > before and lists[contacts[at - 1].second].rank > lists[j].rank:
                        pair(contacts, at, i, contacts[at - 1].second, -1)
                        at -= 1
                    pair(contacts, at, i, j, -1)
                    count += 1
        cell = scenery_cell(settings, motion.x, motion.y)
        for member in range(world.scenery[cell], world.scenery[cell + 1]):
            number = world.scenery[member]
            face = world.segments[number]
            square = square_distance(face.ax, face.ay, face.bx, face.by, motion.x, motion.y)
            if square < (motion.radius + travel) * (motion.radius + travel):
                motion.involved = 1
                pair(contacts, count, i, ground, number)
                count += 1
        if motion.involved == 1:
            motions[involved_count].listed = i
            involved_count += 1
    for number in range(count):
        weigh(world, contacts[number])
    return count, involved_count


@compiled
def pair(contacts, at, i, j, segment):
    """Write at a place of the list that body i can touch body j, or a segment."""
    if at >= len(contacts):
        raise ValueError("more bodies overlap than a world has room for")
    contact = contacts[at]
    contact.first = i
    contact.second = j
    contact.segment = segment


@compiled
def weigh(world, contact):
    """Fill in what a contact needs in all sub-steps: its friction and the masses it feels."""
    first = world.solver.motions[contact.first]
    second = world.solver.motions[contact.second]
    contact.friction = world.settings[0].friction
    if contact.segment < 0:
        contact.friction *= world.settings[0].friction
    else:
        contact.friction *= world.segments[contact.segment].friction
    inverse = first.inverse_mass + second.inverse_mass
    contact.normal_mass = 1.0 / inverse
    inverse += first.radius * first.radius * first.inverse_inertia
    inverse += second.radius * second.radius * second.inverse_inertia
    contact.tangent_mass = 1.0 / inverse
    contact.normal_impulse = 0.0
    contact.tangent_impulse = 0.0


@compiled
def touch(solver, segments, settings, contact_count):
    """Find the contacts that touch now and their normals; return how many, and the deepest overlap (m)."""
    touching_count = 0
    deepest = 0.0
    for number in range(contact_count):
        contact = solver.contacts[number]
        first = solver.motions[contact.first]
        second = solver.motions[contact.second]
        if contact.segment < 0:
            dx = second.x - first.x
            dy = second.y - first.y
            reach = first.radius + second.radius
        else:
            face = segments[contact.segment]
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
        solver.contacts[touching_count].listed = number
        touching_count += 1
    return touching_count, deepest


@compiled
def rub(contact, first, second, normal_impulse, tangent_impulse):
    """Change the speeds of two bodies by an impulse (N s) along their normal and one along their rims."""
    impulse_x = normal_impulse * contact.normal_x - tangent_impulse * contact.normal_y
    impulse_y = normal_impulse * contact.normal_y + tangent_impulse * contact.normal_x
    first.speed_x -= impulse_x * first.inverse_mass
    first.speed_y -= impulse_y * first.inverse_mass
    first.turn_rate -= tangent_impulse * first.radius * first.inverse_inertia
    second.speed_x += impulse_x * second.inverse_mass
    second.speed_y += impulse_y * second.inverse_mass
    second.turn_rate -= tangent_impulse * second.radius * second.inverse_inertia


@compiled
def push(contact, first, second):
    """Correct the impulses of one contact; return the greater change (N s)."""
    speed_x = second.speed_x - first.speed_x
    speed_y = second.speed_y - first.speed_y
    approach = speed_x * contact.normal_x + speed_y * contact.normal_y
    sliding = speed_y * contact.normal_x - speed_x * contact.normal_y
    sliding -= first.turn_rate * first.radius + second.turn_rate * second.radius
    normal = max(0.0, contact.normal_impulse - approach * contact.normal_mass)
    most = contact.friction * normal
    tangent = min(most, max(-most, contact.tangent_impulse - sliding * contact.tangent_mass))
    normal_change = normal - contact.normal_impulse
    tangent_change = tangent - contact.tangent_impulse
    contact.normal_impulse = normal
    contact.tangent_impulse = tangent
    rub(contact, first, second, normal_change, tangent_change)
    return max(abs(normal_change), abs(tangent_change))


@compiled
def press(solver, involved_count, touching_count, iterations):
    """Find new speeds: drives and contacts correct their impulses in turn until all are content."""
    motions = solver.motions
    contacts = solver.contacts
    # Free bodies need their drive only; touching ones start with the impulses of the sub-step before.
    for place in range(involved_count):
        motion = motions[motions[place].listed]
        if motion.touched == 0:
            drive_freely(motion)
        else:
            motion.speed_x += motion.impulse_x * motion.inverse_mass
            motion.speed_y += motion.impulse_y * motion.inverse_mass
            motion.turn_rate += motion.impulse_turn * motion.inverse_inertia
    for place in range(touching_count):
        contact = contacts[contacts[place].listed]
        first = motions[contact.first]
        second = motions[contact.second]
        rub(contact, first, second, contact.normal_impulse, contact.tangent_impulse)
    for _ in range(iterations):
        change = 0.0
        for place in range(involved_count):
            motion = motions[motions[place].listed]
            if motion.touched == 1:
                change = max(change, drive(motion))
        for place in range(touching_count):
            contact = contacts[contacts[place].listed]
            change = max(change, push(contact, motions[contact.first], motions[contact.second]))
        if change < SETTLED:
            break


@compiled
def part(solver, involved_count, touching_count, iterations, time):
    """Mend overlap: move touching bodies apart by a share of it, without giving them speed."""
    motions = solver.motions
    contacts = solver.contacts
    for _ in range(iterations):
        for place in range(touching_count):
            contact = contacts[contacts[place].listed]
            first = motions[contact.first]
            second = motions[contact.second]
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
        motion = motions[motions[place].listed]
        motion.x += motion.shift_x * time
        motion.y += motion.shift_y * time
        motion.shift_x = 0.0
        motion.shift_y = 0.0

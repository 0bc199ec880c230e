"""The range-and-bearing board: four-byte packets with the distance and bearing of their sender."""

import math

from formicarium.angles import wrapped
from formicarium.compiled import compiled
from formicarium.physics.rays import bodies_in_line_of_sight, look_round
from formicarium.robots.records import EMITTERS, PAYLOAD
from formicarium.robots.simulated.channels import RADIO
from formicarium.streams import advanced, derived, mixed, normal, uniform


@compiled
def emitter_towards(direction):
    """Return which of the twelve emitters covers ``direction`` (rad, sender's frame): k covers k*30 +- 15 deg."""
    return int(math.floor(direction * (EMITTERS / (2.0 * math.pi)) + 0.5)) % EMITTERS


@compiled
def receive(robot, packet, sender, emitter, distance, direction, noise, epuck, reading):
    """Hand over one packet, with noise, unless it is lost.

    distance + N(0, max(0.25 d, 0.03 m)), bearing + N(0, 8 deg).
    """
    if uniform(noise) < epuck.radio_loss:
        return
    noise = advanced(noise)
    spread = max(epuck.radio_distance_noise * distance, epuck.radio_distance_noise_floor)
    packet.distance = max(0.0, distance + spread * normal(noise))
    noise = advanced(noise)
    packet.bearing = wrapped(direction + epuck.radio_bearing_noise * normal(noise))
    for k in range(PAYLOAD):
        packet.payload[k] = sender.payload[emitter, k]
    reading.packet_count += 1
    robot.packets_heard += 1


@compiled
def sense_packets(world, i, robots, commands, queue, epuck, moment, reading):
    """Receive what the neighbours in range and in line of sight sent through the emitter that points here.

    At most ``radio_capacity`` packets come through in a cycle, drawn at random among the audible ones: every
    visible sender gets a random place in the queue (scratch, one record a neighbour), which is served until it
    is empty or the capacity is used up. Lost packets count against the capacity.
    """
    body = world.bodies[i]
    reading.packet_count = 0
    waiting = 0
    look_round(world, i)
    for n in range(world.neighbour_count[i]):
        neighbour = world.neighbours[i, n]
        if robots[neighbour.index].speaking == 0 or neighbour.distance >= epuck.radio_range:
            continue
        if not bodies_in_line_of_sight(world, i, n):
            continue
        draw = derived(moment, RADIO + robots[neighbour.index].key)
        place = waiting
        while place > 0 and queue[place - 1].draw > draw:
            queue[place].draw = queue[place - 1].draw
            queue[place].neighbour = queue[place - 1].neighbour
            place -= 1
        queue[place].draw = draw
        queue[place].neighbour = n
        waiting += 1
    used = 0
    for place in range(waiting):
        if used == epuck.radio_capacity:
            break
        neighbour = world.neighbours[i, queue[place].neighbour]
        j = neighbour.index
        line = math.atan2(neighbour.dy, neighbour.dx)
        emitter = emitter_towards(line + math.pi - world.bodies[j].heading)
        if commands[j].enabled[emitter] == 0:
            continue
        used += 1
        noise = advanced(mixed(queue[place].draw))
        packet = reading.packets[reading.packet_count]
        receive(
            robots[i],
            packet,
            commands[j],
            emitter,
            neighbour.distance,
            line - body.heading,
            noise,
            epuck,
            reading,
        )

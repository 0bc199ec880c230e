"""The phases of a control cycle for robots that hear range and bearing of whoever speaks.

As in ``trial.phases``, whatever was said and commanded in one cycle is heard and seen in the next: one hop a cycle.
"""

from formicarium.compiled import compiled
from formicarium.physics.grid import find_neighbours
from formicarium.physics.sliding import drift, slide
from formicarium.robots.footbot import PACKETS
from formicarium.robots.simulated.beacon import sense_beacon
from formicarium.robots.simulated.channels import RADIO
from formicarium.robots.simulated.chassis import push_off, sense_way, turn_foot_wheels
from formicarium.robots.simulated.situated import find_sight, hear, measure_speaker
from formicarium.streams import advanced, derived, uniform


@compiled
def sense(state):
    """Fill in every living robot's Reading."""
    cycle = state.clock[0].cycle
    footbot = state.footbot[0]
    for i in range(len(state.robots)):
        if state.robots[i].alive == 1:
            reading = state.readings[i]
            reading.identity = state.robots[i].identity
            reading.cycle = cycle
            sense_way(state.chassis[i], reading)
            sense_beacon(state.world.bodies[i], state.beacons, footbot.beacon_range, reading)
    spread_word(state, footbot, cycle)


@compiled
def spread_word(state, footbot, cycle):
    """Hand every living speaker's message of the last cycle to the living in range and, with occlusion, in sight.

    Speaker by speaker in the order of keys, so that whoever listens hears them in that order. A message is lost with
    probability ``radio_loss``, for each receiver by itself: links are directed.
    """
    for i in range(len(state.robots)):
        state.readings[i].packet_count = 0
    entry_of = state.entry_of
    for place in range(len(state.robots)):
        j = state.world.lists[place].order
        if state.robots[j].alive == 0 or state.robots[j].speaking == 0:
            continue
        command = state.commands[j]
        for e in range(command.message.entry_count - 1, -1, -1):
            entry_of[command.message.entries[e].receiver] = e + 1
        for n in range(state.world.neighbour_count[j]):
            near = state.world.neighbours[j, n]
            i = near.index
            if state.robots[i].alive == 0 or near.distance > footbot.radio_range:
                continue
            if footbot.occlusion == 1 and state.sight[i, j] == 0:
                continue
            noise = advanced(derived(derived(state.robots[i].noise, cycle), RADIO + state.robots[j].key))
            if uniform(noise) < footbot.radio_loss:
                continue
            reading = state.readings[i]
            if reading.packet_count == PACKETS:
                continue
            packet = reading.packets[reading.packet_count]
            hear(packet, command.message, entry_of[reading.identity] - 1)
            measure_speaker(packet, near, state.world.bodies[i].heading, noise, footbot)
            reading.packet_count += 1
            state.robots[i].packets_heard += 1
            state.heard[i, j] = cycle
        for e in range(command.message.entry_count):
            entry_of[command.message.entries[e].receiver] = 0


@compiled
def act(state):
    """Carry out every Command; the dead stand still and say nothing."""
    cycle = state.clock[0].cycle
    cycle_time = state.world.settings[0].cycle_time
    footbot = state.footbot[0]
    for i in range(len(state.robots)):
        robot = state.robots[i]
        command = state.commands[i]
        if robot.alive == 1 and robot.dies_at == cycle:
            robot.alive = 0
        if robot.alive == 0:
            fall_silent(command, state.chassis[i])
        robot.speaking = command.enabled[0]
        if footbot.holonomic == 1:
            push_off(state.world.bodies[i], robot, state.chassis[i], command, footbot, cycle_time)
        else:
            moment = derived(robot.noise, cycle)
            turn_foot_wheels(state.world.bodies[i], robot, state.chassis[i], command, footbot, moment, cycle_time)


@compiled
def fall_silent(command, chassis):
    """Empty the Command of a dead robot: its body stays, a thing among things (U31)."""
    command.ahead = 0.0
    command.aside = 0.0
    command.left = 0.0
    command.right = 0.0
    command.colour = 0
    command.enabled[0] = 0
    command.message.bytes = 0
    chassis.left_now = 0.0
    chassis.right_now = 0.0


@compiled
def move(state):
    """Let the bodies move for one control cycle, nobody pushed, and see who is in whose sight then."""
    if state.footbot[0].holonomic == 1:
        drift(state.world)
    else:
        slide(state.world)
    look(state)


@compiled
def look(state):
    """Find who is near whom and in sight."""
    find_neighbours(state.world)
    find_sight(state.world, state.sight, state.footbot[0].radio_range, state.rows)

"""The phases of a control cycle that are the same in every system. A system's ``loop.py`` puts them in order.

The state that they are handed is a NamedTuple of record arrays; each phase names in its code what it uses.
Whatever was commanded in one cycle is seen, heard and felt in the next: nobody acts on what has not been done.
"""

from formicarium.compiled import compiled
from formicarium.physics.grid import find_neighbours
from formicarium.physics.step import step
from formicarium.robots.records import SILENCE, Colour
from formicarium.robots.simulated.camera import sense_blobs
from formicarium.robots.simulated.proximity import sense_proximity
from formicarium.robots.simulated.radio import sense_packets
from formicarium.robots.simulated.wheels import sense_steps, turn_wheels
from formicarium.streams import derived


@compiled
def sense(state):
    """Fill in every living robot's Reading from the world and from what the others did in the last cycle.

    Sensor by sensor, not robot by robot: the same numbers, in less time.
    """
    cycle = state.clock[0].cycle
    epuck = state.epuck[0]
    for i in range(len(state.robots)):
        robot = state.robots[i]
        if robot.alive == 1:
            reading = state.readings[i]
            reading.identity = robot.identity
            reading.cycle = cycle
            reading.infrared = robot.infrared_heard
            sense_proximity(state.world, i, epuck, derived(robot.noise, cycle), reading)
            sense_steps(robot, epuck, reading)
    for i in range(len(state.robots)):
        robot = state.robots[i]
        if robot.alive == 1:
            moment = derived(robot.noise, cycle)
            sense_blobs(state.world, i, state.robots, state.commands, state.lights, epuck, moment, state.readings[i])
    for i in range(len(state.robots)):
        robot = state.robots[i]
        if robot.alive == 1:
            moment = derived(robot.noise, cycle)
            sense_packets(state.world, i, state.robots, state.commands, state.queue, epuck, moment, state.readings[i])


@compiled
def act(state):
    """Carry out every Command: wheels turn; the dead fall dark and silent."""
    cycle = state.clock[0].cycle
    cycle_time = state.world.settings[0].cycle_time
    for i in range(len(state.robots)):
        robot = state.robots[i]
        command = state.commands[i]
        if robot.alive == 1 and robot.dies_at == cycle:
            robot.alive = 0
        if robot.alive == 0:
            fall_silent(command)
        robot.speaking = speaks(command)
        turn_wheels(state.world.bodies[i], robot, command, state.epuck[0], derived(robot.noise, cycle), cycle_time)


@compiled
def fall_silent(command):
    """Empty the Command of a dead robot: its body stays, a thing among things (U31)."""
    command.left = 0.0
    command.right = 0.0
    command.colour = Colour.OFF
    command.infrared = SILENCE
    command.enabled[:] = 0


@compiled
def speaks(command):
    """Return 1 if any emitter of the radio is on."""
    for k in range(len(command.enabled)):
        if command.enabled[k] == 1:
            return 1
    return 0


@compiled
def move(state):
    """Let physics run for one control cycle."""
    step(state.world)
    find_neighbours(state.world)

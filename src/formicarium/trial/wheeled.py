"""The phases of a control cycle for robots with wheels, a forward camera and ground sensors, and no radio.

As in ``trial.phases``, whatever was commanded in one cycle is seen in the next.
"""

from formicarium.compiled import compiled
from formicarium.physics.grid import find_neighbours
from formicarium.physics.kinematics import glide
from formicarium.physics.step import step
from formicarium.robots.simulated.forward_camera import sense_sights
from formicarium.robots.simulated.ground import sense_ground
from formicarium.robots.simulated.light import sense_light
from formicarium.robots.simulated.proximity import sense_proximity
from formicarium.robots.simulated.wheels import sense_steps, turn_wheels
from formicarium.streams import derived


@compiled
def sense(state):
    """Fill in every living robot's Reading."""
    cycle = state.clock[0].cycle
    for i in range(len(state.robots)):
        robot = state.robots[i]
        if robot.alive == 1:
            reading = state.readings[i]
            moment = derived(robot.noise, cycle)
            reading.identity = robot.identity
            reading.cycle = cycle
            reading.busy = 1 if cycle < state.grips[i].busy_until else 0
            sense_proximity(state.world, i, state.epuck[0], moment, reading)
            sense_light(state.world.bodies[i], state.lamp[0], state.sight[0], moment, reading)
            sense_ground(state.world.bodies[i], state.floor, state.sight[0], moment, reading)
            sense_steps(robot, state.epuck[0], reading)
    for i in range(len(state.robots)):
        if state.robots[i].alive == 1:
            moment = derived(state.robots[i].noise, cycle)
            sense_sights(state.world, i, state.lights, state.sight[0], moment, state.readings[i])


@compiled
def act(state):
    """Turn the wheels as commanded; those of the dead stand still."""
    cycle = state.clock[0].cycle
    cycle_time = state.world.settings[0].cycle_time
    for i in range(len(state.robots)):
        robot = state.robots[i]
        command = state.commands[i]
        if robot.alive == 1 and robot.dies_at == cycle:
            robot.alive = 0
        if robot.alive == 0:
            command.left = 0.0
            command.right = 0.0
        turn_wheels(state.world.bodies[i], robot, command, state.epuck[0], derived(robot.noise, cycle), cycle_time)


@compiled
def move(state):
    """Let the bodies move for one control cycle: without forces, or with them if the trial asks for it."""
    if state.swarm[0].contact == 1:
        step(state.world)
    else:
        glide(state.world)
    find_neighbours(state.world)

"""The phases of a control cycle for a swarm of one's own: those of ``trial.phases``, with every sensor."""

import math

from formicarium.compiled import compiled
from formicarium.devices.shelter import serve_shelters
from formicarium.robots.simulated.ground import sense_ground
from formicarium.robots.simulated.light import sense_lamps
from formicarium.streams import derived
from formicarium.trial.events import write_event
from formicarium.trial.phases import act as act_as_commanded
from formicarium.trial.phases import move
from formicarium.trial.phases import sense as sense_others

__all__ = ["act", "move", "note_roles", "sense", "serve"]

ROLE = 0  # event kinds that every swarm has; a system's own come after them
DIED = 1


@compiled
def sense(state):
    """Fill in every living robot's Reading."""
    sense_others(state)
    cycle = state.clock[0].cycle
    for i in range(len(state.robots)):
        robot = state.robots[i]
        if robot.alive == 1:
            moment = derived(robot.noise, cycle)
            sense_lamps(state.world.bodies[i], state.lamps, state.sight[0], moment, state.readings[i])
            sense_ground(state.world.bodies[i], state.floor, state.sight[0], moment, state.readings[i])


@compiled
def act(state):
    """Carry out every Command; one that is no number ends the trial, and is reported when it has ended."""
    refuse_no_numbers(state)
    act_as_commanded(state)


@compiled
def refuse_no_numbers(state):
    """End the trial at the first commanded speed that is no number; such wheels stand still."""
    for i in range(len(state.robots)):
        command = state.commands[i]
        if state.robots[i].alive == 1 and not (math.isfinite(command.left) and math.isfinite(command.right)):
            if state.trouble[0].robot == 0:
                state.trouble[0].robot = state.robots[i].identity
                state.trouble[0].cycle = state.clock[0].cycle
                state.clock[0].finished = 1
            command.left = 0.0
            command.right = 0.0


@compiled
def serve(state):
    """Let the booths notice who is inside."""
    serve_shelters(state.booths, state.lights, state.world.bodies, state.clock[0].cycle)


@compiled
def note_roles(state):
    """Log every change of a memory's ``role``, and deaths. Nothing here is seen by a robot."""
    clock = state.clock[0]
    for i in range(len(state.robots)):
        robot = state.robots[i]
        if robot.alive == 0:
            if robot.dies_at == clock.cycle:
                write_event(clock, state.events, DIED, robot.identity, 0, state.memories[i].role, 0)
        elif state.memories[i].role != state.seen[i].role:
            write_event(clock, state.events, ROLE, robot.identity, 0, state.memories[i].role, state.seen[i].role)
            state.seen[i].role = state.memories[i].role

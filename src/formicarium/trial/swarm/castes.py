"""Robots of several castes in one swarm: each with a table of its own for body, wheels, sensors and radio.

A loop that takes ``sense`` and ``act`` from here instead of from ``trial.swarm.phases`` gives every robot the numbers
of its caste, ``state.epuck[state.castes[i]]``. All are discs with the senses of an e-puck, but as large, heavy, fast
and sharp-eyed as their tables say; views draw them all in the size of the parameters' group ``epuck``. A memory's field
``caste`` tells a robot what it is.
"""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from formicarium.compiled import compiled
from formicarium.robots.epuck import Epuck
from formicarium.robots.simulated.camera import sense_blobs
from formicarium.robots.simulated.ground import sense_ground
from formicarium.robots.simulated.light import sense_lamps
from formicarium.robots.simulated.proximity import sense_proximity
from formicarium.robots.simulated.radio import sense_packets
from formicarium.robots.simulated.wheels import sense_steps, turn_wheels
from formicarium.streams import derived
from formicarium.trial.phases import fall_silent, speaks
from formicarium.trial.swarm.phases import refuse_no_numbers

BODILY = ("radius", "mass", "inertia", "force_limit", "torque_limit")  # numbers of a table that physics knows


class Caste(NamedTuple):
    """Robots that are alike."""

    robots: int
    epuck: Epuck  # body, wheels, sensors and radio


def castes_by_key(castes: Sequence[Caste], robots: int) -> np.ndarray:
    """Return the number of each robot's caste, (N,), in the order of keys: the first caste's robots come first.

    Raises:
        ValueError: if the castes are not as many robots as there are.
    """
    counts = [caste.robots for caste in castes]
    if min(counts, default=-1) < 0 or sum(counts) != robots:
        raise ValueError(f"castes of {counts} robots: they must make the {robots} of swarm.robots")
    return np.repeat(np.arange(len(counts)), counts)


def embody(bodies: np.recarray, numbers: np.ndarray, castes: Sequence[Caste]) -> None:
    """Give every body (N,) the numbers of its robot's caste, by ``numbers`` (N,) at the same places."""
    for number, caste in enumerate(castes):
        for name in BODILY:
            bodies[name][numbers == number] = getattr(caste.epuck, name)


@compiled
def sense(state):
    """Fill in every living robot's Reading, with the sensors of its caste."""
    cycle = state.clock[0].cycle
    for i in range(len(state.robots)):
        robot = state.robots[i]
        if robot.alive == 1:
            reading = state.readings[i]
            epuck = state.epuck[state.castes[i]]
            moment = derived(robot.noise, cycle)
            reading.identity = robot.identity
            reading.cycle = cycle
            reading.infrared = robot.infrared_heard
            sense_proximity(state.world, i, epuck, moment, reading)
            sense_steps(robot, epuck, reading)
            sense_blobs(state.world, i, state.robots, state.commands, state.lights, epuck, moment, reading)
            sense_packets(state.world, i, state.robots, state.commands, state.queue, epuck, moment, reading)
            sense_lamps(state.world.bodies[i], state.lamps, state.sight[0], moment, reading)
            sense_ground(state.world.bodies[i], state.floor, state.sight[0], moment, reading)


@compiled
def act(state):
    """Carry out every Command with the wheels of its caste; the dead fall dark and silent."""
    refuse_no_numbers(state)
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
        epuck = state.epuck[state.castes[i]]
        turn_wheels(state.world.bodies[i], robot, command, epuck, derived(robot.noise, cycle), cycle_time)

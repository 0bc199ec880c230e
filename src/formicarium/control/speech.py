"""Filling in the twelve emitters of the range-and-bearing board."""

import math

from formicarium.angles import wrapped
from formicarium.compiled import compiled
from formicarium.robots.records import EMITTERS, PAYLOAD, SILENCE, Colour


@compiled
def be_quiet(command):
    """Stand still with lights, radio and infrared off: the start of every cycle's command."""
    command.left = 0.0
    command.right = 0.0
    command.colour = Colour.OFF
    command.infrared = SILENCE
    for k in range(EMITTERS):
        command.enabled[k] = 0


@compiled
def broadcast(command):
    """Send the bytes of emitter 0 through all emitters."""
    for k in range(EMITTERS):
        command.enabled[k] = 1
        for n in range(PAYLOAD):
            command.payload[k, n] = command.payload[0, n]


@compiled
def in_sector(direction, centre, half_width):
    """Tell whether a direction lies within ``half_width`` of the sector's centre (rad)."""
    return abs(wrapped(direction - centre)) <= half_width


@compiled
def emitter_direction(emitter):
    """Return where an emitter points, rad from the heading."""
    return emitter * (2.0 * math.pi / EMITTERS)

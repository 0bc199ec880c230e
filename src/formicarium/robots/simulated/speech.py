"""A short-range broadcast: what is said is heard by whoever is near and in line of sight, without loss or noise."""

from formicarium.compiled import compiled
from formicarium.physics.rays import bodies_in_line_of_sight, look_round
from formicarium.robots.forager import HEARD


@compiled
def sense_speech(world, i, robots, voices, reach):
    """Hear the living neighbours that speak, nearer than ``reach`` (m) and in line of sight, by their identities."""
    own = voices[i]
    own.heard_count = 0
    look_round(world, i)
    for n in range(world.neighbour_count[i]):
        neighbour = world.neighbours[i, n]
        j = neighbour.index
        if voices[j].speaking == 0 or robots[j].alive == 0 or neighbour.distance >= reach:
            continue
        if not bodies_in_line_of_sight(world, i, n):
            continue
        # Sorted by identity, so that the order of robots in memory does not matter.
        place = own.heard_count
        while place > 0 and own.heard[place - 1].identity > voices[j].said.identity:
            place -= 1
        if place == HEARD:
            continue
        last = min(own.heard_count, HEARD - 1)
        for later in range(last, place, -1):
            copy_words(own.heard[later], own.heard[later - 1])
        copy_words(own.heard[place], voices[j].said)
        own.heard_count = last + 1


@compiled
def copy_words(words, others):
    """Write one utterance over another."""
    words.identity = others.identity
    for k in range(len(words.times)):
        words.times[k] = others.times[k]
        words.ages[k] = others.ages[k]

"""A task is done inside a booth or not at all (T16)."""

import numpy as np

from formicarium.devices.booth import HALF, placed
from formicarium.physics.world import chain, joined
from formicarium.systems.sequencing.arena import make_arena
from formicarium.systems.sequencing.loop import run
from formicarium.systems.sequencing.measures import EventKind
from formicarium.systems.sequencing.parameters import mark_i3_parameters
from formicarium.systems.sequencing.setup import begin
from formicarium.trial.simulate import simulate


def events(blocked):
    """Return the events of a trial of 600 s whose booths have, or have not, a low wall before their mouths."""
    parameters = mark_i3_parameters(swarm={"time_cap": 600.0})
    arena = make_arena(parameters.arena, parameters.booth.friction)
    if blocked:
        doors = [chain([placed(*booth, -HALF, -HALF), placed(*booth, -HALF, HALF)]) for booth in arena.booths]
        arena = arena._replace(segments=joined(arena.segments, *doors))
    return simulate(run, begin(parameters, 3, arena=arena))


def test_blocked_mouths_mean_no_executions():
    kinds = events(blocked=True)["kind"]
    for kind in (EventKind.EXECUTED, EventKind.VISIT, EventKind.SEQUENCE):
        assert np.sum(kinds == kind) == 0
    assert np.sum(events(blocked=False)["kind"] == EventKind.EXECUTED) > 0

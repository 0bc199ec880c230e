"""The main loop taken apart where the robots decide, for controllers outside the simulator."""

from typing import Any

from formicarium.compiled import compiled
from formicarium.devices.service import serve_booths
from formicarium.systems.sequencing.measures import note
from formicarium.trial.onboard import Onboard
from formicarium.trial.phases import act, move, sense


@compiled
def after(state):
    """Let the world go on from the commands: act, move, serve, note, as in ``loop.run``."""
    clock = state.clock[0]
    act(state)
    move(state)
    serve_booths(
        state.booths,
        state.lights,
        state.coordinator[0],
        state.robots,
        state.world.bodies,
        state.commands,
        state.booth_table[0],
        clock.cycle,
        state.world.settings[0].cycle_time,
    )
    note(state)
    clock.cycle += 1


def tables(state: Any) -> tuple[Any, ...]:
    """Return what every robot is given: the numbers of its behaviour and of its own body."""
    return state.behaviour, state.epuck


ONBOARD = Onboard("formicarium.systems.sequencing.behaviour:decide", tables, sense, after)

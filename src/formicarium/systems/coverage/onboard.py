"""The main loop taken apart where the robots decide, for controllers outside the simulator."""

from typing import Any

from formicarium.compiled import compiled
from formicarium.systems.coverage.measures import note
from formicarium.trial.onboard import Onboard
from formicarium.trial.situated import act, move, sense


@compiled
def after(state):
    """Let the world go on from the commands: act, move, note, as in ``loop.run``."""
    act(state)
    move(state)
    note(state)
    state.clock[0].cycle += 1


def tables(state: Any) -> tuple[Any, ...]:
    """Return what robots are given: numbers of their behaviour, each its own chart, and their bodies'."""
    return state.behaviour, state.charts, state.footbot


ONBOARD = Onboard("formicarium.systems.coverage.behaviour:decide", tables, sense, after)

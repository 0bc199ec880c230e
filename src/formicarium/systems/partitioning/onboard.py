"""The main loop taken apart where the robots decide, for controllers outside the simulator."""

from typing import Any

from formicarium.systems.partitioning.loop import go_on
from formicarium.trial.onboard import Onboard
from formicarium.trial.wheeled import sense


def tables(state: Any) -> tuple[Any, ...]:
    """Return what every robot is given: numbers of its behaviour and strategy, its chart, its own body.

    Raises:
        ValueError: if robots talk (TP-O3): what they hear is no part of a Reading, so it reaches no controller outside.
    """
    if state.strategy[0].social_weight > 0.0:
        raise ValueError("strategy.social_weight: must be 0 where robots decide outside the loop: they cannot talk")
    return state.behaviour, state.strategy, state.chart, state.epuck


ONBOARD = Onboard("formicarium.systems.partitioning.behaviour:decide", tables, sense, go_on)

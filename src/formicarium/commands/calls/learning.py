"""Environments for learning from Python."""

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from pydantic import BaseModel

from formicarium.commands.errors import UserError
from formicarium.commands.extras import require
from formicarium.commands.known import find_system

if TYPE_CHECKING:  # needs the extra
    from formicarium.learning.environment import SwarmEnvironment


def parallel_env(
    system: str,
    *,
    parameters: BaseModel | None = None,
    reward: Callable[[Any, np.ndarray], float | np.ndarray] | None = None,
    observe: Sequence[str] | None = None,
    act: Sequence[str] | None = None,
) -> "SwarmEnvironment":
    """Return a system as a PettingZoo ``ParallelEnv``, one agent a robot, one step a control cycle; extra "rl".

    Args:
        system: a name of ``system_names()``, or "module:object".
        parameters: all its numbers; the defaults if None.
        reward: (state after the cycle, events of the cycle) -> a number for all robots, or (N,) in the order of
            ``state.robots``. It sees everything, as observers do. None: 0.0.
        observe: fields of the Reading that are observed; all if None.
        act: fields of the Command that the learner decides; all if None, but for messages that are records of many
            parts. The others are decided by the system's own behaviour, which then also keeps the robot's memory.

    Raises:
        UserError: if the extra is missing, there is no such system or field, or the system does not say where its
            robots decide.
    """
    require("rl", "formicarium.parallel_env")
    from formicarium.learning.environment import SwarmEnvironment

    found = find_system(system)
    try:
        return SwarmEnvironment(found, parameters or found.configure(), reward, observe, act)
    except ValueError as error:
        raise UserError(str(error)) from error

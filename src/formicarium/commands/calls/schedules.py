"""Task schedules from Python: the same answers as ``formicarium schedule``."""

from collections.abc import Mapping
from numbers import Integral, Real
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

from formicarium.commands.errors import UserError
from formicarium.commands.extras import require
from formicarium.scheduling.instance import Instance, is_number
from formicarium.scheduling.reading import instance_of, read_instance

if TYPE_CHECKING:  # what solves and answers needs the extra
    from formicarium.scheduling.schedule import Answer


def schedule(
    tasks: str | Path | Mapping[str, Any] | Instance,
    *,
    robots: int | None = None,
    objective: Literal["time", "travel"] = "travel",
    reach: Literal["printed", "inscribed", "euclid"] = "inscribed",
    time_limit: float | None = None,
    first_hop_free: bool = False,
) -> "Answer":
    """Schedule tasks for a swarm that must stay connected, proven best or with a gap; needs the extra "scheduling".

    Args:
        tasks: a file (.toml, .json, .csv), its content, or an Instance of ``formicarium.scheduling``. Places in metres,
            durations in any one unit.
        robots: in the swarm, one of them the master; where teams are not listed.
        objective: "time": the least completion time; "travel": among the schedules of that time the one whose robots
            travel least, metres times robots.
        reach: shape of the area that an arm of n hops reaches: the octagon inside the radio's circle, the circle
            itself, or the paper's octagon around it.
        time_limit: seconds after which the best schedule so far is the answer; none if None.
        first_hop_free: leave the way from the start to the first deployment point out of "travel", as the paper's (14).

    Returns:
        ``value`` and ``bound`` that no schedule can beat, ``gap``, ``proven``, and ``schedule.slots``: x and y (m) of
        the master, duration, and the arms with their relays.

    Raises:
        UserError: if the extra is missing, an option is none of those above, or robots are given with an Instance.
        InstanceError: if the tasks cannot be scheduled; names task or field, and why.
    """
    require("scheduling", "formicarium.schedule")
    from formicarium.scheduling.solver import solve

    allowed = {"objective": ("time", "travel"), "reach": ("printed", "inscribed", "euclid")}
    for name, value in (("objective", objective), ("reach", reach)):
        if value not in allowed[name]:
            raise UserError(f"{name} = {value!r}: must be one of {', '.join(allowed[name])}")
    if robots is not None and not (is_number(robots, Integral) and robots > 0):
        raise UserError(f"robots = {robots!r}: must be a whole number above 0, or None")
    if time_limit is not None and not (is_number(time_limit, Real) and time_limit > 0):
        raise UserError(f"time_limit = {time_limit!r}: must be seconds above 0, or None")
    swarm = None if robots is None else int(robots)
    return solve(_instance(tasks, swarm), objective, reach, time_limit, charge_first=not first_hop_free)


def _instance(tasks: str | Path | Mapping[str, Any] | Instance, robots: int | None) -> Instance:
    if isinstance(tasks, Instance):
        if robots is not None:
            raise UserError(f"robots = {robots}: an Instance has its teams; leave robots away")
        return tasks
    if isinstance(tasks, Mapping):
        return instance_of(tasks, "tasks", robots)
    return read_instance(tasks, robots)

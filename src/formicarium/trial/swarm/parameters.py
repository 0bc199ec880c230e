"""The numbers that every swarm has. A system adds its own groups to ``SwarmParameters``."""

from collections.abc import Callable, Mapping
from typing import Any

from pydantic import BaseModel, ConfigDict

from formicarium.robots.epuck import Epuck, EpuckSight
from formicarium.tables import Table, number


class SwarmTable(Table):
    """How many robots, for how long, and which of them fail."""

    robots: int = number(20, "1", "how many", ge=1, le=250)
    time_cap: float = number(600.0, "s", "a trial ends here at the latest", gt=0, le=1e6)
    cycle_time: float = number(0.1, "s", "one control cycle: sense, decide, act", ge=0.01, le=1)
    failure_rate: float = number(0.0, "1/s", "rate at which a robot dies", ge=0, le=10)
    deaths: tuple[tuple[int, float], ...] = number((), "1, s", "robots that die at a set time: (number, seconds)")


class SwarmParameters(BaseModel):
    """What a trial is, in nested tables. Groups named ``arena`` and ``behaviour`` are the system's own."""

    model_config = ConfigDict(extra="forbid", frozen=True, validate_default=True)

    swarm: SwarmTable = SwarmTable()
    epuck: Epuck = Epuck()
    sight: EpuckSight = EpuckSight()


def configuring(
    parameters: type[BaseModel], settings: Mapping[int, Mapping[str, Mapping[str, Any]]]
) -> Callable[..., Any]:
    """Return the function that a System calls ``configure``.

    Args:
        parameters: type of the parameters.
        settings: number of a setting -> group -> number of that group -> value, where it differs from the default.
    """

    def configure(setting: int | None = None, robots: int | None = None) -> Any:
        if setting is not None and setting not in settings:
            known = ", ".join(map(str, sorted(settings)))
            raise ValueError(f"setting {setting} is not one of {known}" if known else "this system has no settings")
        content: dict[str, dict[str, Any]] = {
            group: dict(values) for group, values in (settings[setting] if setting is not None else {}).items()
        }
        if robots is not None:
            content.setdefault("swarm", {})["robots"] = robots
        return parameters.model_validate(content)

    return configure

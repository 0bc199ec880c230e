"""Task schedules of a connected swarm, solved to proven optimality (Panerati et al. 2018, III-C); no simulator needed.

from formicarium.scheduling import read_instance, solve
answer = solve(read_instance("tasks.toml"), time_limit=60)
print(answer.value, answer.bound, answer.schedule)
"""

from typing import Any

__all__ = ["Answer", "Instance", "InstanceError", "Task", "Team", "check", "draw_instance", "read_instance", "solve"]

_HOMES = {
    "Answer": "schedule",
    "Instance": "instance",
    "InstanceError": "instance",
    "Task": "instance",
    "Team": "instance",
    "check": "checker",
    "draw_instance": "generator",
    "read_instance": "reading",
    "solve": "solver",
}


def __getattr__(name: str) -> Any:
    """Import a public name when it is asked for: reading an instance needs neither Numba nor HiGHS."""
    from importlib import import_module

    if name not in _HOMES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(f"{__name__}.{_HOMES[name]}"), name)

"""Robot swarms that organise their own work: run, watched, measured and compared.

What a program or a notebook needs is here; each name is imported when it is first used::

    import formicarium

    trial = formicarium.run_trial("mark-i3", seed=7)
    results = formicarium.run_set("mark-i3", range(1, 31), out="thirty")
    formicarium.plot_run_times(results, "thirty.png")
    answer = formicarium.schedule("tasks.csv", robots=12)
    swarm = formicarium.connectivity_of(positions, reach=0.6, method="PI1")
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from formicarium.commands.calls.drawing import plot_run_times as plot_run_times
    from formicarium.commands.calls.graphs import connectivity_of as connectivity_of
    from formicarium.commands.calls.learning import parallel_env as parallel_env
    from formicarium.commands.calls.results import Results as Results
    from formicarium.commands.calls.results import load_results as load_results
    from formicarium.commands.calls.running import parameters as parameters
    from formicarium.commands.calls.running import run_campaign as run_campaign
    from formicarium.commands.calls.running import run_set as run_set
    from formicarium.commands.calls.running import run_trial as run_trial
    from formicarium.commands.calls.schedules import schedule as schedule
    from formicarium.contracts.checking import check_system as check_system
    from formicarium.systems.registry import names as system_names
    from formicarium.trial.record import Trial as Trial

__version__ = "0.1.0"

# name -> where it is. The function is called connectivity_of because Python itself gives the name connectivity to the
# room of that name, as soon as anything in it is imported.
_PLACES = {
    "system_names": "formicarium.systems.registry:names",
    "parameters": "formicarium.commands.calls.running:parameters",
    "run_trial": "formicarium.commands.calls.running:run_trial",
    "run_set": "formicarium.commands.calls.running:run_set",
    "run_campaign": "formicarium.commands.calls.running:run_campaign",
    "load_results": "formicarium.commands.calls.results:load_results",
    "plot_run_times": "formicarium.commands.calls.drawing:plot_run_times",
    "schedule": "formicarium.commands.calls.schedules:schedule",
    "connectivity_of": "formicarium.commands.calls.graphs:connectivity_of",
    "parallel_env": "formicarium.commands.calls.learning:parallel_env",
    "check_system": "formicarium.contracts.checking:check_system",
    "Results": "formicarium.commands.calls.results:Results",
    "Trial": "formicarium.trial.record:Trial",
}
__all__ = [
    "Results",
    "Trial",
    "check_system",
    "connectivity_of",
    "load_results",
    "parallel_env",
    "parameters",
    "plot_run_times",
    "run_campaign",
    "run_set",
    "run_trial",
    "schedule",
    "system_names",
]


def __getattr__(name: str) -> Any:
    if name not in _PLACES:
        raise AttributeError(f"formicarium has no {name}; it has {', '.join(__all__)}")
    module, _, attribute = _PLACES[name].partition(":")
    found = globals()[name] = getattr(import_module(module), attribute)
    return found


def __dir__() -> list[str]:
    return sorted([*globals(), *__all__])

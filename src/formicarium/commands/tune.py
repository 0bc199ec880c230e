"""``formicarium tune SYSTEM``: search for better numbers, and say honestly how much better they are."""

from typing import Annotated

from cyclopts import Parameter

from formicarium.commands.whole import Whole


def tune(
    system: str,
    /,
    *,
    over: Annotated[list[str], Parameter(negative="")],
    target: str,
    most: Annotated[bool, Parameter(negative="")] = False,
    points: Whole = 16,
    seeds: Whole = 4,
    held_back: Whole = 20,
    first_seed: Whole = 1_000_000,
    set_: Annotated[list[str] | None, Parameter(name="--set", negative="")] = None,
    out: str | None = None,
    workers: Whole | None = None,
) -> int:
    """Search a system's numbers on tuning seeds, and report the best on seeds that the search has not seen.

    Points are spread evenly over the ranges, the default among them. In every
    round the better half stays and is run on twice as many seeds. What is
    left is then held against the default on held-back seeds: that is the
    result, the score of the search is not. Run again, it goes on.

    Examples:

        formicarium tune my-swarm --over stay=0.01:0.5 --over near=0.1:0.4 --target time_gathered_s

    Parameters
    ----------
    system
        Name of the system; list them with: formicarium systems
    over
        NAME=LOW:HIGH, a number to search, as often as needed.
    target
        Column of the results to make small. A time that was not reached counts as twice the length of its run.
    most
        Make it large instead.
    points
        How many points to begin with.
    seeds
        Seeds of every point in the first round.
    held_back
        Seeds of the comparison at the end.
    first_seed
        Of the search; the held-back ones follow after all that it can use.
    set_
        Change a parameter for all points: NAME=VALUE, as often as needed.
    out
        Folder of all runs; formicarium-results/tune-SYSTEM if not given.
    workers
        Processes that share the runs; one a core if not given.
    """
    from formicarium.commands.tuning import Search, tune_system

    settings = tuple(set_ or ())
    return tune_system(
        Search(system, tuple(over), target, most, points, seeds, held_back, first_seed, settings, out, workers)
    )

"""``formicarium campaign run DESIGN``: run it, or go on with it."""

from formicarium.commands.campaign.options import Settings, Switch
from formicarium.commands.whole import Whole


def run(
    design: str,
    /,
    *,
    out: str | None = None,
    runs: Whole | None = None,
    set_: Settings = None,
    workers: Whole | None = None,
    time_limit: float | None = None,
    retry: Switch = False,
) -> int:
    """Run what a campaign lacks; interrupted or killed, the same command goes on.

    Several of these commands may work on one folder at once: they share the
    runs. Results do not depend on how many there are, nor on --workers.

    Examples:

        formicarium campaign run study.toml
        formicarium campaign run study.toml --runs 100 --workers 4

    Parameters
    ----------
    design
        File of the design: .toml, .yaml or .py
    out
        Folder of the campaign; formicarium-results/NAME if not given.
    runs
        Runs of each cell, instead of the design's replicates; more of them only add.
    set_
        Change a parameter in all cells: NAME=VALUE, as often as needed.
    workers
        Processes that share the runs; one a core if not given.
    time_limit
        Seconds after which a run is ended and counts as failed, instead of the design's.
    retry
        Run again what has failed before.
    """
    from formicarium.commands.campaign.sitting import Request, perform
    from formicarium.commands.campaign.study import Overrides, open_study

    study = open_study(design, out, Overrides(runs, tuple(set_ or ())))
    return perform(study, Request(workers, time_limit, retry))

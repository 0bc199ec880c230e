"""``formicarium campaign run DESIGN``: run it, or go on with it."""

from typing import Annotated

from cyclopts import Parameter

from formicarium.commands.campaign.options import DesignFile, Out, Runs, Settings, Switch
from formicarium.commands.whole import Whole


def run(
    design: DesignFile,
    /,
    *,
    out: Out = None,
    runs: Runs = None,
    set_: Settings = None,
    workers: Whole | None = None,
    dask: str | None = None,
    dask_option: Annotated[list[str] | None, Parameter(negative="")] = None,
    time_limit: float | None = None,
    retry: Switch = False,
    share: str | None = None,
    slurm_array: Whole | None = None,
    sbatch: Annotated[list[str] | None, Parameter(negative="")] = None,
) -> int:
    """Run what a campaign lacks; interrupted or killed, the same command goes on.

    Several of these commands may work on one folder at once: they share the
    runs. Results do not depend on how many there are, nor on --workers.

    For example:

        formicarium campaign run study.toml
        formicarium campaign run study.toml --runs 100 --workers 4
        formicarium campaign run study.toml --dask local
        formicarium campaign run study.toml --dask slurm --workers 40 --dask-option queue=short

    Parameters
    ----------
    workers
        Processes that share the runs; one a core if not given.
    dask
        Run on Dask: "local", "slurm", "pbs", "sge" (starts --workers workers or
        jobs), or the address of a scheduler, tcp://HOST:8786. Needs the extra "cluster".
    dask_option
        NAME=VALUE for the cluster that is started, as often as needed: queue=short
    time_limit
        Seconds after which a run is ended and counts as failed, instead of the design's.
    retry
        Run again what has failed before.
    share
        Do only every Nth run, beginning with run K: K/N.
    slurm_array
        Run nothing; write a Slurm job-array script of so many tasks into the folder.
    sbatch
        An option for Slurm in that script, as often as needed: --sbatch=--time=01:00:00
    """
    from formicarium.commands.campaign.sitting import Request, offer_script, perform
    from formicarium.commands.campaign.study import Overrides, open_study

    overrides = Overrides(runs, tuple(set_ or ()))
    study = open_study(design, out, overrides)
    request = Request(workers, time_limit, retry, share, dask, tuple(dask_option or ()))
    if slurm_array is not None or sbatch:
        return offer_script(study, overrides, request, slurm_array, tuple(sbatch or ()))
    return perform(study, request)

"""``formicarium campaign collect DESIGN``: one table of all runs, and figures."""

from formicarium.commands.campaign.options import DesignFile, Out, Runs, Settings, Sources, Switch


def collect(
    design: DesignFile,
    /,
    *,
    out: Out = None,
    runs: Runs = None,
    set_: Settings = None,
    sources: Sources = None,
    figures: Switch = False,
) -> int:
    """Write one tidy table of all runs that are done, and sum up every cell.

    The table is in runs.parquet and runs.csv: one row a run, with cell,
    factors, replicate, seed, results and identity. It is the same bytes
    whatever did the runs. cells.csv has one row a cell. Exit code 0 if every
    run of the design is in it, 1 if not.

    For example:

        formicarium campaign collect study.toml
        formicarium campaign collect study.toml --figures

    Parameters
    ----------
    figures
        Draw the run-time distributions of every cell too.
    """
    from formicarium.commands.campaign.answers import write_answers
    from formicarium.commands.campaign.study import Overrides, open_study

    return write_answers(open_study(design, out, Overrides(runs, tuple(set_ or ()), sources)), figures)

"""``formicarium export RUN``: a stored run in open formats."""

from pathlib import Path
from typing import Literal

from formicarium.commands.whole import Whole


def export(
    run: str, /, *, to: Literal["mcap", "csv", "parquet"] = "parquet", out: str | None = None, seed: Whole | None = None
) -> int:
    """Write a stored run in an open format.

    mcap: poses, point clouds, the scene, numbers by role and events, for
    Foxglove and Rerun. csv, parquet: two tables, trajectories and events.

    Examples:

        formicarium export formicarium-results/mark-i3-1a2b3c4d --seed 7 --to csv
        formicarium export seed-7.recording --to mcap

    Parameters
    ----------
    run
        A recording, or a folder of results.
    to
        The format.
    out
        Folder to write to; the working folder if not given.
    seed
        Seed of the run, if the folder holds several.
    """
    from formicarium.commands.filming import export_run

    for path in export_run(run, seed, to, Path(out or ".")):
        print(path)
    return 0

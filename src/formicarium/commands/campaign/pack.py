"""``formicarium campaign pack DESIGN FILE``: all runs of a campaign in one small file."""

from formicarium.commands.campaign.options import DesignFile, Out, Runs, Settings


def pack(design: DesignFile, file: str, /, *, out: Out = None, runs: Runs = None, set_: Settings = None) -> None:
    """Write the runs of the design into one file that can be kept or handed on; "adopt" takes them over again.

    Holds a row a run with what identifies it, and its factors, but no event logs. A
    campaign of many sittings goes on from it on a machine that never saw the folder.

    For example:

        formicarium campaign pack study.toml study.parquet
        formicarium campaign adopt study.toml study.parquet

    Parameters
    ----------
    file
        To be written: NAME.parquet.
    """
    from pathlib import Path

    import pyarrow as pa

    from formicarium.campaigns.ledger import Ledger
    from formicarium.campaigns.parts import write_part
    from formicarium.commands.campaign.screen import say, wide_console
    from formicarium.commands.campaign.study import Overrides, open_study
    from formicarium.commands.errors import UserError

    study = open_study(design, out, Overrides(runs, tuple(set_ or ())))
    rows = Ledger(study.folder).rows()
    keys = list(zip(rows["identity"].to_pylist(), rows["seed"].to_pylist()))
    wanted = {key for job in study.jobs for key in job.keys}
    ours = sorted((place for place, key in enumerate(keys) if key in wanted), key=keys.__getitem__)
    if not ours:
        raise UserError(f"{study.folder} holds no run of this design")
    write_part(rows.take(pa.array(ours, pa.int64())), Path(file))
    say(wide_console(), f"{len(ours)} runs packed into {file}")

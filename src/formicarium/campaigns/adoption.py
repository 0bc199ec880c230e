"""Take over runs from elsewhere: a set of one configuration, another ledger of any format known here, or a single part.

This is how results move on when the format of a ledger changes, and how ledgers filled on several machines are
put together.
"""

import hashlib
import json
import shutil
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any, NamedTuple

import pyarrow as pa

from formicarium.campaigns import table
from formicarium.campaigns.cells import Job
from formicarium.campaigns.files import StoreError, read_json, replacing
from formicarium.campaigns.ledger import MANIFEST, Ledger
from formicarium.campaigns.parts import OWN, DamagedPart, read_part
from formicarium.campaigns.seeds import plain
from formicarium.campaigns.writer import Writer


class Adopted(NamedTuple):
    """What came of it."""

    new: int  # rows taken over
    known: int  # rows that were there already
    other: int  # rows that belong to no run of the design: other parameters, seeds or sources
    bare: int  # rows without a table that the design keeps, which were left


def rows_in(folder: Path) -> pa.Table:
    """Return the rows of a folder, or of a single part, in the form of a ledger.

    Raises:
        StoreError: if it holds no results, or a file in it is damaged.
    """
    if folder.is_file():
        return _rows_of_part(folder)
    return _rows_of_ledger(folder) if (folder / MANIFEST).exists() else _rows_of_set(folder)


def adopt(writer: Writer, jobs: Sequence[Job], folder: Path, rows: pa.Table, keep: Sequence[str] = ()) -> Adopted:
    """Take over those rows of a folder that the jobs want, with the tables that they keep; rows without those are left.

    Raises:
        StoreError: if a row contradicts one that is there.
    """
    wanted = {key: job for job in jobs for key in job.keys}
    keys = list(zip(rows["identity"].to_pylist(), rows["seed"].to_pylist()))
    ours = [place for place, key in enumerate(keys) if key in wanted]
    with writer.transaction() as ledger:
        known = [place for place in ours if keys[place] in ledger.done]
        missing = [place for place in ours if keys[place] not in ledger.done]
        new = [place for place in missing if all(_table_of(folder, ledger, name, keys[place]) for name in keep)]
        _check_same(ledger, rows.take(pa.array(known, pa.int64())), folder)
        for place in known + new:
            for name in keep:
                _copy_table(folder, ledger, name, keys[place])
        if new:
            factors = [json.dumps(dict(wanted[keys[place]].cell.factors), sort_keys=True) for place in new]
            found = rows.take(pa.array(new, pa.int64()))
            index = found.column_names.index("factors")
            writer.add(found.set_column(index, "factors", pa.array(factors)))
    return Adopted(len(new), len(known), len(keys) - len(ours), len(missing) - len(new))


class Repeated(NamedTuple):
    """Rows of other sources that count as rows of today's."""

    rows: pa.Table
    seeds: list[int]  # of the runs that were repeated and came out the same


def as_of_today(
    jobs: Sequence[Job], folder: Path, rows: pa.Table, count: int, told: Callable[[Job, int], None]
) -> Repeated:
    """Return rows of other sources as rows of today's, if a sample of them comes out the same when it is repeated.

    An edit that changes no result outdates every row all the same: nobody can tell by looking at hashes. The sample is
    drawn by a hash of the seeds. A row belongs to the cell with its factors; whether all else that the design says was
    the same, a file of rows does not tell, so that the sample must show it. Rows of today's sources that belong to no
    run of the design have other parameters, and are left alone.

    Args:
        jobs: of the design.
        folder: where the rows come from, for messages.
        rows: of which those of other sources are looked at.
        count: runs to repeat; all, if there are fewer.
        told: called before each of them.

    Raises:
        StoreError: if a run gives another row now.
    """
    cells = {(_text(job.cell.factors), seed): job for job in jobs for seed in job.cell.seeds}
    found = {}
    for place, row in enumerate(rows.select(["factors", "seed", "sources"]).to_pylist()):
        job = cells.get((_text(json.loads(row["factors"])), row["seed"]))
        if job is not None and row["sources"] != job.configuration.sources:
            found[place] = job
    others = rows.take(pa.array(list(found), pa.int64()))
    stored = others.to_pylist()
    sample = sorted(zip(found.values(), stored), key=lambda pair: _drawn(pair[1]))[:count]
    for job, row in sample:
        told(job, row["seed"])
        _repeat(job, row, folder)
    own: dict[str, list[Any]] = {
        "identity": [job.configuration.identity for job in found.values()],
        "sources": [job.configuration.sources for job in found.values()],
    }
    for name, values in own.items():
        others = others.set_column(others.column_names.index(name), name, pa.array(values, OWN[name]))
    return Repeated(others, [row["seed"] for _, row in sample])


def _repeat(job: Job, row: dict[str, Any], folder: Path) -> None:
    again = job.function(row["seed"], None).row
    before = {name: value for name, value in row.items() if name not in OWN}
    names = sorted({*before, *again})
    if changed := [name for name in names if not table.same({name: before.get(name)}, {name: again.get(name)})]:
        name = changed[0]
        raise StoreError(
            f"{folder}: seed {row['seed']} of {job.cell.label} gives another row with today's sources: "
            f"{name} was {before.get(name)}, is {again.get(name)}. Nothing was taken over."
        )


def _drawn(row: dict[str, Any]) -> str:
    return hashlib.blake2b(f"{row['factors']} {row['seed']}".encode(), digest_size=8).hexdigest()


def _text(factors: Any) -> str:
    return json.dumps(plain(dict(factors)), sort_keys=True)


def _rows_of_ledger(folder: Path) -> pa.Table:
    ledger = Ledger(folder)
    rows = ledger.rows()
    for name, reason in ledger.damaged.items():
        raise StoreError(f"{folder / 'parts' / name} is damaged ({reason}): move it away, then try again")
    return rows


def _rows_of_part(path: Path) -> pa.Table:
    try:
        return read_part(path)
    except DamagedPart as reason:
        raise StoreError(f"{path} is damaged, or no file of runs that was packed ({reason})") from reason


def _rows_of_set(folder: Path) -> pa.Table:
    if not (folder / "configuration.json").exists() or not (folder / "runs.parquet").exists():
        raise StoreError(f"{folder} holds no results: neither {MANIFEST} nor configuration.json with runs.parquet")
    configuration, rows = read_json(folder / "configuration.json"), table.read(folder / "runs.parquet")
    identity = str(configuration.get("identity"))
    if table.metadata_of(rows.schema).get("identity") != identity:
        raise StoreError(f"{folder / 'runs.parquet'} does not belong to the configuration.json beside it")
    seconds, path = {}, folder / "timings.parquet"
    if path.exists():
        timings = table.read(path)
        seconds = dict(zip(timings["seed"].to_pylist(), timings["wall_seconds"].to_pylist()))
    count = len(rows)
    own = {
        "identity": [identity] * count,
        "seed": rows["seed"].to_pylist(),
        "sources": [str(configuration.get("sources"))] * count,
        "factors": ["{}"] * count,
        "wall_seconds": [seconds.get(seed, 0.0) for seed in rows["seed"].to_pylist()],
        "worker": [str(folder)] * count,
    }
    columns = {name: pa.array(values, OWN[name]) for name, values in own.items()}
    results = {name: rows[name] for name in rows.column_names if name != "seed"}
    if reserved := sorted(OWN.keys() & results.keys()):
        raise StoreError(f"{folder / 'runs.parquet'} has a column {reserved[0]!r}, which a ledger needs for itself")
    return pa.table(columns | results)


def _check_same(ledger: Ledger, known: pa.Table, folder: Path) -> None:
    if not len(known):
        return
    stored = {(row["identity"], row["seed"]): row for row in ledger.rows().to_pylist()}
    for row in known.to_pylist():
        before = stored[(row["identity"], row["seed"])]
        results = [{name: value for name, value in one.items() if name not in OWN} for one in (row, before)]
        if not table.same(*results):
            raise StoreError(
                f"{folder} and {ledger.folder} contradict each other: seed {row['seed']} of configuration "
                f"{row['identity']} gave different rows. Nothing was taken over."
            )


def _table_of(folder: Path, ledger: Ledger, name: str, key: tuple[str, int]) -> Path | None:
    target = ledger.table_path(name, key)
    places = (folder / name / key[0] / target.name, folder / name / target.name)
    return next((place for place in places if place.exists()), None)


def _copy_table(folder: Path, ledger: Ledger, name: str, key: tuple[str, int]) -> None:
    source, target = _table_of(folder, ledger, name, key), ledger.table_path(name, key)
    if source is not None and not target.exists():
        with replacing(target) as temporary:
            shutil.copyfile(source, temporary)

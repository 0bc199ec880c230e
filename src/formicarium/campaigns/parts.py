"""The parts of a ledger: small Parquet files of rows, many writers, each file whole and never changed.

Every row carries who it is (identity, seed) beside what its run gave:

    identity      of the configuration: system, parameters and sources (16 hexadecimal digits)
    seed          whole number
    sources       hash of the sources that decided the result
    factors       of the cell, as JSON
    wall_seconds  how long the run took
    worker        who did it
    ...           the columns of the result
"""

import json
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow as pa
import pyarrow.compute as pc
import pyarrow.parquet as pq

from formicarium.campaigns.files import StoreError, replacing
from formicarium.campaigns.result import Finished
from formicarium.campaigns.table import as_text, from_rows, parsed, with_metadata

FORMAT = 1  # of a part; noted in its metadata
OWN = {
    "identity": pa.string(),
    "seed": pa.int64(),
    "sources": pa.string(),
    "factors": pa.string(),
    "wall_seconds": pa.float64(),
    "worker": pa.string(),
}


class DamagedPart(Exception):
    """A part cannot be read; says why."""


def part_of(runs: Iterable[tuple[Finished, str, Mapping[str, Any]]]) -> pa.Table:
    """Make the table of runs that went well, each given with the hash of its sources and its factors."""
    rows: list[dict[str, Any]] = []
    for run, sources, factors in runs:
        assert run.result is not None
        own = (run.identity, run.seed, sources, json.dumps(factors, sort_keys=True), run.seconds, str(run.worker))
        rows.append({**dict(zip(OWN, own)), **run.result.row})
    table = from_rows(rows)
    for index, (name, kind) in enumerate(OWN.items()):
        table = table.set_column(index, name, table[name].cast(kind))
    return table


def write_part(table: pa.Table, path: Path) -> None:
    """Write a part whole."""
    with replacing(path) as temporary:
        content = with_metadata(table, {"format": str(FORMAT)})
        pq.write_table(content, temporary, compression="zstd", write_page_checksum=True)


def read_part(path: Path, columns: list[str] | None = None) -> pa.Table:
    """Read a part and verify its checksums.

    Raises:
        FileNotFoundError: if it is gone, for example because it was merged into another.
        DamagedPart: if it is no whole part.
        StoreError: if it cannot be read for another reason.
    """
    try:
        content = path.read_bytes()
    except FileNotFoundError:
        raise
    except OSError as error:
        raise StoreError(f"cannot read {path}: {error.strerror or error}") from error
    try:
        table = parsed(content, columns)
    except (pa.ArrowException, OSError, ValueError) as error:
        raise DamagedPart(str(error).splitlines()[0][:200]) from error
    for name in columns or OWN:
        if name not in table.column_names or table[name].type != OWN.get(name) or table[name].null_count:
            raise DamagedPart(f"its column {name!r} is missing or not as it should be")
    return table


def joined(tables: list[pa.Table]) -> pa.Table:
    """Put tables one below the other.

    Columns that some lack are empty there; whole numbers may become fractions, and all may become text.
    """
    if not tables:
        return pa.table({name: pa.array([], kind) for name, kind in OWN.items()})
    try:
        return pa.concat_tables(tables, promote_options="permissive").replace_schema_metadata(None)
    except pa.ArrowException:
        return pa.concat_tables(_as_text(tables), promote_options="permissive").replace_schema_metadata(None)


def _as_text(tables: list[pa.Table]) -> list[pa.Table]:
    """Make text of the columns that are text in some tables and something else in others."""
    kinds: dict[str, set[pa.DataType]] = {}
    for table in tables:
        for field in table.schema:
            if not pa.types.is_null(field.type):
                kinds.setdefault(field.name, set()).add(field.type)
    mixed = {name for name, found in kinds.items() if len(found) > 1 and not all(map(_is_number, found))}
    made = []
    for table in tables:
        for index, name in enumerate(table.column_names):
            if name in mixed:
                table = table.set_column(index, name, as_text(table[name].to_pylist()))
        made.append(table)
    return made


def _is_number(kind: pa.DataType) -> bool:
    return pa.types.is_integer(kind) or pa.types.is_floating(kind)


def distinct(table: pa.Table) -> pa.Table:
    """Return the table with every run once, sorted by identity and seed."""
    if not len(table):
        return table
    order = pc.sort_indices(table, [("identity", "ascending"), ("seed", "ascending")])
    table = table.take(order)
    seeds = table["seed"].to_numpy()
    names = table["identity"].combine_chunks().dictionary_encode()
    codes = (names.combine_chunks() if isinstance(names, pa.ChunkedArray) else names).indices.to_numpy()
    new = np.ones(len(seeds), bool)
    new[1:] = (np.diff(seeds) != 0) | (np.diff(codes) != 0)
    return table if new.all() else table.filter(pa.array(new))

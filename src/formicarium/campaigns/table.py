"""Parquet tables: equal rows give equal bytes, and a damaged file is an error that names it."""

from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

import pyarrow as pa
import pyarrow.parquet as pq

from formicarium.campaigns.files import StoreError, replacing

Row = Mapping[str, int | float | str | bool | None]


def from_rows(rows: Iterable[Row]) -> pa.Table:
    """Make a table of rows; columns in order of appearance, types wide enough for all rows."""
    rows = list(rows)
    names = list(dict.fromkeys(name for row in rows for name in row))
    return pa.table({name: column_of([row.get(name) for row in rows]) for name in names})


def column_of(values: list[Any]) -> pa.Array:
    """Make a column of values: of one type that holds them all, of texts if there is none; lists are texts."""
    kinds = {type(value) for value in values if value is not None}
    if list in kinds:
        return as_text(values)
    try:
        if kinds and all(issubclass(kind, int | float) and kind is not bool for kind in kinds) and len(kinds) > 1:
            return pa.array(values, pa.float64())  # whole numbers among fractions
        return pa.array(values)
    except (pa.ArrowException, OverflowError):
        return as_text(values)


def as_text(values: list[Any]) -> pa.Array:
    """Make texts of values that have no type in common; 1 and 1.0 are one text."""
    whole = [int(value) if isinstance(value, float) and value.is_integer() else value for value in values]
    return pa.array([None if value is None else str(value) for value in whole], pa.string())


def with_metadata(table: pa.Table, metadata: Mapping[str, str]) -> pa.Table:
    """Return the table with these key-value pairs added to its metadata."""
    return table.replace_schema_metadata({**(table.schema.metadata or {}), **metadata})


def metadata_of(schema: pa.Schema) -> dict[str, str]:
    """Return the key-value metadata of a schema as text."""
    return {key.decode(): value.decode() for key, value in (schema.metadata or {}).items()}


def write(table: pa.Table, path: Path) -> None:
    """Write a table whole, with a checksum on every page."""
    with replacing(path) as temporary:
        pq.write_table(table, temporary, compression="zstd", write_page_checksum=True)


def parsed(content: bytes, columns: list[str] | None = None) -> pa.Table:
    """Parse Parquet and verify its checksums, without threads.

    Arrow's threads now and then abort the interpreter at its exit (apache/arrow issue 34314; here 3 of 150 times),
    after all work was done well.
    """
    file = pq.ParquetFile(pa.BufferReader(content), page_checksum_verification=True, pre_buffer=False)
    return file.read(columns, use_threads=False)


def read(path: Path) -> pa.Table:
    """Read a table and verify its checksums.

    Raises:
        StoreError: if the file cannot be read as Parquet.
    """
    try:
        return parsed(path.read_bytes())
    except (pa.ArrowException, OSError, ValueError) as error:
        reason = str(error).splitlines()[0][:200]
        raise StoreError(
            f"{path} is damaged ({reason}). Move it away, then run the same command again: "
            "the runs it held are repeated, the others are kept."
        ) from error


def same(row: Row, stored: Row) -> bool:
    """Tell whether two rows are equal, an absent value being None, and NaN equal to NaN."""
    pairs = [(row.get(name), stored.get(name)) for name in {*row, *stored}]
    return all(one == other or (one != one and other != other) for one, other in pairs)

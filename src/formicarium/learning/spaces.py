"""Records of robots as spaces of Gymnasium: a dictionary with a box for every number or array of numbers.

A field has the name, the type and the shape that it has in the record, at least one-dimensional; a field of records in
a record is called "packets.distance". Units and frames are those of ``robots/records.py``.
"""

import math
from collections.abc import Mapping, Sequence

import numpy as np
from gymnasium import spaces

from formicarium.robots.records import SILENCE, Colour

# Whole numbers that do not use all of their type: last part of a name -> least and greatest.
WHOLE = {"colour": (int(min(Colour)), int(max(Colour))), "enabled": (0, 1), "infrared": (SILENCE, 255)}


def names_of(layout: np.dtype, wanted: Sequence[str] | None = None, said: str = "fields") -> tuple[str, ...]:
    """Return the names of the numbers in a record.

    Args:
        layout: of the record.
        wanted: names of its fields; all of them if None.
        said: what ``wanted`` is called in an error.

    Raises:
        ValueError: if there is no such field, or none is wanted; names it and those there are.
    """
    fields = layout.names or ()
    chosen = fields if wanted is None else tuple(wanted)
    unknown = [name for name in chosen if name not in fields]
    if unknown or not chosen:
        what = f"there is no field {unknown[0]!r}" if unknown else "it is empty"
        raise ValueError(f"{said} = {list(chosen)}: {what}; choose from {', '.join(fields)}")
    found: list[str] = []
    for name in fields:
        if name in chosen:
            inner = layout[name].base
            found += [f"{name}.{part}" for part in names_of(inner)] if inner.names else [name]
    return tuple(found)


def plain(layout: np.dtype) -> np.dtype:
    """Return the layout of a record without the fields that are records themselves, such as messages of many parts."""
    return np.dtype([(name, layout[name]) for name in layout.names or () if not layout[name].base.names])


def columns_of(records: np.ndarray, names: Sequence[str]) -> dict[str, np.ndarray]:
    """Return views of (N,) records by name: (N, 1) of a number, (N, ...) of an array."""
    columns = {}
    for name in names:
        column = records
        for part in name.split("."):
            column = column[part]
        columns[name] = column[:, None] if column.ndim == 1 else column
    return columns


def boxes_of(layout: np.dtype, names: Sequence[str], limits: Mapping[str, float]) -> dict[str, spaces.Box]:
    """Return the spaces of a record's fields, by name.

    Args:
        layout: of the record.
        names: of the numbers in it, as ``names_of`` has them.
        limits: name -> greatest absolute value, in the field's unit, of real numbers that have one.
    """
    boxes = {}
    for name, column in columns_of(np.zeros(1, layout), names).items():
        low, high = _span(name, column.dtype, limits.get(name, math.inf))
        boxes[name] = spaces.Box(low, high, column.shape[1:], column.dtype.type)
    return boxes


def _span(name: str, kind: np.dtype, limit: float) -> tuple[float, float]:
    if kind.kind == "f":
        return -limit, limit
    information = np.iinfo(kind)
    return WHOLE.get(name.rpartition(".")[2], (int(information.min), int(information.max)))


def blanked(readings: np.ndarray) -> np.ndarray:
    """Return a copy of (N,) Readings whose lists hold zeros beyond their counts.

    "blobs" has "blob_count" entries; behind them lie leftovers of earlier cycles, which are no readings.
    """
    found = np.array(readings)
    _blank(found)
    return found


def _blank(records: np.ndarray) -> None:
    fields = records.dtype.names or ()
    for name in fields:
        count = f"{name.removesuffix('s')}_count"
        if name.endswith("s") and count in fields:
            beyond = np.arange(records[name].shape[-1]) >= records[count][..., None]
            records[name][beyond] = np.zeros((), records.dtype[name].base)
        _blank(records[name])

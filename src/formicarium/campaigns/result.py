"""What one run gives: a row, and tables of its own."""

from collections.abc import Callable, Mapping
from enum import StrEnum
from typing import Any, NamedTuple

import numpy as np
import pyarrow as pa

from formicarium.campaigns.table import Row

# Told the progress inside one run: done and total, in whatever unit the function counts.
Watch = Callable[[float, float], None]


class Result(NamedTuple):
    """All that a run leaves behind; depends on nothing but the function and the seed."""

    row: Row  # one row of runs.parquet, without the seed
    tables: Mapping[str, pa.Table]  # name -> table, kept as <name>/seed-<seed>.parquet


class Ending(StrEnum):
    """How a run ended."""

    DONE = "done"
    FAILED = "failed"  # the function raised
    DIED = "died"  # its process ended before it was done
    LATE = "late"  # it took longer than the time limit


class Finished(NamedTuple):
    """A run that has ended, well or badly."""

    seed: int
    result: Result | None  # None unless it went well
    failure: str  # traceback or reason, empty if it went well
    seconds: float  # wall-clock time
    worker: int | str  # number or name of the worker that did it
    ending: Ending = Ending.DONE
    identity: str = ""  # of the configuration, where there are several


def checked(result: Any) -> Result:
    """Return what a function gave if a table can hold it.

    Raises:
        TypeError: if it is no Result, or a value of its row is not plain.
    """
    if not isinstance(result, Result):
        raise TypeError(f"a run must give a Result, not {type(result).__name__}")
    for name, value in result.row.items():
        if not isinstance(value, int | float | str | np.generic | None):
            plain = "a number, a text, true, false or None"
            raise TypeError(f"column {name!r} of the row is a {type(value).__name__}; it must be {plain}")
    return result


# A function to be repeated: seed and watch -> result. Importable by name, so that other processes find it.
Function = Callable[[int, Watch | None], Result]

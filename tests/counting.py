"""A function for campaigns that is not a simulation at all: functions must only be importable."""

import os
import signal
from functools import partial

import pyarrow as pa

from formicarium.campaigns.result import Result


def squares(failing: int, dying: int, seed: int, watch) -> Result:
    """Give seed², and a table of the numbers up to it; one seed raises, one kills its process."""
    if seed == failing:
        raise ArithmeticError(f"{seed} cannot be squared")
    if seed == dying:
        os.kill(os.getpid(), signal.SIGKILL)
    if watch:
        watch(1.0, 1.0)
    half = None if seed == 0 else seed / 2
    return Result(
        {"square": seed * seed, "half": half, "even": seed % 2 == 0, "name": f"n{seed}"},
        {"numbers": pa.table({"number": range(seed)})},
    )


def function(failing: int = -1, dying: int = -1):
    return partial(squares, failing, dying)

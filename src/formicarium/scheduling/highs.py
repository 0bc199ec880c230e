"""HiGHS as this room uses it: one thread, silent, and it hears Ctrl-C and the clock."""

import os
import signal
import sys
import threading
from collections.abc import Iterator, Sequence
from contextlib import contextmanager

import highspy
import numpy as np

from formicarium.scheduling.clock import Clock, OutOfTime

INFINITY = highspy.kHighsInf
# no cost is negative, so nothing is unbounded
NO_SOLUTION = (highspy.HighsModelStatus.kInfeasible, highspy.HighsModelStatus.kUnboundedOrInfeasible)


class Linear:
    """A linear programme to which columns are added, solved again from where it was."""

    def __init__(self, lower: Sequence[float] | np.ndarray, interior: bool = False):
        """Begin with rows that are at least so large, and no column.

        Args:
            lower: of the rows.
            interior: answer from the interior of the set of solutions, roughly: for many rows in a fraction of the
                time, and with duals that lead to better columns than those of a corner.
        """
        self._highs, self._interior = _quiet(), interior
        if interior:
            for name, value in (("solver", "ipm"), ("run_crossover", "off"), ("ipm_optimality_tolerance", 1e-4)):
                self._highs.setOptionValue(name, value)
        for value in lower:
            self._highs.addRow(float(value), INFINITY, 0, np.array([], np.int32), np.array([]))

    def add(self, cost: float, rows: Sequence[int]) -> None:
        """Add a column with coefficient 1 in some rows."""
        index = np.asarray(rows, np.int32)
        self._highs.addCol(float(cost), 0.0, INFINITY, len(index), index, np.ones(len(index)))

    def solve(self) -> tuple[float, np.ndarray, np.ndarray]:
        """Return the least cost, the columns' values and the rows' duals.

        Raises:
            ArithmeticError: if it has no solution.
        """
        self._highs.run()
        rough = self._interior and self._highs.getSolution().dual_valid
        if self._highs.getModelStatus() != highspy.HighsModelStatus.kOptimal and not rough:
            raise ArithmeticError(f"HiGHS: {self._highs.modelStatusToString(self._highs.getModelStatus())}")
        solution = self._highs.getSolution()
        value = self._highs.getInfo().objective_function_value
        return value, np.array(solution.col_value), np.maximum(np.array(solution.row_dual), 0.0)


class Mixed:
    """A mixed-integer programme, row by row."""

    def __init__(self) -> None:
        """Begin empty."""
        self._highs = _quiet()
        self.columns = 0

    def column(self, cost: float, low: float, high: float, whole: bool = False) -> int:
        """Add a variable and return its number."""
        self._highs.addCol(cost, low, high, 0, np.array([], np.int32), np.array([]))
        if whole:
            self._highs.changeColIntegrality(self.columns, highspy.HighsVarType.kInteger)
        self.columns += 1
        return self.columns - 1

    def row(self, low: float, terms: Sequence[tuple[int, float]], high: float) -> None:
        """Add low <= sum of (variable, coefficient) <= high; a variable may be named more than once."""
        merged: dict[int, float] = {}
        for column, factor in terms:
            merged[column] = merged.get(column, 0.0) + factor
        index, factors = np.array(list(merged), np.int32), np.array(list(merged.values()), float)
        self._highs.addRow(low, high, len(index), index, factors)

    def solve(
        self, clock: Clock, seconds: float = INFINITY, absolute_gap: float = 1e-7, relative_gap: float = 1e-9,
        cutoff: float | None = None,
    ) -> tuple[float, np.ndarray | None, float]:  # fmt: skip
        """Return the best value, the variables (None if there is no solution yet) and the bound.

        Infinite value and bound mean that there is no solution (below the cutoff).

        Raises:
            KeyboardInterrupt: on Ctrl-C, after HiGHS has ended in good order.
        """
        highs, until = self._highs, clock.seconds + min(seconds, clock.left)
        highs.setOptionValue("mip_abs_gap", absolute_gap)
        highs.setOptionValue("mip_rel_gap", relative_gap)
        if cutoff is not None:
            highs.setOptionValue("objective_bound", cutoff)
        if clock.on_the_wall and np.isfinite(until):  # HiGHS knows no other; its presolve does not ask the callbacks
            highs.setOptionValue("time_limit", max(0.0, until - clock.seconds))
        stopped: list[int] = []
        with _interruptible(stopped):
            for event in (highs.cbMipInterrupt, highs.cbSimplexInterrupt):
                event.subscribe(lambda event: event.interrupt(bool(stopped) or clock.seconds > until))
            highs.run()
        info, status = highs.getInfo(), highs.getModelStatus()
        if status in NO_SOLUTION:
            return INFINITY, None, INFINITY
        if info.primal_solution_status != highspy.SolutionStatus.kSolutionStatusFeasible:
            return INFINITY, None, info.mip_dual_bound
        return info.objective_function_value, np.array(highs.getSolution().col_value), info.mip_dual_bound


class Small:
    """Small programmes one after the other, all rows "at most", given as arrays."""

    def __init__(self, clock: Clock, precise: bool = False, interior: bool = False):
        """Prepare.

        Args:
            clock: heard while a programme is solved: big ones take minutes.
            precise: keep rows and whole numbers to 1e-9 instead of 1e-6.
            interior: of many best answers give one amidst them, no corner.
        """
        self._highs, self._clock = _quiet(), clock
        self._stopped = stopped = list[int]()
        if precise:
            for name in ("mip_feasibility_tolerance", "primal_feasibility_tolerance"):
                self._highs.setOptionValue(name, 1e-9)
        self._interior = interior
        if interior:
            self._highs.setOptionValue("run_crossover", "off")
        for event in (self._highs.cbMipInterrupt, self._highs.cbSimplexInterrupt, self._highs.cbIpmInterrupt):
            event.subscribe(lambda event: event.interrupt(bool(stopped) or clock.left <= 0.0))

    def solve(
        self, programme: tuple[np.ndarray, ...], whole: np.ndarray | None, cutoff: float
    ) -> tuple[float, np.ndarray | None]:
        """Return the least cost and the variables; infinite and None if nothing is below the cutoff.

        Args:
            programme: cost (n,), lower and upper bound (n,) of the variables; starts (m + 1,) of the rows in the
                next two; variables and coefficients of the rows; limits (m,) of the rows.
            whole: numbers of the variables that must be whole; None for none.
            cutoff: costs that are not below are of no interest.

        Raises:
            OutOfTime: if the limit has come; an answer is never a matter of time.
            KeyboardInterrupt: on Ctrl-C, after HiGHS has ended in good order.
        """
        self._clock.check()
        highs, model = self._highs, highspy.HighsLp()
        cost, low, high, starts, index, value, limits = programme
        model.num_col_, model.num_row_ = len(cost), len(limits)
        model.col_cost_, model.col_lower_, model.col_upper_ = cost, low, high
        model.row_lower_, model.row_upper_ = np.full(len(limits), -INFINITY), np.asarray(limits, float)
        model.a_matrix_.format_ = highspy.MatrixFormat.kRowwise
        model.a_matrix_.start_, model.a_matrix_.index_ = starts.astype(np.int32), index.astype(np.int32)
        model.a_matrix_.value_ = value
        if whole is not None:
            kinds = np.full(len(cost), highspy.HighsVarType.kContinuous)
            kinds[whole] = highspy.HighsVarType.kInteger
            model.integrality_ = list(kinds)
        highs.setOptionValue("presolve", "choose" if whole is not None else "off")
        highs.setOptionValue("objective_bound", cutoff)
        highs.setOptionValue("mip_rel_gap", 1e-7)
        highs.passModel(model)
        if self._interior:
            highs.setOptionValue("solver", "ipm")
        with _interruptible(self._stopped):
            highs.run()
            if self._interior and highs.getModelStatus() == highspy.HighsModelStatus.kUnknown:  # then a corner
                highs.setOptionValue("solver", "simplex")
                highs.run()
        status = highs.getModelStatus()
        if status == highspy.HighsModelStatus.kInterrupt:
            raise OutOfTime
        if status in (highspy.HighsModelStatus.kObjectiveBound, *NO_SOLUTION):
            return INFINITY, None
        if status != highspy.HighsModelStatus.kOptimal:
            raise ArithmeticError(f"HiGHS: {highs.modelStatusToString(status)}")
        return highs.getInfo().objective_function_value, np.array(highs.getSolution().col_value)


def _quiet() -> highspy.Highs:
    with _hushed():
        highs = highspy.Highs()
    highs.setOptionValue("output_flag", False)
    highs.setOptionValue("threads", 1)
    highs.setOptionValue("parallel", "off")
    return highs


@contextmanager
def _hushed() -> Iterator[None]:
    """Keep the greeting that HiGHS writes on its first use, past Python, from the terminal."""
    sys.stdout.flush()
    saved, nowhere = os.dup(1), os.open(os.devnull, os.O_WRONLY)
    os.dup2(nowhere, 1)
    try:
        yield
    finally:
        os.dup2(saved, 1)
        os.close(saved)
        os.close(nowhere)


@contextmanager
def _interruptible(stopped: list[int]) -> Iterator[None]:
    """Note a Ctrl-C in the list instead of raising it in the middle of foreign code; raise it at the end."""
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    stopped.clear()
    previous = signal.signal(signal.SIGINT, lambda number, _: stopped.append(number))
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, previous)
    if stopped:
        raise KeyboardInterrupt

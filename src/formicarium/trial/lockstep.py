"""Controllers of any system in lock step: each with what it alone was told, and commands of any layout.

As ``trial.onboard`` has them, which stored runs of task sequencing rest on, but for three things. A table with a record
a robot is each robot's own. A Command is checked as far as its fields have a meaning for everybody: speeds are finite,
lists are no longer than their room. Whoever is lost gets an empty Command of its own layout.
"""

import socket
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import numpy as np

from formicarium.robots.records import SILENCE
from formicarium.trial.onboard import Controllers, Lost, Onboard, received, send

LARGEST_NUMBER = 255  # of a robot: it is one byte


class Lockstep(Controllers):
    """The controllers of a trial of any system. Use as a context: they end with it."""

    def __init__(self, onboard: Onboard, state: Any, *told: Any, **options: Any):
        """Start a process for every robot, as ``Controllers`` does.

        Raises:
            TimeoutError: if not all have reported in time.
            ValueError: if robots of such a trial cannot be told what they need; no process is started then.
        """
        for table in onboard.tables(state):
            own(table, 0, len(state.robots))
        super().__init__(onboard, state, *told, **options)

    def _brief(self, i: int, line: socket.socket) -> None:
        """Tell a controller its function, the layouts of its records, its memory and its tables."""
        shared, robots = self.onboard, len(self.state.robots)
        told = tuple(own(table, i, robots) for table in shared.tables(self.state))
        self.onboard = shared._replace(tables=lambda state: told)
        try:
            super()._brief(i, line)
        finally:
            self.onboard = shared

    def _decide(self) -> None:
        """Send every robot that is alive and heard its Reading, then take every answer: they think at the same time."""
        alive, readings = self.state.robots["alive"], np.asarray(self.state.readings)
        asked = [(i, robot) for i, robot in enumerate(self._identities) if alive[i] and robot in self._lines]
        for i, robot in asked:
            with self._losing(i, robot):
                send(self._lines[robot], readings[i].tobytes())
        until = time.monotonic() + self.patience
        for i, robot in asked:
            if robot in self._lines:
                with self._losing(i, robot):
                    self._lines[robot].settimeout(max(until - time.monotonic(), 0.001))
                    self._take(i, received(self._lines[robot]))

    @contextmanager
    def _losing(self, i: int, robot: int) -> Iterator[None]:
        """Lose a robot whose controller does not answer, or not with what it should."""
        try:
            yield
        except TimeoutError:
            self._lose(i, robot, f"has not answered within {self.patience:g} s")
        except ValueError as error:
            self._lose(i, robot, f"answers with garbage: {error}")
        except OSError:
            self._lose(i, robot, self._ending(robot))

    def _take(self, i: int, answer: bytes) -> None:
        """Take in a Command and the telemetry of a memory.

        Raises:
            ValueError: if they are not what they should be.
        """
        layout = np.asarray(self.state.commands).dtype
        if len(answer) >= layout.itemsize:
            check_lists(np.frombuffer(answer[: layout.itemsize], layout))
        super()._take(i, answer)

    def _lose(self, i: int, robot: int, reason: str) -> None:
        """Name a robot whose controller is gone, end what is left of it, and silence the robot for good."""
        self.lost.append(Lost(robot, int(self.state.clock[0].cycle), reason))
        print(f"formicarium: the controller of robot {robot} {reason}, cycle {self.lost[-1].cycle}", file=sys.stderr)
        self._lines.pop(robot).close()
        self.processes[robot].kill()
        commands = np.asarray(self.state.commands)
        commands[i] = np.zeros((), commands.dtype)
        if "infrared" in (commands.dtype.names or ()):
            commands["infrared"][i] = SILENCE


def own(table: Any, i: int, robots: int) -> np.ndarray:
    """Return what robot ``i`` is told of a table: its own record, or the one that is for all.

    Raises:
        ValueError: if the table has neither one record nor one a robot.
    """
    records = np.asarray(table)
    if len(records) not in (1, robots):
        raise ValueError(f"a table of {len(records)} records for {robots} robots: must be one for all, or one each")
    return records[i : i + 1] if len(records) > 1 else records


def check_lists(records: np.ndarray) -> None:
    """Check the counts and the receivers in records, and in the records that they are made of.

    Raises:
        ValueError: if a list ("entries") has more than its room, or less than nothing, by its count ("entry_count"), or
            something is for a robot of a number that there is not. Compiled code would look beyond the record.
    """
    names = records.dtype.names or ()
    for name in names:
        values = records[name]
        if name == "receiver" and not ((values >= 0) & (values <= LARGEST_NUMBER)).all():
            raise ValueError("a message for a robot of a number that there is not")
        for many in plurals(name):
            if many in names and not ((values >= 0) & (values <= records[many].shape[-1])).all():
                raise ValueError(f"{name} {values.tolist()} where there is room for {records[many].shape[-1]}")
        check_lists(values)


def plurals(name: str) -> tuple[str, ...]:
    """Return how the list that "arm_count" or "entry_count" counts may be called; nothing for other names."""
    single = name.removesuffix("_count")
    return () if single == name else (f"{single}s", f"{single.removesuffix('y')}ies")

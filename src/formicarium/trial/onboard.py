"""The same behaviour outside the simulator: every robot's controller is a process of its own, interpreted.

A controller is fed with nothing but Readings, as bytes over a local socket, and answers each with its Command, in lock
step with the simulator. Beside the Command it sends its memory home, as robots in the laboratory send telemetry: the
observers note roles from it, no robot ever sees another's. A controller that dies, hangs or answers with garbage is
named, and the trial goes on with a silent robot.

Not met yet: hardware, and a clock on the wall. What a controller process imports (``controller.py``) needs no compiler.
"""

import ast
import json
import os
import socket
import subprocess
import sys
import time
from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

from formicarium.trial.phases import fall_silent

GREETING = 60.0  # s that all controllers have to start
LARGEST = 1 << 20  # bytes of a message


class Onboard(NamedTuple):
    """A system's loop, taken apart where the robots decide."""

    decide: str  # "module:function", called as decide(reading, memory, command, *tables)
    tables: Callable[[Any], tuple[Any, ...]]  # state -> what every robot was given: records of one, numbers
    before: Callable[[Any], None]  # (state): the world up to the readings
    after: Callable[[Any], None]  # (state): the world from the commands to the next cycle


class Lost(NamedTuple):
    """A controller that is no longer heard."""

    robot: int  # identity
    cycle: int
    reason: str


class Controllers:
    """The controllers of a trial. Use as a context: they end with it."""

    def __init__(
        self, onboard: Onboard, state: Any, patience: float = 5.0, command: Callable[[int], list[str]] | None = None
    ):
        """Start a process for every robot and tell it what it is told before it is switched on.

        Args:
            onboard: the system's loop, taken apart.
            state: of the trial; memories as they are now.
            patience: seconds a controller may take for an answer.
            command: identity -> command line of its controller; the package's own if None.

        Raises:
            TimeoutError: if not all have reported in time.
        """
        self.onboard, self.state, self.patience = onboard, state, patience
        self.lost: list[Lost] = []
        self._server = socket.create_server(("127.0.0.1", 0))
        self._server.settimeout(GREETING)
        port = self._server.getsockname()[1]
        environment = os.environ | {"FORMICARIUM_INTERPRETED": "1", "OPENBLAS_NUM_THREADS": "1"}
        given = command or (lambda _: [sys.executable, "-m", "formicarium.trial.controller"])
        self._identities = [int(robot) for robot in state.robots["identity"]]
        self.processes = {
            identity: subprocess.Popen([*given(identity), str(port), str(identity)], env=environment)
            for identity in self._identities
        }
        self._lines: dict[int, socket.socket] = {}
        try:
            while len(self._lines) < len(self._identities):
                line, _ = self._server.accept()
                line.settimeout(GREETING)
                line.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
                self._lines[int(received(line))] = line
        except OSError as error:
            missing = sorted(set(self._identities) - set(self._lines))
            self.close()
            raise TimeoutError(
                f"the controllers of robots {missing} have not reported within {GREETING:g} s"
            ) from error
        for i, identity in enumerate(self._identities):
            self._brief(i, self._lines[identity])

    def _brief(self, i: int, line: socket.socket) -> None:
        """Tell a controller its function, the layouts of its records, its memory and its tables."""
        parts = [self.state.readings, self.state.memories, self.state.commands]
        tables = self.onboard.tables(self.state)
        arrays = [np.asarray(table) for table in tables]
        brief = {
            "path": sys.path,
            "decide": self.onboard.decide,
            "layouts": [described(np.asarray(part).dtype) for part in parts],
            "tables": [described(array.dtype) for array in arrays],
        }
        send(line, json.dumps(brief).encode())
        send(line, np.asarray(self.state.memories)[i].tobytes())
        send(line, np.asarray(self.state.commands)[i].tobytes())
        for array in arrays:
            send(line, array.tobytes())

    def advance(self, cycles: int) -> None:
        """Let so many cycles pass, or fewer if the trial finishes."""
        clock = self.state.clock[0]
        for _ in range(cycles):
            if clock.finished:
                return
            self.onboard.before(self.state)
            self._decide()
            self.onboard.after(self.state)

    def _decide(self) -> None:
        """Send every living robot its Reading, then take every answer: they think at the same time."""
        state, asked = self.state, []
        for i, identity in enumerate(self._identities):
            if not state.robots["alive"][i]:
                continue
            if identity not in self._lines:
                fall_silent(state.commands[i])
                continue
            try:
                send(self._lines[identity], np.asarray(state.readings)[i].tobytes())
                asked.append((i, identity))
            except OSError:
                self._lose(i, identity, self._ending(identity))
        until = time.monotonic() + self.patience
        for i, identity in asked:
            try:
                self._lines[identity].settimeout(max(until - time.monotonic(), 0.001))
                self._take(i, received(self._lines[identity]))
            except TimeoutError:
                self._lose(i, identity, f"has not answered within {self.patience:g} s")
            except ValueError as error:
                self._lose(i, identity, f"answers with garbage: {error}")
            except OSError:
                self._lose(i, identity, self._ending(identity))

    def _take(self, i: int, answer: bytes) -> None:
        """Take in a Command and the telemetry of a memory.

        Raises:
            ValueError: if they are not what they should be.
        """
        commands, memories = np.asarray(self.state.commands), np.asarray(self.state.memories)
        wanted = commands.dtype.itemsize + memories.dtype.itemsize
        if len(answer) != wanted:
            raise ValueError(f"{len(answer)} bytes instead of {wanted}")
        command = np.frombuffer(answer[: commands.dtype.itemsize], commands.dtype)[0]
        if not (np.isfinite(command["left"]) and np.isfinite(command["right"])):
            raise ValueError(f"wheel speeds {command['left']} and {command['right']}")
        commands[i] = command
        memories[i] = np.frombuffer(answer[commands.dtype.itemsize :], memories.dtype)[0]

    def _ending(self, identity: int) -> str:
        try:
            return f"has died (exit code {self.processes[identity].wait(1.0)})"
        except subprocess.TimeoutExpired:
            return "has hung up"

    def _lose(self, i: int, identity: int, reason: str) -> None:
        """Name a robot whose controller is gone, end what is left of it, and silence the robot."""
        self.lost.append(Lost(identity, int(self.state.clock[0].cycle), reason))
        print(f"formicarium: the controller of robot {identity} {reason}, cycle {self.lost[-1].cycle}", file=sys.stderr)
        self._lines.pop(identity).close()
        self.processes[identity].kill()
        fall_silent(self.state.commands[i])

    def close(self) -> None:
        """End all controllers."""
        for line in self._lines.values():
            line.close()
        for process in self.processes.values():
            process.kill()
            process.wait()
        self._server.close()

    def __enter__(self) -> "Controllers":
        """Return the controllers."""
        return self

    def __exit__(self, *_: object) -> None:
        """End all controllers."""
        self.close()


def described(layout: np.dtype) -> str:
    """Write a layout, paddings included, so that ``layout_of`` reads it back."""
    return repr(np.lib.format.dtype_to_descr(layout))


def layout_of(text: str) -> np.dtype:
    """Read a layout."""
    return np.lib.format.descr_to_dtype(ast.literal_eval(text))


def send(line: socket.socket, content: bytes) -> None:
    """Send a message: four bytes of length, then the content."""
    line.sendall(len(content).to_bytes(4, "little") + content)


def received(line: socket.socket) -> bytes:
    """Return the next message.

    Raises:
        ValueError: if its length makes no sense.
        ConnectionError: if the other side is gone.
        TimeoutError: if it does not come in time.
    """
    length = int.from_bytes(_exactly(line, 4), "little")
    if length > LARGEST:
        raise ValueError(f"a message of {length} bytes")
    return _exactly(line, length)


def _exactly(line: socket.socket, count: int) -> bytes:
    parts = bytearray()
    while len(parts) < count:
        part = line.recv(count - len(parts))
        if not part:
            raise ConnectionError("hung up")
        parts += part
    return bytes(parts)

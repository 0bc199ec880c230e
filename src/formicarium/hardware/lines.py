"""Lines to a robot: a TCP connection, or a serial port (USB, or Bluetooth as rfcomm) of a system that has terminals."""

import os
import select
import socket
import sys
import time
from collections.abc import Callable
from io import FileIO
from typing import Protocol

if sys.platform != "win32":
    import termios
    import tty


class Line(Protocol):
    """Bytes to and from a robot."""

    def send(self, content: bytes) -> None:
        """Send all of it."""

    def receive(self, count: int) -> bytes:
        """Return exactly so many bytes.

        Raises:
            TimeoutError: if they do not come in time; says how many did.
            ConnectionError: if the other side is gone.
        """

    def clear(self) -> None:
        """Throw away what has come so far."""

    def close(self) -> None:
        """Hang up."""


class TcpLine:
    """A TCP connection."""

    def __init__(self, address: str, port: int, patience: float):
        """Connect.

        Args:
            address: of the robot.
            port: of its server.
            patience: seconds to wait for a connection or an answer.

        Raises:
            OSError: if nobody is there.
        """
        self._socket = socket.create_connection((address, port), timeout=patience)
        self._socket.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        self._patience = patience

    def send(self, content: bytes) -> None:
        """Send all of it."""
        self._socket.sendall(content)

    def receive(self, count: int) -> bytes:
        """Return exactly so many bytes; raises as ``Line.receive``."""
        return gathered(count, self._patience, self._part)

    def _part(self, count: int, wait: float) -> bytes | None:
        self._socket.settimeout(wait)
        try:
            return self._socket.recv(count)
        except TimeoutError:
            return None

    def clear(self) -> None:
        """Throw away what has come so far."""
        while select.select([self._socket], [], [], 0.0)[0] and self._socket.recv(4096):
            pass

    def close(self) -> None:
        """Hang up."""
        self._socket.close()


class SerialLine:
    """A serial port, raw, 115,200 baud."""

    def __init__(self, port: str, patience: float):
        """Open a port.

        Args:
            port: a device file.
            patience: seconds to wait for an answer.

        Raises:
            OSError: if it cannot be opened, or the system has no terminals.
        """
        if sys.platform == "win32":
            raise OSError(f"{port}: serial ports need Linux or macOS here; connect over WiFi instead")
        self._file = FileIO(os.open(port, os.O_RDWR | os.O_NOCTTY), "r+")
        tty.setraw(self._file.fileno())
        settings = termios.tcgetattr(self._file.fileno())
        settings[4] = settings[5] = termios.B115200
        termios.tcsetattr(self._file.fileno(), termios.TCSANOW, settings)
        self._patience = patience

    def send(self, content: bytes) -> None:
        """Send all of it."""
        while content:
            content = content[self._file.write(content) or 0 :]

    def receive(self, count: int) -> bytes:
        """Return exactly so many bytes; raises as ``Line.receive``."""
        return gathered(count, self._patience, self._part)

    def _part(self, count: int, wait: float) -> bytes | None:
        if not select.select([self._file], [], [], wait)[0]:
            return None
        try:
            return self._file.read(count)
        except OSError:  # as a terminal says that nobody is at its other end
            return b""

    def clear(self) -> None:
        """Throw away what has come so far: a robot says welcome when it is switched on."""
        while self._part(4096, 0.1):
            pass

    def close(self) -> None:
        """Hang up."""
        self._file.close()


def gathered(count: int, patience: float, part: Callable[[int, float], bytes | None]) -> bytes:
    """Return exactly so many bytes out of parts.

    Args:
        count: of bytes.
        patience: seconds for all of them.
        part: (most bytes, seconds) -> some; none at all if the other side is gone, None if none came in time.

    Raises:
        TimeoutError: if they do not come in time.
        ConnectionError: if the other side is gone.
    """
    found, until = bytearray(), time.monotonic() + patience
    while len(found) < count:
        some = part(count - len(found), max(until - time.monotonic(), 0.001))
        if some is None:
            raise TimeoutError(f"{len(found)} of {count} bytes have come within {patience:g} s")
        if not some:
            raise ConnectionError(f"hung up after {len(found)} of {count} bytes")
        found += some
    return bytes(found)

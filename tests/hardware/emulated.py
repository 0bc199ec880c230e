"""An e-puck2 that is not there: it speaks the published protocol byte by byte, over TCP or a pseudo-terminal.

Written from the protocol, with nothing of the driver: places of bytes are counted out.
"""

import os
import pty
import select
import socket
import struct
import threading
from contextlib import suppress

SENSORS = struct.Struct("<3h 3f 3h 3f b 8H 8H H 4H 2h H B 3B B 3H 3H")
WELCOME = b"\x0c\x07WELCOME to the SerCom protocol on e-Puck\r\n"


class EmulatedEPuck2:
    """A robot. Each request lets ``pace`` seconds of wheel time pass."""

    def __init__(self, pace=0.05):
        self.proximity, self.ambient, self.ground = [0] * 8, [4095] * 8, [1023] * 3
        self.position = [0.0, 0.0]  # steps
        self.pace, self.requests, self.heard = pace, 0, []
        self.silent_after = self.hang_up_after = self.babbles_after = 10**9  # requests
        self.dribbles = False

    def actuate(self, content):
        """Take in the 19 bytes of the actuators."""
        self.heard.append(bytes(content))
        self.requests += 1
        for k, speed in enumerate(self.speeds):
            self.position[k] += speed * self.pace

    @property
    def speeds(self):
        """Return what the wheels were told last, steps/s."""
        return struct.unpack_from("<2h", self.heard[-1], 1)

    @property
    def lights(self):
        """Return red, green, blue of the four lights."""
        return [tuple(self.heard[-1][6 + 3 * k : 9 + 3 * k]) for k in range(4)]

    def sensors(self):
        """Return the 102 bytes up to the ground sensors."""
        steps = [(int(position) + 2**15) % 2**16 - 2**15 for position in self.position]
        return SENSORS.pack(
            *(1, 2, 3), *(9.8, 0.0, 0.0), *(4, 5, 6), *(1.0, 2.0, 3.0), 25, *self.proximity, *self.ambient, 2000,
            *(7, 8, 9, 10), *steps, 3000, 1, *(0, 0, 0), 8, *self.ground, *(0, 0, 0),
        )  # fmt: skip

    def serial(self, receive, send):
        """Binary mode: negated request numbers until a 0, then one answer to all of them."""
        send(WELCOME)
        answer = b""
        while True:
            number = (256 - receive(1)[0]) % 256
            if number == 9:
                self.actuate(receive(19))
            elif number == 8:
                answer += self.sensors() + b"\0"
            elif number == 0 and not self.spoilt(send):
                send(answer)
                answer = b""

    def wifi(self, receive, send):
        """21 bytes: kind, what is asked for, actuators."""
        while True:
            request = receive(21)
            assert request[0] == 0x80 and request[1] in (0, 2)
            self.actuate(request[2:])
            if not self.spoilt(send):
                send(b"\x02" + self.sensors() + b"\0\0" if request[1] & 2 else b"\x03")

    def spoilt(self, send):
        """Fail in the way that was asked for."""
        if self.requests > self.hang_up_after:
            raise EOFError
        if self.requests > self.babbles_after:
            send(b"\x03")
        return self.requests > min(self.silent_after, self.babbles_after)


def reader(part):
    def receive(count):
        content = b""
        while len(content) < count:
            some = part(count - len(content))
            if not some:
                raise EOFError
            content += some
        return content

    return receive


class OnTcp:
    """The robot's server."""

    def __init__(self, robot):
        self.robot, self.server = robot, socket.create_server(("127.0.0.1", 0))
        self.port = self.server.getsockname()[1]
        self.thread = threading.Thread(target=self.serve, daemon=True)
        self.thread.start()

    def serve(self):
        line, _ = self.server.accept()
        with line, suppress(EOFError, OSError):
            self.robot.wifi(reader(line.recv), lambda content: self.send(line, content))

    def send(self, line, content):
        size = 7 if self.robot.dribbles else len(content)
        for k in range(0, len(content), size):
            line.sendall(content[k : k + size])

    def close(self):
        self.thread.join(5.0)
        self.server.close()


class OnSerial:
    """The robot at one end of a pseudo-terminal; ``port`` is the other."""

    def __init__(self, robot):
        self.robot = robot
        self.own, self.other = pty.openpty()
        self.port = os.ttyname(self.other)
        self.ended = False
        self.thread = threading.Thread(target=self.serve, daemon=True)
        self.thread.start()

    def serve(self):
        with suppress(EOFError, OSError):
            self.robot.serial(reader(self.part), lambda content: os.write(self.own, content))
        if not self.ended:
            self.hang_up()

    def part(self, count):
        while not self.ended:
            if select.select([self.own], [], [], 0.05)[0]:
                return os.read(self.own, count)
        return b""

    def hang_up(self):
        self.ended = True
        for end in (self.other, self.own):
            os.close(end)

    def close(self):
        self.ended = True
        self.thread.join(5.0)

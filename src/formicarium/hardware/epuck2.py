"""An e-puck2 over WiFi, USB or Bluetooth: its sensors as a Reading of all senses, a Command as its actuators.

Not met yet: hardware. Raw values are scaled, not calibrated against distances.

It has eight infrared sensors for proximity and light, three for the ground (an extension), wheels that count steps, and
coloured lights. The papers' e-pucks have a range-and-bearing board, an omnidirectional camera and infrared bytes at
short range besides. This one does not: its Reading never holds a packet, a blob or a byte, and what a Command asks for
there is not done, but counted in ``ignored``.
"""

import math
from collections import Counter
from typing import Any

import numpy as np

from formicarium.hardware.lines import Line, SerialLine, TcpLine
from formicarium.hardware.packets import (
    ACTUATORS,
    BRIGHTEST,
    DARK,
    MOST_STEPS,
    PROXIMITY_FULL,
    SENSORS,
    SERIAL,
    TCP_PORT,
    WHITE,
    WIFI,
    Framing,
    request,
)
from formicarium.robots.all_senses import READING
from formicarium.robots.epuck import Epuck
from formicarium.robots.records import SILENCE, Colour

PATIENCE = 1.0  # s that a robot may take for an answer
SHOWN = {  # parts of red, green and blue
    Colour.OFF: (0.0, 0.0, 0.0),
    Colour.RED: (1.0, 0.0, 0.0),
    Colour.GREEN: (0.0, 1.0, 0.0),
    Colour.BLUE: (0.0, 0.0, 1.0),
    Colour.ORANGE: (1.0, 0.4, 0.0),
    Colour.CYAN: (0.0, 1.0, 1.0),
    Colour.YELLOW: (1.0, 1.0, 0.0),
    Colour.MAGENTA: (1.0, 0.0, 1.0),
}


class GarbledAnswer(ConnectionError):
    """A robot answers with something that is no packet of sensors."""


class EPuck2:
    """A robot on a line. Use as a context: it stands still with its lights off when the context ends."""

    def __init__(self, line: Line, framing: Framing, identity: int, epuck: Epuck | None = None):
        """Take over a robot.

        Args:
            line: to it.
            framing: of the packets on this line.
            identity: 1 to 255, its own number in its Readings.
            epuck: wheel radius, steps a turn and speed limit; the package's e-puck if None.

        Raises:
            ValueError: if the identity is out of range.
        """
        if not 1 <= identity <= 255:
            raise ValueError(f"identity = {identity}: must be 1 to 255")
        self.line, self.framing, self.identity, self.epuck = line, framing, identity, epuck or Epuck()
        self.ignored: Counter[str] = Counter()  # what was commanded and it cannot do -> how often
        self.cycle = 0  # Readings taken
        self._actuators = np.zeros(1, ACTUATORS)
        self._steps = np.zeros(2, "i8")
        self._raw_steps: np.ndarray | None = None
        line.clear()

    @classmethod
    def over_wifi(cls, address: str, identity: int, port: int = TCP_PORT, patience: float = PATIENCE) -> "EPuck2":
        """Connect to a robot with WiFi firmware.

        Raises:
            OSError: if nobody is there.
        """
        return cls(TcpLine(address, port, patience), WIFI, identity)

    @classmethod
    def over_serial(cls, port: str, identity: int, patience: float = PATIENCE) -> "EPuck2":
        """Connect to a robot with factory firmware by USB (selector 8) or Bluetooth (selector 3).

        Raises:
            OSError: if the port cannot be opened.
        """
        return cls(SerialLine(port, patience), SERIAL, identity)

    def sense(self, reading: Any) -> None:
        """Fill in a READING record of ``robots.all_senses`` with what the robot senses now.

        Raises:
            TimeoutError, ConnectionError: if it does not answer, or not with its sensors.
        """
        sensors = self._exchange()
        raw = sensors["steps"].astype("i8")
        if self._raw_steps is not None:  # counters go round after 2**15 steps, four metres
            self._steps += (raw - self._raw_steps + 2**15) % 2**16 - 2**15
        self._raw_steps = raw
        fresh = np.zeros(1, READING)[0]
        fresh["identity"], fresh["cycle"], fresh["infrared"] = self.identity, self.cycle, SILENCE
        fresh["proximity"] = np.minimum(sensors["proximity"] / PROXIMITY_FULL, 1.0)
        fresh["light"] = 1.0 - np.minimum(sensors["ambient"] / DARK, 1.0)
        fresh["ground"] = np.minimum(sensors["ground"] / WHITE, 1.0)
        fresh["left_steps"], fresh["right_steps"] = self._steps
        for name in READING.names or ():
            reading[name] = fresh[name]
        self.cycle += 1

    def act(self, command: Any) -> None:
        """Do what a COMMAND record of ``robots.records`` says: wheels, cut to their limit, and lights.

        Raises:
            ValueError: if a speed is no number, or the colour is none.
            TimeoutError, ConnectionError: if the robot does not answer.
        """
        speeds = (float(command["left"]), float(command["right"]))
        if not all(map(math.isfinite, speeds)):
            raise ValueError(f"robot {self.identity}: wheel speeds {speeds[0]} and {speeds[1]} m/s: must be finite")
        if int(command["colour"]) not in SHOWN:
            raise ValueError(
                f"robot {self.identity}: colour = {command['colour']}: must be 0 to {max(SHOWN)}, see Colour"
            )
        self._actuators["speeds"] = [self._steps_per_second(speed) for speed in speeds]
        self._actuators["colours"] = np.round(BRIGHTEST * np.array(SHOWN[Colour(int(command["colour"]))]))
        self.ignored.update({"radio": int(np.any(command["enabled"])), "infrared": int(command["infrared"] != SILENCE)})
        self._exchange()

    def _steps_per_second(self, speed: float) -> int:
        """Return n v / (2 pi r), rounded, for v m/s at the rim of a wheel of radius r with n steps a turn."""
        table = self.epuck
        limited = min(table.speed_limit, max(-table.speed_limit, speed))
        steps = round(limited * table.steps_per_turn / (2.0 * math.pi * table.wheel_radius))
        return min(MOST_STEPS, max(-MOST_STEPS, steps))

    def _exchange(self) -> np.ndarray:
        """Set the actuators and return the sensors: every request does both."""
        self.line.send(request(self.framing, self._actuators))
        header = self.line.receive(len(self.framing.header))
        if header != self.framing.header:
            raise GarbledAnswer(f"robot {self.identity} answers with packet 0x{header.hex()}, not with its sensors")
        answer = self.line.receive(SENSORS.itemsize + self.framing.rest)
        return np.frombuffer(answer[: SENSORS.itemsize], SENSORS)[0]

    def stop(self) -> None:
        """Stand still, lights off. Tries even if the robot no longer answers."""
        self._actuators[:] = np.zeros(1, ACTUATORS)
        self.line.send(request(self.framing, self._actuators))

    def __enter__(self) -> "EPuck2":
        """Return the robot."""
        return self

    def __exit__(self, *_: object) -> None:
        """Stop it and hang up."""
        try:
            self.stop()
        finally:
            self.line.close()

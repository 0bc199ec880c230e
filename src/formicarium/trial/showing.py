"""Packets and tables of records, from the parts of a state that every system has."""

import math
from collections.abc import Callable, Iterable, Mapping
from typing import Any

import numpy as np

from formicarium.robots.epuck import PROXIMITY_ANGLES
from formicarium.robots.records import SILENCE, Colour
from formicarium.trial.watching import Section

Words = Mapping[str, Callable[[Any], str]]  # field -> how its value is written

WRONG_CONTENT = 10.0  # cost of a sender that says something else than what was heard


def has_radio(state: Any) -> bool:
    """Tell whether the robots of a system hear packets at all."""
    readings = getattr(state, "readings", None)
    return readings is not None and "packets" in readings.dtype.names


def packets_of(state: Any) -> np.ndarray:
    """Return who heard whom in the last cycle: (P, 2) columns of receiver and sender, as frames are ordered.

    Where a message does not name its sender a viewer can tell all the same: it is the robot that says just that in
    the direction from which it came. Robots without radio hear nobody.
    """
    if not has_radio(state):
        return np.zeros((0, 2), "u2")
    readings, robots, bodies = (np.asarray(part) for part in (state.readings, state.robots, state.world.bodies))
    heard = np.arange(readings["packets"].shape[1]) < readings["packet_count"][:, None]
    heard &= robots["alive"][:, None] == 1
    receiver, place = np.nonzero(heard)
    packet = readings["packets"][receiver, place]
    column = np.empty(len(robots), "i8")
    column[np.argsort(robots["identity"])] = np.arange(len(robots))
    if "sender" in (packet.dtype.names or ()):
        body_of = np.zeros(robots["identity"].max() + 1, "i8")
        body_of[robots["identity"]] = np.arange(len(robots))
        return np.stack([column[receiver], column[body_of[packet["sender"]]]], axis=1).astype("u2")
    dx = bodies["x"][None] - bodies["x"][receiver, None]
    dy = bodies["y"][None] - bodies["y"][receiver, None]
    turn = np.arctan2(dy, dx) - bodies["heading"][receiver, None] - packet["bearing"][:, None]
    cost = np.abs((turn + math.pi) % (2 * math.pi) - math.pi)
    cost += np.abs(np.log((np.hypot(dx, dy) + 1e-9) / np.maximum(packet["distance"], 1e-3)[:, None]))
    said = np.ascontiguousarray(np.asarray(state.commands)["payload"]).view("u4")[..., 0]  # (N, EMITTERS)
    content = np.ascontiguousarray(packet["payload"]).view("u4")
    saying = ((said[None] == content[:, None]) & (np.asarray(state.commands)["enabled"] == 1)[None]).any(axis=2)
    cost += np.where(saying, 0.0, WRONG_CONTENT)
    cost[np.arange(len(receiver)), receiver] = math.inf
    sender = cost.argmin(axis=1) if len(receiver) else receiver
    return np.stack([column[receiver], column[sender]], axis=1).astype("u2")


def degrees(angle: float) -> str:
    """Write an angle given in radians."""
    return f"{math.degrees(angle):.0f}°"


def metres(length: float) -> str:
    """Write a length."""
    return f"{length:.3f} m"


def colour(number: int) -> str:
    """Write a Colour by name."""
    return Colour(int(number)).name.lower()


def byte(number: int) -> str:
    """Write an infrared byte."""
    return "silence" if number == SILENCE else f"{int(number):#04x}"


def plain(value: Any) -> str:
    """Write a value nobody said more about."""
    if isinstance(value, np.ndarray):
        return " ".join(plain(item) for item in value.ravel())
    return f"{float(value):.3f}" if isinstance(value, float | np.floating) else str(int(value))


def fields(record: Any, words: Words, leave: Iterable[str] = (), before: str = "") -> list[tuple[str, str]]:
    """Return every field of a record with its value in words, groups of fields as "group.field"."""
    rows = []
    for name in record.dtype.names:
        value = record[name]
        if name in leave:
            continue
        if name in words:
            rows.append((f"{before}{name}", words[name](value)))
        elif isinstance(value, np.void):
            rows += fields(value, words, (), f"{before}{name}.")
        else:
            rows.append((f"{before}{name}", plain(value)))
    return rows


def side_by_side(title: str, records: Mapping[str, Any], words: Words) -> Section:
    """Return a table of equal records: a row a field, a column a record."""
    written = {head: fields(record, words) for head, record in records.items()}
    names = [name for name, _ in next(iter(written.values()))] if written else []
    rows = tuple((name, *(column[k][1] for column in written.values())) for k, name in enumerate(names))
    return Section(title, ("field", *written), rows)


def reading_sections(reading: Any) -> list[Section]:
    """Return what a robot senses, but for the content of packets."""
    words = {"infrared": byte}
    rays = [name for name in ("proximity", "light") if name in reading.dtype.names]
    rows = fields(reading, words, (*rays, "blobs", "packets"))
    sensors = zip(PROXIMITY_ANGLES, *(reading[name] for name in rays))
    titles = {"proximity": "0 nothing, 1 touching", "light": "light, 0 dark"}
    blobs = reading["blobs"][: int(reading["blob_count"])]
    return [
        Section("Reading", ("field", "value"), tuple(rows)),
        Section(
            "Proximity",
            ("towards", *(titles[name] for name in rays)),
            tuple((degrees(angle), *(f"{value:.2f}" for value in values)) for angle, *values in sensors),
        ),
        Section(
            "Lights seen",
            ("colour", "distance", "bearing"),
            tuple((colour(b["colour"]), metres(b["distance"]), degrees(b["bearing"])) for b in blobs),
        ),
    ]


def said(command: Any) -> dict[str, np.ndarray]:
    """Return the different contents a robot sends, each headed by the directions of its emitters in degrees."""
    contents: dict[bytes, list[int]] = {}
    for k in np.nonzero(command["enabled"])[0]:
        contents.setdefault(command["payload"][k].tobytes(), []).append(int(k) * 30)
    every = len(command["enabled"])
    return {
        "all round" if len(ways) == every else " ".join(f"{way}°" for way in ways): np.frombuffer(content, "u1")
        for content, ways in contents.items()
    }

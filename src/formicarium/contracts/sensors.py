"""No dead sensor: whatever a controller may read, there is something to be read."""

from typing import Any

import numpy as np

from formicarium.contracts.broken import require
from formicarium.contracts.states import leaves, recorded


def seen(name: str, cycles: int, every: int) -> tuple[np.ndarray, set[str]]:
    """Return the readings of all robots at many cycles, (time, robot), and which senses had nothing to sense."""
    rows: list[Any] = []
    idle = {"blob", "packet", "infrared"}
    for state in recorded(name, every):
        rows.append(state.readings)
        idle -= sensible(state)
        if len(rows) * every >= cycles:
            break
    return np.array(rows[1:]), idle  # nothing has been read before the first cycle


def sensible(state: Any) -> set[str]:
    """Return the senses for which there is something in the world: lights, radio, infrared."""
    names = state.commands.dtype.names or ()
    lights = getattr(state, "lights", None)
    found = set()
    if ("colour" in names and state.commands["colour"].any()) or (lights is not None and lights["colour"].any()):
        found.add("blob")
    if "enabled" in names and state.commands["enabled"].any():
        found.add("packet")
    if "infrared" in names and (state.robots["infrared_heard"] >= 0).any():
        found.add("infrared")
    return found


def no_dead_sensor(name: str) -> None:
    """Every field of a reading varies, unless nobody shines, sends or speaks in this system at all."""
    readings, idle = seen(name, cycles=4000, every=3)
    dead = []
    for path, values in leaves(readings):
        if path[1:].startswith(tuple(idle)):
            continue
        rest = values.shape[2:]
        # proximity[8] and payload[4] are sensors one by one; lists of blobs and packets are only lists
        sensors = rest[-1] if len(rest) == path.count(".") else 1
        table = values.reshape(-1, sensors)
        dead += [f"{path}[{k}]" for k in range(sensors) if len(np.unique(table[:, k])) < 2]
    said = words_of(name)
    dead = [path for path in dead if not unused_word(path, readings, said)]
    require(not dead, f"always the same in 4000 cycles: {', '.join(dead)}")


def words_of(name: str) -> set[str]:
    """Return the fields of what robots say, where a Command holds a message; what is measured is none of them."""
    fields = next(recorded(name, 1)).commands.dtype.fields or {}
    return set(fields["message"][0].names) if "message" in fields else set()


def unused_word(path: str, readings: np.ndarray, said: set[str]) -> bool:
    """Tell whether a word of the messages is simply not used: 0 in all packets, a whole number or among ``said``."""
    if not path.startswith(".packets."):
        return False
    name, _, place = path.removeprefix(".packets.").removesuffix("]").partition("[")
    words = readings["packets"]
    for part in name.split("."):
        words = words[part]
    if words.ndim > readings["packets"].ndim:
        words = words[..., int(place)]
    return (bool(np.issubdtype(words.dtype, np.integer)) or name.partition(".")[0] in said) and not words.any()


def own_identity_and_clock(name: str) -> None:
    """Every robot has its own identity, and a clock that counts cycles."""
    readings, _ = seen(name, cycles=60, every=1)
    require((readings["identity"] == readings["identity"][0]).all(), "an identity changes")
    require(len(np.unique(readings["identity"][0])) == readings.shape[1], "two robots share an identity")
    steps = np.diff(readings["cycle"], axis=0)
    require(((steps == 1) | (readings["cycle"][1:] <= 1)).all(), "reading.cycle does not count cycles one by one")


def own_noise(name: str) -> None:
    """No two robots feel the same noise, where they have proximity sensors."""
    readings, _ = seen(name, cycles=400, every=1)
    if "proximity" not in (readings.dtype.names or ()):
        return  # robots that read no distances; their other sensors may be without noise
    proximity = readings["proximity"].reshape(len(readings), -1)
    require(len(np.unique(proximity, axis=1).T) == proximity.shape[1], "two proximity sensors read the same 400 times")

"""States of any system: begun, recorded on the way, copied, compared leaf by leaf, turned and shifted."""

import itertools
import math
from collections.abc import Iterator
from typing import Any
from unittest import SkipTest

import numpy as np

from formicarium.physics.world import ADJUSTABLE, make_world
from formicarium.systems.registry import System, resolve


def copy_of(state: Any) -> Any:
    """Return an independent copy of a state: a snapshot."""
    return type(state)(*[copy_of(part) if isinstance(part, tuple) else part.copy() for part in state])


def recorded(name: str, every: int, parameters: Any = None, first_seed: int = 1) -> Iterator[Any]:
    """Yield copies of the states of trials ``first_seed``, ``first_seed`` + 1, ..., one every so many cycles."""
    system = resolve(name)
    for seed in itertools.count(first_seed):
        state = begun(system, parameters or system.configure(), seed)
        clock = state.clock[0]
        while not clock.finished and clock.cycle < clock.last_cycle:
            yield copy_of(state)
            advanced(system, state, every)
            clock.event_count = 0


def leaves(value: Any, path: str = "") -> Iterator[tuple[str, np.ndarray]]:
    """Yield every plain array inside a state, with its path (padding between fields is nobody's)."""
    if isinstance(value, tuple):
        for name, part in zip(value._fields, value, strict=True):  # type: ignore[attr-defined]
            yield from leaves(part, f"{path}.{name}")
    elif value.dtype.names:
        for name in value.dtype.names:
            yield from leaves(np.asarray(value[name]), f"{path}.{name}")
    else:
        yield path, np.asarray(value)


def differences(one: Any, other: Any) -> list[str]:
    """Return the paths of all arrays that are not the same to the last bit."""
    pairs = zip(leaves(one), leaves(other), strict=True)
    return [path for (path, a), (_, b) in pairs if a.tobytes() != b.tobytes()]


def distances(one: Any, other: Any) -> dict[str, float]:
    """Return the greatest difference in every array; angles that differ by whole turns are the same."""
    result = {}
    for (path, a), (_, b) in zip(leaves(one), leaves(other), strict=True):
        gap = np.abs(a.astype(float) - b.astype(float))
        if path.endswith("bearing"):
            gap = np.abs((gap + math.pi) % (2.0 * math.pi) - math.pi)
        result[path] = float(gap.max(initial=0.0))
    return result


# Pairs of fields that are places (turned and shifted) or directions (turned only).
PLACES = (("x", "y"), ("ax", "ay"), ("bx", "by"))
DIRECTIONS = (("speed_x", "speed_y"), ("cosine", "sine"))


def turned_records(array: np.ndarray, turn: float, shift: tuple[float, float]) -> np.ndarray:
    """Return a copy of records whose world coordinates are turned about the origin, then shifted."""
    result = array.copy()
    names = result.dtype.names or ()
    cosine, sine = math.cos(turn), math.sin(turn)
    for pairs, (dx, dy) in ((PLACES, shift), (DIRECTIONS, (0.0, 0.0))):
        for x, y in pairs:
            if x in names and y in names:
                result[x] = cosine * array[x] - sine * array[y] + dx
                result[y] = sine * array[x] + cosine * array[y] + dy
    if "heading" in names:
        result["heading"] = array["heading"] + turn
    return result


def turned_world(world: Any, turn: float, shift: tuple[float, float]) -> Any:
    """Return the world with bodies and scenery turned and shifted, its grids made anew."""
    settings = {name: world.settings[name][0] for name in ADJUSTABLE}
    bodies, segments = (turned_records(part, turn, shift) for part in (world.bodies, world.segments))
    return make_world(bodies, segments, **settings)


def turned(state: Any, turn: float, shift: tuple[float, float]) -> Any:
    """Return a copy of a state in a turned and shifted world; what is inside a robot stays as it is."""
    state = copy_of(state)
    parts = {}
    for name, part in state._asdict().items():
        if name == "world":
            parts[name] = turned_world(part, turn, shift)
        elif isinstance(part, np.ndarray):
            parts[name] = turned_records(part, turn, shift)
    return state._replace(**parts)


def shortened(system: System, parameters: Any, longest: float) -> Any:
    """Return the parameters with a time cap of at most ``longest`` seconds, if the system has one."""
    swarm = getattr(parameters, "swarm", None)
    if swarm is None or not hasattr(swarm, "time_cap"):
        return parameters
    cap = min(float(swarm.time_cap), longest)
    return parameters.model_copy(update={"swarm": swarm.model_copy(update={"time_cap": cap})})


def length_of(system: System, parameters: Any, seed: int, most: int) -> int:
    """Return how many cycles trial ``seed`` has, counted up to ``most``."""
    state = begun(system, parameters, seed)
    clock = state.clock[0]
    clock.last_cycle = min(int(clock.last_cycle), most)
    while not clock.finished and clock.cycle < clock.last_cycle:
        advanced(system, state, min(100, int(clock.last_cycle - clock.cycle)))
        clock.event_count = 0
    return int(clock.cycle)


def begun(system: System, parameters: Any, seed: int, **options: Any) -> Any:
    """Return the state before the first cycle.

    Raises:
        SkipTest: if the system does not show its states.
    """
    if system.begin is None or system.advance is None:
        raise SkipTest(f"{system.name} has no begin and advance")
    return system.begin(parameters, seed, **options)


def advanced(system: System, state: Any, cycles: int) -> Any:
    """Let so many cycles pass; return the state, which is changed in place."""
    assert system.advance is not None
    system.advance(state, cycles)
    return state

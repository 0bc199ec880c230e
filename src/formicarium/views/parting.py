"""Where two trials part: the first cycle, robot and field."""

from collections.abc import Iterator
from typing import Any, NamedTuple

import numpy as np

from formicarium.trial.record import Frames
from formicarium.views.live.session import Session
from formicarium.views.recording.digest import deciding, digest

LOOK = 100  # cycles between two comparisons, until they part


class Parting(NamedTuple):
    """The first difference."""

    cycle: int
    robot: int  # identity; 0 if the field belongs to no robot
    field: str
    one: Any
    other: Any


def first_state_apart(a: Session, b: Session, end: int | None = None) -> Parting | None:
    """Run two trials side by side until they part, to their end or cycle ``end``; None if they do not."""
    last = max(a.last_cycle, b.last_cycle) if end is None else end
    agreed = 0
    while True:
        if digest(a.state) != digest(b.state) or a.cycle != b.cycle:
            break
        agreed = a.cycle
        if a.cycle >= last or (a.finished and b.finished):
            return None
        cycles = min(LOOK, last - a.cycle)
        a.advance(cycles)
        b.advance(cycles)
    a.seek(agreed)
    b.seek(agreed)
    while digest(a.state) == digest(b.state) and a.cycle == b.cycle:
        a.advance(1)
        b.advance(1)
    return _parted(a, b)


def _parted(a: Session, b: Session) -> Parting:
    if a.cycle != b.cycle:
        ended = min(a.cycle, b.cycle)
        return Parting(ended, 0, "clock.finished", a.finished, b.finished)
    for (path, one), (_, other) in zip(_leaves(a.state), _leaves(b.state), strict=False):
        if one.shape != other.shape:
            return Parting(a.cycle, 0, path, f"{one.shape[0]} records", f"{other.shape[0]} records")
        apart = np.nonzero(one != other)[0]
        if len(apart):
            i = int(apart[0])
            robots = np.asarray(a.state.robots["identity"])
            owner = int(robots[i]) if len(one) == len(robots) else 0
            return Parting(a.cycle, owner, path, _value(one[i]), _value(other[i]))
    return Parting(a.cycle, 0, "padding", "", "")


def _leaves(state: Any) -> Iterator[tuple[str, np.ndarray]]:
    for name, part in deciding(state):
        yield from _fields(name, part)


def _fields(path: str, array: np.ndarray) -> Iterator[tuple[str, np.ndarray]]:
    if array.dtype.names:
        for name in array.dtype.names:
            yield from _fields(f"{path}.{name}", array[name])
    else:
        yield path, np.ascontiguousarray(array)


def _value(value: Any) -> Any:
    return value.tolist() if isinstance(value, np.ndarray | np.generic) else value


def first_frame_apart(a: Frames, b: Frames) -> Parting | None:
    """Compare recorded frames at the cycles that both have; None if none differs."""
    if a.identity.tolist() != b.identity.tolist():
        return Parting(0, 0, "identity", a.identity.tolist(), b.identity.tolist())
    _, rows_a, rows_b = np.intersect1d(a.cycle, b.cycle, return_indices=True)
    found: list[Parting] = []
    for name in ("x", "y", "heading", "role", "carried"):
        one, other = getattr(a, name)[rows_a], getattr(b, name)[rows_b]
        apart = np.argwhere(one != other)
        if len(apart):
            row, i = apart[0]
            found.append(
                Parting(int(a.cycle[rows_a[row]]), int(a.identity[i]), name, one[row, i].item(), other[row, i].item())
            )
    return min(found, key=lambda parting: parting.cycle) if found else None

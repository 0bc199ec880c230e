"""Running a trial: the compiled loop in looks, between which Python takes snapshots and empties a log half full."""

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from formicarium.compiled import Call, compiled_beside
from formicarium.trial.record import EVENT, Frames

LOOK = 100  # cycles between two looks if nobody wants frames


class EventsLost(RuntimeError):
    """The event log overflowed within one look."""


class Album:
    """Frames as they are taken; robots in the order of their identities."""

    def __init__(self, state: Any, role: Callable[[Any], np.ndarray], carried: Callable[[Any], np.ndarray]) -> None:
        self.order = np.argsort(state.robots.identity)
        self.identity = np.array(state.robots.identity[self.order])
        self.role, self.carried = role, carried
        self.rows: list[tuple[Any, ...]] = []

    def take(self, state: Any, lit: np.ndarray) -> None:
        """Take one frame."""
        bodies = state.world.bodies[self.order]
        self.rows.append(
            (
                int(state.clock[0].cycle),
                bodies.x.astype("f4"),
                bodies.y.astype("f4"),
                bodies.heading.astype("f4"),
                self.role(state)[self.order].astype("i1"),
                self.carried(state)[self.order].astype("i1"),
                lit.astype("i1"),
            )
        )

    def frames(self) -> Frames:
        """Return all frames."""
        cycle, x, y, heading, role, carried, lit = (np.array(column) for column in zip(*self.rows, strict=True))
        return Frames(cycle, x, y, heading, role, carried, lit, self.identity)


def drain(state: Any) -> np.ndarray:
    """Empty the event log; return its events by cycle, robot and kind, independent of the robots' storage.

    Raises:
        EventsLost: if the log was too short.
    """
    return in_order(emptied(state))


def emptied(state: Any) -> np.ndarray:
    """Empty the event log; return its events as they were written.

    Raises:
        EventsLost: if the log was too short.
    """
    clock = state.clock[0]
    if clock.events_lost:
        raise EventsLost(f"{clock.events_lost} events did not fit into the log of {len(state.events)}")
    events = np.array(state.events[: clock.event_count]).view(EVENT)
    clock.event_count = 0
    return events


def in_order(events: np.ndarray) -> np.ndarray:
    """Return events by cycle, robot and kind."""
    return events[np.lexsort([events[name] for name in ("detail", "value", "subject", "kind", "robot", "cycle")])]


def simulate(
    run: Callable[[Any, int], None],
    state: Any,
    *,
    apart: Sequence[Call] = (),
    look: int = LOOK,
    every: int = 1,
    take: Callable[[Any], None] | None = None,
    watch: Callable[[float, float], None] | None = None,
) -> np.ndarray:
    """Run a trial to its end and return its events.

    Args:
        run: the system's compiled loop, ``run(state, cycles)``.
        state: the system's state, changed in place.
        apart: some of what the loop calls, and with what: a cold start compiles it in a process of its own.
        look: cycles between two looks, at most; half the event log has room for LOOK.
        every: cycles between two frames.
        take: called with the state at the start, every so many cycles and at the end.
        watch: called after every look with (seconds simulated, seconds at most).
    """
    clock = state.clock[0]
    cycle_time = float(state.world.settings[0].cycle_time)
    logs = []
    if apart:
        with compiled_beside(run, apart):
            run(state, 0)
    if take:
        take(state)
    while not clock.finished and clock.cycle < clock.last_cycle:
        cycles = min(look, int(clock.last_cycle - clock.cycle))
        run(state, min(cycles, every - int(clock.cycle) % every) if take else cycles)
        if clock.events_lost or 2 * clock.event_count > len(state.events):
            logs.append(emptied(state))
        if take and (clock.cycle % every == 0 or clock.finished or clock.cycle >= clock.last_cycle):
            take(state)
        if watch:
            watch(float(clock.cycle) * cycle_time, float(clock.last_cycle) * cycle_time)
    return in_order(np.concatenate([*logs, emptied(state)]))

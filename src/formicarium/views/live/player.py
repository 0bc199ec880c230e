"""Plays a session in a thread of its own at a chosen speed, and keeps the latest picture for whoever looks.

Nobody who looks is waited for: a picture is made at most so many times a second and replaces the one before.
"""

import queue
import threading
import time
from collections.abc import Callable
from contextlib import suppress
from typing import Any, NamedTuple

import numpy as np

from formicarium.trial.watching import Impossible
from formicarium.views.live.wire import (
    Pause,
    Play,
    Seek,
    Show,
    Speed,
    Step,
    Touch,
    Wish,
    frame_bytes,
    inspection_content,
    said,
)

PICTURE = 1.0 / 30.0  # s of wall clock between two pictures
HURRIED_PICTURE = 1.0 / 12.0  # the same while the trial runs as fast as it goes: pictures take its time
SLICE = 0.02  # s of wall clock for which the trial runs before anything else is looked after
INSPECTED = 0.12  # s of wall clock between two inspections
MOST_WISHES = 1000  # that wait; more are let go
MOST_SELECTED = 32  # robots inspected at a time, over all pages


class Shown(NamedTuple):
    """What there is to see; replaced whole, never changed."""

    number: int  # grows with every picture
    frame: bytes
    status: str
    notice: tuple[int, str]  # number and text of the last thing that could not be done


class Player:
    """The trial's own thread."""

    def __init__(self, session: Any, speed: float, playing: bool, describe: Callable[[], dict[str, Any]]):
        """Get ready.

        Args:
            session: what is played: a Session or LoggedFrames.
            speed: times real time; 0 for as fast as it goes.
            playing: whether it begins at once.
            describe: adds to the status what only the command knows (verified, recording).
        """
        self.session = session
        self.speed, self.playing = speed, playing
        self.inspections: dict[int, tuple[int, str]] = {}  # identity -> number, message
        self.selected: dict[Any, int] = {}  # page -> identity
        self.packets: set[Any] = set()  # pages that show packets
        self.audience: Callable[[], None] = lambda: None  # called after every picture
        self.watched = False  # whether anybody looks
        self.failure: BaseException | None = None
        self._describe = describe
        self._wishes: queue.Queue[tuple[Any, Wish] | None] = queue.Queue(MOST_WISHES)
        self._target: int | None = None
        self._debt = 0.0  # cycles that are due but not run
        self._jump = True
        self._notice = (0, "")
        self._inspected = 0.0
        self._number = 0
        self._stopping = False
        self._cycle_time = float(session.scene.cycle_time)
        self.shown = self._picture()
        self.thread = threading.Thread(target=self._play, name="trial", daemon=True)

    def ask(self, page: Any, wish: Wish) -> None:
        """Ask for something on behalf of a page; returns at once."""
        with suppress(queue.Full):
            self._wishes.put_nowait((page, wish))

    def stop(self) -> None:
        """End the thread."""
        self._stopping = True
        with suppress(queue.Full):
            self._wishes.put_nowait(None)
        if self.thread.ident is not None:
            self.thread.join()
        self.session.stop()

    def _play(self) -> None:
        try:
            before = drawn = time.perf_counter()
            while not self._stopping:
                now = time.perf_counter()
                moved = self._run(now - before)
                before = now
                changed = self._listen(0.0 if moved and self._hurried else self._pause(drawn))
                if changed or (moved and time.perf_counter() - drawn >= self._between * 0.9):
                    drawn = time.perf_counter()
                    self._publish(changed)
        except BaseException as error:  # told on the page and by the command
            self.failure, self.playing = error, False
            self._notice = (self._notice[0] + 1, f"the trial has stopped: {type(error).__name__}: {error}")
            self.shown = self.shown._replace(number=self.shown.number + 1, notice=self._notice)
            self.audience()

    @property
    def _hurried(self) -> bool:
        return self._target is not None or (self.playing and self.speed == 0)

    @property
    def _between(self) -> float:
        return HURRIED_PICTURE if self._hurried else PICTURE

    def _pause(self, drawn: float) -> float:
        if not self.playing or self.session.finished:
            return 0.5
        return max(0.0, drawn + PICTURE - time.perf_counter())

    def _run(self, passed: float) -> bool:
        """Run what is due after so many seconds of wall clock; return whether anything was."""
        if self._target is not None:
            return self._approach()
        if not self.playing or self.session.finished:
            self._debt = 0.0
            return False
        if self.speed == 0:
            return self._sprinted(10**12) > 0
        self._debt = min(self._debt + passed * self.speed / self._cycle_time, self.speed / self._cycle_time)
        cycles = int(self._debt)
        if cycles:
            self._debt -= cycles
            self._debt += cycles - self._sprinted(cycles)
        return cycles > 0

    def _approach(self) -> bool:
        assert self._target is not None
        self._sprinted(self._target - self.session.cycle)
        if self.session.cycle >= self._target or self.session.finished:
            self._target = None
        return True

    def _sprinted(self, cycles: int) -> int:
        """Run up to so many cycles, but not longer than a slice; return how many."""
        end, start, some = time.perf_counter() + SLICE, self.session.cycle, 1
        while (left := start + cycles - self.session.cycle) > 0 and not self.session.finished:
            self.session.advance(min(left, some))
            some = min(some * 2, 100)
            if time.perf_counter() > end:
                break
        return self.session.cycle - start

    def _listen(self, patience: float) -> bool:
        """Wait for wishes and do them; return whether there were any."""
        found = False
        while not self._stopping:
            try:
                asked = self._wishes.get(timeout=patience) if patience > 0 else self._wishes.get_nowait()
            except queue.Empty:
                return found
            if asked is not None:
                self._do(*asked)
                found, patience = True, 0.0
        return found

    def _do(self, page: Any, wish: Wish) -> None:
        session = self.session
        if isinstance(wish, Play):
            if session.finished and session.cycle >= session.frontier:
                self._go_to(0)
            self.playing = True
        elif isinstance(wish, Pause):
            self.playing, self._target = False, None
        elif isinstance(wish, Step):
            self.playing = False
            session.advance(wish.cycles)
        elif isinstance(wish, Speed):
            self.speed = wish.times
        elif isinstance(wish, Seek):
            self._go_to(min(wish.cycle, session.last_cycle))
        elif isinstance(wish, Show):
            (self.packets.add if wish.on else self.packets.discard)(page)
        elif isinstance(wish, Touch):
            try:
                session.intervene(wish.do, wish.subject, wish.x, wish.y)
            except Impossible as reason:
                self._notice = (self._notice[0] + 1, str(reason))
            self._jump = True
        else:
            self.selected.pop(page, None)
            if wish.robot in session.identity and len(self.selected) < MOST_SELECTED:
                self.selected[page] = wish.robot

    def _go_to(self, cycle: int) -> None:
        self.session.turn_to(cycle)
        self._target, self._jump = cycle, True
        self._approach()

    def leave(self, page: Any) -> None:
        """Forget a page."""
        self.selected.pop(page, None)
        self.packets.discard(page)

    def _publish(self, changed: bool) -> None:
        if not self.watched:
            return
        now = time.perf_counter()
        if changed or now - self._inspected > INSPECTED:
            self._inspected = now
            self.inspections = {robot: self._inspection(robot) for robot in set(self.selected.copy().values())}
        self.shown = self._picture()
        self.audience()

    def _inspection(self, robot: int) -> tuple[int, str]:
        found = self.session.inspect(robot)
        content = {} if found is None else inspection_content(found)
        return self._number, said("inspection", cycle=self.session.cycle, **content)

    def _picture(self) -> Shown:
        session = self.session
        self._number += 1
        packets = session.packets() if self.packets else np.zeros((0, 2), "u2")
        frame = frame_bytes(session.frame(), packets, session.turns, session.frontier, self._jump)
        status = said(
            "status",
            cycle=session.cycle,
            frontier=session.frontier,
            playing=self.playing,
            seeking=self._target is not None,
            speed=self.speed,
            finished=session.finished,
            ended=session.ended,
            interventions=[list(deed) for deed in session.interventions],
            **self._describe(),
        )
        self._jump = False
        return Shown(self._number, frame, status, self._notice)

    def refresh(self) -> None:
        """Make a picture for somebody who has just come."""
        self.ask(None, Show(do="packets", on=False))

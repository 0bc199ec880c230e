"""One trial that can be played, sought, touched, recorded and checked, cycle by cycle.

Nothing that is done to look at it changes a byte of it. Only an intervention does, and it is kept.
"""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from formicarium.systems.registry import System
from formicarium.trial.film import frames_of, make_film
from formicarium.trial.record import EVENT, Frames, Scene
from formicarium.trial.showing import has_radio, packets_of
from formicarium.trial.simulate import LOOK, drain
from formicarium.trial.watching import Inspection, Intervention, Watching
from formicarium.views.live.checking import Checks
from formicarium.views.live.snapshots import Snapshots
from formicarium.views.recording.recorder import Recorder


class Unwatchable(ValueError):
    """The system does not say how it is shown."""


def watching_of(system: System) -> tuple[Any, Any, Watching]:
    """Return what is needed to watch a system: begin, advance and how it is shown.

    Raises:
        Unwatchable: if something is missing.
    """
    if system.begin is None or system.advance is None or system.watching is None:
        raise Unwatchable(f"{system.name} cannot be watched: its System has no begin, advance and watching")
    return system.begin, system.advance, system.watching


class Session:
    """A trial under observation."""

    touchable = True

    def __init__(
        self,
        system: System,
        parameters: Any,
        seed: int,
        planned: Sequence[Intervention] = (),
        checks: Checks | None = None,
        scrubbed: bool = True,
    ):
        """Begin the trial.

        Args:
            system: what to run.
            parameters: all its numbers.
            seed: decides everything that is random.
            planned: interventions to make again, by cycle.
            checks: digests that the trial must have.
            scrubbed: whether the trial may be sent back; snapshots are kept only then.

        Raises:
            Unwatchable: if the system does not say how it is shown.
        """
        begin, self._run, self.watching = watching_of(system)
        self.blockable = self.watching.blockable
        self.system, self.parameters, self.checks = system, parameters, checks
        self.state = begin(parameters, seed)
        self.scene: Scene = self.watching.scene(parameters, self.state)
        self.identity = np.sort(np.asarray(self.state.robots["identity"]))
        clock = np.asarray(self.state.clock)
        self._cycle, self._finished = clock["cycle"], clock["finished"]
        self.last_cycle = int(clock["last_cycle"][0])
        self.interventions = list(planned)
        self.done = 0  # interventions made so far
        self.frontier = 0  # the farthest cycle that has been simulated
        self.turns = 0  # how often the trial has taken another turn, by an intervention in its past
        self.recorder: Recorder | None = None
        self._still = make_film(1, len(self.identity), self.scene)
        self.logs: list[np.ndarray] = []  # events in the order of looks; only ever added to, so that others may read it
        self._looked = 0  # events of all cycles before this one are in the log
        self._over = False
        self.snapshots = Snapshots(self.state)
        self._scrubbed = scrubbed
        self._arrive()

    @property
    def radio(self) -> bool:
        """Whether robots hear packets that could be shown."""
        return has_radio(self.state)

    @property
    def cycle(self) -> int:
        """Where the trial stands."""
        return int(self._cycle[0])

    @property
    def finished(self) -> bool:
        """Whether there is no next cycle."""
        return bool(self._finished[0]) or self.cycle >= self.last_cycle

    @property
    def ended(self) -> bool:
        """Whether the end of the trial is known, wherever it stands now."""
        return self._over

    @property
    def events(self) -> np.ndarray:
        """All events up to the frontier, in order."""
        return np.concatenate([np.zeros(0, EVENT), *self.logs])

    def warm_up(self) -> None:
        """Load or compile the code, on a state that is then let go, so that nobody waits for it later."""
        begin, run, watching = watching_of(self.system)
        spare = begin(self.parameters, 0)
        try:
            run(spare, 1)
        except Exception as error:
            if self.system.explained is None:
                raise
            raise self.system.explained(self.parameters, 0, 0, error) from error
        watching.roll(spare, 1, 1, make_film(1, len(self.identity), self.scene))
        watching.shoot(spare, make_film(1, len(self.identity), self.scene))

    def record(self, recorder: Recorder) -> None:
        """Record the trial from its beginning."""
        self.recorder = recorder
        self.watching.shoot(self.state, recorder.film)

    def advance(self, cycles: int) -> None:
        """Run so many cycles, or until the trial is finished."""
        end = min(self.cycle + cycles, self.last_cycle)
        while self._cycle[0] < end and not self._finished[0]:
            now = int(self._cycle[0])
            if self.recorder and now >= self.frontier:
                self.watching.roll(self.state, self._stop(end) - now, self.recorder.every, self.recorder.film)
            else:
                self._run(self.state, self._stop(end) - now)
            self._arrive()
        self._look()

    def _stop(self, end: int) -> int:
        """Return the next cycle at which something is to be done, ``end`` at the latest."""
        now = int(self._cycle[0])
        end = min(end, now + LOOK - now % LOOK)
        if now < self.frontier:
            end = min(end, self.frontier)
        if self.checks and (check := self.checks.next(now)) is not None:
            end = min(end, check)
        if self.done < len(self.interventions):
            end = min(end, max(self.interventions[self.done].cycle, now + 1))
        return end

    def _arrive(self) -> None:
        """Do what is to be done at a cycle: record, check, take a snapshot, make what interventions are due."""
        cycle = int(self._cycle[0])
        new = cycle > self.frontier
        if cycle % LOOK == 0:
            self._look()
        if new:
            self.frontier = cycle
            if self.recorder and self.recorder.full:
                self._look()  # a file that is cut off has all events up to its last frame
                self.recorder.flush(cycle)
            if self.finished and not self._over:
                self._end()
        if self.checks:
            self.checks.compare(cycle, self.state, new)
        if self._scrubbed and self.snapshots.due(cycle):
            self._look()
            self.snapshots.take(cycle, self.done)
        while self.done < len(self.interventions) and self.interventions[self.done].cycle <= cycle:
            self.watching.intervene(self.state, self.interventions[self.done])
            self.done += 1

    def _look(self) -> None:
        """Empty the event log; events that have been seen before are let go."""
        if self.state.clock["event_count"][0]:
            found = drain(self.state)
            found = found[found["cycle"] >= self._looked]
            if len(found):
                self.logs.append(found)
                if self.recorder:
                    self.recorder.note(found)
        self._looked = max(self._looked, int(self._cycle[0]))

    def _end(self) -> None:
        self._over = True
        self._look()
        if self.recorder:
            self.recorder.close(self.cycle, self.outcome())
            self.recorder = None

    def stop(self) -> None:
        """Close the recording of a trial that is left before its end."""
        if self.recorder:
            self._look()
            touched = any(deed.cycle == self.frontier for deed in self.interventions)
            self.recorder.close(self.frontier, None, self.cycle == self.frontier and not touched)
            self.recorder = None

    def outcome(self) -> Mapping[str, Any]:
        """Return the outcome row; the trial must stand at its end."""
        return self.watching.outcome(self.parameters, self.state, self.events)

    def turn_to(self, cycle: int) -> None:
        """Go back to the last snapshot before ``cycle``, if that is nearer than where the trial stands."""
        if cycle < self.cycle or self.snapshots.nearest(cycle) > self.cycle:
            self._look()
            kept = self.snapshots.restore(cycle)
            self.state.clock["event_count"][0] = 0
            self.done = kept.done
            self._arrive()

    def seek(self, cycle: int) -> None:
        """Go to a cycle, back or forward."""
        self.turn_to(cycle)
        self.advance(cycle - self.cycle)

    def frame(self) -> Frames:
        """Return one frame: now."""
        self._still.taken[0] = 0
        self.watching.shoot(self.state, self._still)
        return frames_of(self._still, np.asarray(self.state.robots["identity"]))

    def packets(self) -> np.ndarray:
        """Return who heard whom just now: columns of receiver and sender."""
        return packets_of(self.state)

    def inspect(self, identity: int) -> Inspection | None:
        """Return what is in a robot."""
        return self.watching.inspect(self.state, identity)

    def intervene(self, deed: str, subject: int, x: float = 0.0, y: float = 0.0) -> None:
        """Do something to the trial now; what was simulated beyond this cycle is no more.

        Raises:
            Impossible: if it cannot be done; nothing has changed then.
        """
        cycle = self.cycle
        self._look()
        intervention = Intervention(cycle, deed, subject, x, y)
        self.watching.intervene(self.state, intervention)
        if self.frontier > cycle:
            self._cut(cycle)
        self.interventions[self.done :] = [intervention]
        self.done += 1
        if self.recorder:
            self.recorder.deed(intervention)
        if self.checks:
            self.checks.leave(cycle)

    def _cut(self, cycle: int) -> None:
        """Forget all that came after a cycle."""
        events = self.events
        self.logs = [events[events["cycle"] < cycle]]
        self.frontier = self._looked = cycle
        self.snapshots.forget_after(cycle)
        self._over = False
        self.turns += 1
        if self.recorder:
            self.recorder.back(cycle)

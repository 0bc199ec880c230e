"""Run what a campaign lacks: take runs from the ledger, hand them to a crew, keep what comes back."""

import contextlib
import math
import pickle
import time
from collections import Counter, deque
from collections.abc import Callable, Iterator, Sequence
from typing import NamedTuple

from formicarium.campaigns.cells import Job, Key
from formicarium.campaigns.crew import Crew, Task
from formicarium.campaigns.errors import CrewError, Futile
from formicarium.campaigns.files import StoreError
from formicarium.campaigns.interruption import held_back
from formicarium.campaigns.result import Ending, Finished
from formicarium.campaigns.writer import Writer

PERIOD = 0.5  # seconds between two transactions: what a kill can cost besides the runs under way
LOOK = 1.0  # seconds between two looks at runs that another coordinator has taken
ATTEMPTS = 3  # of a run whose process dies, before that counts as its failure
MOST_AHEAD = 200  # runs that are taken ahead for each worker


class Standing(NamedTuple):
    """How far a campaign is."""

    total: int  # runs of the design
    done: int  # with a row in the ledger, whoever made it
    failed: int
    running: int  # here
    elsewhere: int  # taken by other coordinators
    produced: int  # here, in this sitting
    seconds: float  # of this sitting


class Report(NamedTuple):
    """What a sitting did."""

    standing: Standing
    loaded: int  # runs that were there already
    failures: tuple[Finished, ...]  # of this sitting
    notes: tuple[str, ...]  # files that were set aside, and why


def run_campaign(
    jobs: Sequence[Job],
    writer: Writer,
    crew: Crew,
    *,
    keep: Sequence[str] = (),
    share: tuple[int, int] = (0, 1),
    progress: Callable[[Standing], None] | None = None,
) -> Report:
    """Run every run of the jobs that is neither done nor failed; results do not depend on the crew.

    Args:
        jobs: the cells of the design.
        writer: of the ledger.
        crew: who does the runs; it is closed at the end.
        keep: tables a run must have left to count as done.
        share: (first, every): only every so manieth run of the jobs, beginning with the first.
        progress: told about twice a second how far the campaign is.

    Raises:
        KeyboardInterrupt: on Ctrl-C; every run that had ended is kept.
        Futile: if no run can succeed; every run that had ended is kept.
        CrewError: if all workers are gone for good; every run that had ended is kept.
        StoreError: if the folder cannot be written; every run kept before stays.
    """
    sitting = _Sitting(jobs, writer, crew, keep, share)
    told = progress or (lambda standing: None)
    try:
        while sitting.goes_on():
            told(sitting.standing())
            sitting.step()
        told(sitting.standing())
    except StoreError:
        raise  # nothing more can be kept
    except BaseException:
        with held_back():
            sitting.stop()
        raise
    finally:
        with held_back():
            crew.close()
    return Report(sitting.final(), sitting.loaded, tuple(sitting.failures), tuple(writer.notes))


class _Sitting:
    """The state of one sitting: every run is waiting, taken, running, ended, with others, or done with."""

    def __init__(self, jobs: Sequence[Job], writer: Writer, crew: Crew, keep: Sequence[str], share: tuple[int, int]):
        self.writer, self.crew, self.keep = writer, crew, keep
        self.functions = {job.configuration.identity: pickle.dumps(job.function) for job in jobs}
        self.keys = keys = [key for job in jobs for key in job.keys][share[0] :: share[1]]
        failed = writer.ledger.failures()
        self.total = len(keys)
        self.waiting = deque(key for key in keys if key not in failed and not writer.ledger.has(key, keep))
        self.failed_before = sum(key in failed and not writer.ledger.has(key, keep) for key in keys)
        self.loaded = self.total - len(self.waiting) - self.failed_before
        self.taken: deque[Key] = deque()
        self.ended: list[Finished] = []
        self.others: list[Key] = []
        self.failures: list[Finished] = []
        self.deaths: Counter[Key] = Counter()
        self.produced = 0
        self.pace = math.inf  # wall-clock seconds of a run, lately
        self.began = self.exchanged = self.looked = time.monotonic()

    def goes_on(self) -> bool:
        return bool(self.waiting or self.taken or self.ended or self.others or self.crew.busy)

    def standing(self) -> Standing:
        failed = self.failed_before + len(self.failures)
        open_runs = len(self.waiting) + len(self.taken) + len(self.ended) + len(self.others) + self.crew.busy
        done = self.total - open_runs - failed
        seconds = time.monotonic() - self.began
        return Standing(self.total, done, failed, self.crew.busy, len(self.others), self.produced, seconds)

    def final(self) -> Standing:
        """Count again at the end: other coordinators may have seen runs fail."""
        ledger = self.writer.ledger
        ledger.refresh()
        done = [ledger.has(key, self.keep) for key in self.keys]
        failures = ledger.failures()
        failed = sum(key in failures and not there for key, there in zip(self.keys, done))
        return self.standing()._replace(done=sum(done), failed=failed)

    def step(self) -> None:
        now = time.monotonic()
        if self.others and not self.waiting and now - self.looked >= LOOK:
            self.waiting.extend(self.others)
            self.others, self.looked = [], now
        hungry = self.waiting and len(self.taken) < self.crew.capacity - self.crew.busy
        last = self.ended and not (self.taken or self.crew.busy)
        if hungry or last or (self.ended and now - self.exchanged >= PERIOD):
            with held_back():
                self._exchange(self._room())
        while self.taken and self.crew.busy < self.crew.capacity:
            identity, seed = self.taken.popleft()
            with held_back():
                self.crew.start(Task(self.functions[identity], seed, identity))
        if self.goes_on():
            for run in self.crew.finished(PERIOD):
                self._note(run)

    def stop(self) -> None:
        with contextlib.suppress(CrewError, Futile):  # one of them may be why it stops
            self.ended += self.crew.finished(0.0)
        self._exchange(0)

    def _note(self, run: Finished) -> None:
        key = (run.identity, run.seed)
        if run.ending == Ending.DIED:
            self.deaths[key] += 1
            if self.deaths[key] < ATTEMPTS:
                self.taken.appendleft(key)
                return
        self.pace = run.seconds if math.isinf(self.pace) else 0.8 * self.pace + 0.2 * run.seconds
        self.ended.append(run)

    def _room(self) -> int:
        ahead = min(max(math.ceil(PERIOD / max(self.pace, 1e-6)), 1), MOST_AHEAD)
        return max(self.crew.capacity * (1 + ahead) - self.crew.busy - len(self.taken), 0)

    def _exchange(self, room: int) -> None:
        kept, taken, passed = self.writer.exchange(self.ended, self._drained(), room, self.keep)
        self.ended, self.exchanged = [], time.monotonic()
        self.taken.extend(taken)
        self.others.extend(passed)
        for run in kept:
            if run.result is None:
                self.failures.append(run)
            else:
                self.produced += 1

    def _drained(self) -> Iterator[Key]:
        while self.waiting:
            yield self.waiting.popleft()

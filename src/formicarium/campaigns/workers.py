"""Worker processes: each takes runs one after the other, and whatever becomes of it is reported."""

import math
import pickle
import signal
import time
from collections.abc import Iterator, Sequence
from multiprocessing import connection, get_context
from typing import Any, NamedTuple

from formicarium.campaigns.crew import Task, attempt
from formicarium.campaigns.errors import Futile
from formicarium.campaigns.interruption import held_back, hidden_from_children
from formicarium.campaigns.result import Ending, Finished, Function, Watch

BEGUN = "begun"  # what a worker says between a task and its answer, if runs have a time limit


def serve(pipe: Any, number: int, timed: bool) -> None:
    """Be a worker: take tasks from the pipe and answer each with a Finished, until the pipe closes.

    A parent that dies closes the pipe, so no worker outlives its parent by more than the run at hand.
    """
    signal.signal(signal.SIGINT, signal.SIG_IGN)

    def begun() -> None:
        if timed:
            pipe.send(BEGUN)

    try:
        while (task := pipe.recv()) is not None:
            try:
                pipe.send(attempt(task, number, begun=begun))
            except Futile as reason:
                pipe.send(reason)
    except (EOFError, OSError):
        return


class _Worker(NamedTuple):
    process: Any
    number: int
    task: Task  # the run it is busy with, or was
    sent: float  # time.monotonic() when it was given the run
    began: float  # time.monotonic() when it began, infinite before; imports do not count against the time limit


class Processes:
    """A crew of processes on this machine. A worker lives for many runs; a new one takes the place of a dead one."""

    def __init__(self, capacity: int, time_limit: float | None = None):
        """Prepare; processes start with the first runs.

        Args:
            capacity: number of processes.
            time_limit: wall-clock seconds after which a run is ended, with its process.
        """
        self.capacity = capacity
        self.time_limit = time_limit
        self._working: dict[Any, _Worker] = {}
        self._idle: dict[Any, _Worker] = {}
        self._ended: list[Finished] = []
        self._futile: Futile | None = None

    @property
    def busy(self) -> int:
        """How many runs are under way; a reason to stop that was not told yet counts as one."""
        return len(self._working) + (self._futile is not None)

    def start(self, task: Task) -> None:
        """Begin a run on a worker that is idle, or on a new one."""
        while self._idle:
            pipe, worker = self._idle.popitem()
            try:
                pipe.send(task)
            except OSError:  # it died, perhaps after its last answer: another takes its place
                pipe.close()
                continue
            self._working[pipe] = _Worker(worker.process, worker.number, task, time.monotonic(), math.inf)
            return
        taken = {worker.number for worker in self._working.values()}
        number = next(k for k in range(self.capacity + 1) if k not in taken)
        # "spawn": compiled code and its threads do not survive a fork.
        context = get_context("spawn")
        ours, theirs = context.Pipe()
        process = context.Process(target=serve, args=(theirs, number, self.time_limit is not None), daemon=True)
        with hidden_from_children():
            process.start()
        theirs.close()  # so that the end of the worker is the end of the pipe
        self._working[ours] = _Worker(process, number, task, time.monotonic(), math.inf)
        ours.send(task)

    def finished(self, seconds: float | None) -> list[Finished]:
        """Wait until a run has ended, or for so many seconds, and return what has ended.

        Raises:
            Futile: if a function said that no run can succeed.
        """
        if self.time_limit is not None and self._working:
            first = min(worker.began for worker in self._working.values()) + self.time_limit
            if math.isfinite(first):
                left = max(first - time.monotonic(), 0.0)
                seconds = left if seconds is None else min(seconds, left)
        ready = connection.wait(list(self._working), seconds)
        with held_back():  # half an answer would be none; a Ctrl-C leaves what has arrived for the next call
            for pipe in ready:
                self._ended += self._receive(pipe)
            self._ended += self._late()
        ended, self._ended = self._ended, []
        if self._futile is not None and not ended:  # what has ended well comes first
            reason, self._futile = self._futile, None
            raise reason
        return ended

    def close(self) -> None:
        """End all workers, whatever they are doing."""
        for worker in [*self._working.values(), *self._idle.values()]:
            worker.process.kill()
        for pipe, worker in [*self._working.items(), *self._idle.items()]:
            worker.process.join()
            pipe.close()
        self._working, self._idle = {}, {}

    def _receive(self, pipe: Any) -> list[Finished]:
        worker = self._working.pop(pipe)
        try:
            answer = pipe.recv()
        except (EOFError, OSError):
            worker.process.join()
            pipe.close()
            reason = f"the process of this run ended with exit code {worker.process.exitcode} before it was done"
            return [_unfinished(worker, reason, Ending.DIED)]
        if answer == BEGUN:
            self._working[pipe] = worker._replace(began=time.monotonic())
            return []
        self._idle[pipe] = worker
        if isinstance(answer, Futile):
            self._futile = answer
            return []
        return [answer]

    def _late(self) -> list[Finished]:
        now, late = time.monotonic(), []
        for pipe, worker in list(self._working.items()):
            if self.time_limit is not None and now - worker.began >= self.time_limit:
                del self._working[pipe]
                worker.process.kill()
                worker.process.join()
                pipe.close()
                late.append(_unfinished(worker, f"took longer than {self.time_limit:g} s: ended", Ending.LATE))
        return late


def _unfinished(worker: _Worker, reason: str, ending: Ending) -> Finished:
    seconds = time.monotonic() - worker.sent
    return Finished(worker.task.seed, None, reason, seconds, worker.number, ending, worker.task.identity)


def finished_runs(
    function: Function, seeds: Sequence[int], workers: int, watch: Watch | None = None
) -> Iterator[Finished]:
    """Yield every run as it ends, in any order. Several workers are processes; one is this process.

    A run that raises, or whose process dies, is yielded as a failure and the others go on. On Ctrl-C what has
    already arrived is yielded, the workers are ended and KeyboardInterrupt goes on to the caller.
    """
    packed = pickle.dumps(function)
    tasks = [Task(packed, seed) for seed in seeds]
    workers = min(workers, len(tasks))
    if workers <= 1:
        for task in tasks:
            yield attempt(task, 0, watch)
        return
    crew = Processes(workers)
    waiting = tasks[::-1]
    try:
        while waiting or crew.busy:
            while waiting and crew.busy < workers:
                crew.start(waiting.pop())
            yield from crew.finished(None)
    except KeyboardInterrupt:
        yield from crew.finished(0.0)
        raise
    finally:
        crew.close()

"""Run a function for many seeds, in this process or in several others, and hand back what each gave."""

import pickle
import signal
import time
import traceback
from collections.abc import Iterator, Sequence
from multiprocessing import connection, get_context
from typing import Any, NamedTuple

from formicarium.campaigns.interruption import hidden_from_children
from formicarium.campaigns.result import Finished, Function, Watch


def finished_runs(
    function: Function, seeds: Sequence[int], workers: int, watch: Watch | None = None
) -> Iterator[Finished]:
    """Yield every run as it ends, in any order. Several workers are processes; one is this process.

    A run that raises, or whose process dies, is yielded as a failure and the others go on. On Ctrl-C what has
    already arrived is yielded, the workers are ended and KeyboardInterrupt goes on to the caller.
    """
    workers = min(workers, len(seeds))
    if workers <= 1:
        for seed in seeds:
            yield _attempt(function, seed, 0, watch)
    else:
        yield from _in_processes(pickle.dumps(function), list(seeds), workers)


def _attempt(function: Function, seed: int, number: int, watch: Watch | None) -> Finished:
    started = time.perf_counter()
    try:
        result, failure = function(seed, watch), ""
    except Exception:
        result, failure = None, traceback.format_exc()
    return Finished(seed, result, failure, time.perf_counter() - started, number)


def serve(pipe: Any, function: bytes, number: int) -> None:
    """Be a worker: take seeds from the pipe and answer each with a Finished, until the pipe closes.

    A parent that dies closes the pipe, so no worker outlives its parent by more than the run at hand.
    """
    signal.signal(signal.SIGINT, signal.SIG_IGN)

    def unpacked(seed: int, watch: Watch | None) -> Any:
        return pickle.loads(function)(seed, watch)

    try:
        while (seed := pipe.recv()) is not None:
            pipe.send(_attempt(unpacked, seed, number, None))
    except (EOFError, OSError):
        return


class _Worker(NamedTuple):
    process: Any
    seed: int  # the run it is busy with
    number: int


def _start(function: bytes, number: int, seed: int) -> tuple[Any, _Worker]:
    # "spawn": compiled code and its threads do not survive a fork.
    context = get_context("spawn")
    ours, theirs = context.Pipe()
    process = context.Process(target=serve, args=(theirs, function, number), daemon=True)
    with hidden_from_children():
        process.start()
    theirs.close()  # so that the end of the worker is the end of the pipe
    ours.send(seed)
    return ours, _Worker(process, seed, number)


def _next(function: bytes, pipe: Any, worker: _Worker, seed: int) -> tuple[Any, _Worker]:
    try:
        pipe.send(seed)
    except OSError:  # it died, perhaps after its last answer: another takes its place
        pipe.close()
        return _start(function, worker.number, seed)
    return pipe, worker._replace(seed=seed)


def _in_processes(function: bytes, seeds: list[int], workers: int) -> Iterator[Finished]:
    waiting = seeds[::-1]
    crew: dict[Any, _Worker] = {}
    pipe: Any
    try:
        for number in range(workers):
            pipe, worker = _start(function, number, waiting.pop())
            crew[pipe] = worker
        while crew:
            for pipe in list(connection.wait(list(crew))):
                worker = crew.pop(pipe)
                finished = _receive(pipe, worker)
                if waiting:
                    pipe, worker = _next(function, pipe, worker, waiting.pop())
                    crew[pipe] = worker
                else:
                    pipe.close()
                yield finished
    except KeyboardInterrupt:
        yield from [_receive(pipe, worker) for pipe, worker in crew.items() if pipe.poll()]
        raise
    finally:
        for worker in crew.values():
            worker.process.kill()


def _receive(pipe: Any, worker: _Worker) -> Finished:
    try:
        return pipe.recv()
    except (EOFError, OSError):
        worker.process.join()
        reason = f"the process of this run ended with exit code {worker.process.exitcode} before it was done"
        return Finished(worker.seed, None, reason, 0.0, worker.number)

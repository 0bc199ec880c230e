"""A crew on Dask: processes here, machines of a cluster, or jobs of a batch system. Needs the extra "cluster"."""

import contextlib
import logging
import queue
import threading
import time
from collections.abc import Iterator, Mapping
from multiprocessing import process as this_process
from typing import Any

import distributed
from distributed.client import Client, Future
from distributed.scheduler import KilledWorker

from formicarium.campaigns.crew import Task, attempt
from formicarium.campaigns.errors import CrewError, Futile
from formicarium.campaigns.interruption import hidden_from_children
from formicarium.campaigns.result import Ending, Finished
from formicarium.campaigns.workers import Processes

BATCH_SYSTEMS = {"slurm": "SLURMCluster", "pbs": "PBSCluster", "sge": "SGECluster"}
AHEAD = 2  # runs under way for each thread of the cluster, so that none waits for its next
LOOK = 5.0  # seconds between two counts of the workers
PATIENCE = 60.0  # seconds to wait for a result that a worker has announced
CONNECT = 10.0  # seconds to wait for the scheduler
_own = threading.local()  # of a thread of a Dask worker: the process that runs with a time limit live in


def on_worker(task: Task, time_limit: float | None) -> Finished:
    """Do a run on a Dask worker; with a time limit in a process of its own, which can be ended."""
    name = str(distributed.get_worker().name)
    if time_limit is None:
        return attempt(task, name)
    if getattr(_own, "crew", None) is None or _own.crew.time_limit != time_limit:
        _own.crew = Processes(1, time_limit)
    with _may_have_children():
        _own.crew.start(task)
    while not (ended := _own.crew.finished(None)):
        pass
    return ended[0]._replace(worker=name)


@contextlib.contextmanager
def _may_have_children() -> Iterator[None]:
    # Dask starts its workers as daemons, which may not start processes. Ours end with them: their pipe closes.
    config: dict[str, Any] = this_process.current_process()._config  # type: ignore[attr-defined]
    before = config.pop("daemon", None)
    try:
        yield
    finally:
        if before is not None:
            config["daemon"] = before


def open_cluster(where: str, workers: int | None, options: Mapping[str, Any]) -> tuple[Client, Any]:
    """Connect to a scheduler, or start one with its workers; return the client and what was started, if anything.

    Args:
        where: address of a scheduler (``tcp://host:8786``), ``local``, or a batch system: ``slurm``, ``pbs``, ``sge``.
        workers: how many to start; not for a scheduler that is there already.
        options: of the cluster that is started (queue, walltime, ...), besides those of Dask's own configuration.

    Raises:
        CrewError: if there is no such place, or nobody answers.
    """
    logging.getLogger("distributed").setLevel(logging.CRITICAL)  # it has told whom it may concern: us
    cluster = None
    try:
        with hidden_from_children():
            if where == "local":
                quiet = {"dashboard_address": None, "silence_logs": logging.CRITICAL}
                cluster = distributed.LocalCluster(n_workers=workers, threads_per_worker=1, **{**quiet, **options})
            elif where in BATCH_SYSTEMS:
                cluster = batch_cluster(where, options)
                cluster.scale(jobs=workers or 1)
            elif "://" not in where:
                places = f"local, {', '.join(BATCH_SYSTEMS)} or the address of a scheduler (tcp://host:8786)"
                raise CrewError(f"--dask {where}: must be {places}")
            client = Client(cluster or where, timeout=CONNECT, set_as_default=False)
    except (OSError, RuntimeError, TypeError, ValueError) as error:
        cause = error.__cause__ or error
        reason = " ".join(f"{type(cause).__name__}: {cause}".split())
        raise CrewError(f"--dask {where}: {reason}") from error
    return client, cluster


def batch_cluster(system: str, options: Mapping[str, Any]) -> Any:
    """Return the cluster object of a batch system; no job is submitted before it is scaled.

    Raises:
        CrewError: if dask-jobqueue is not installed.
    """
    try:
        import dask_jobqueue  # noqa: PLC0415  (an extra that may not be there)
    except ImportError as error:
        raise CrewError('dask-jobqueue is not installed: pip install "formicarium[cluster]"') from error
    return getattr(dask_jobqueue, BATCH_SYSTEMS[system])(**{"cores": 1, "memory": "2GB", **options})


class DaskCrew:
    """Workers of a Dask cluster. A run whose worker dies has died; the scheduler must live."""

    def __init__(self, client: Client, cluster: Any = None, time_limit: float | None = None):
        """Take over a client, and the cluster that was started for it, if any; both are closed at the end."""
        self.time_limit = time_limit
        self._client, self._cluster = client, cluster
        self._under_way: dict[str, tuple[Task, Future]] = {}
        self._ended: queue.SimpleQueue[str] = queue.SimpleQueue()
        self._capacity, self._looked = 1, 0.0
        self._number = 0
        self._futile: Futile | None = None

    @property
    def capacity(self) -> int:
        """How many runs can be under way at once: grows and shrinks with the cluster."""
        if time.monotonic() - self._looked > LOOK and self._client.status == "running":
            with contextlib.suppress(OSError, TimeoutError):
                self._capacity = max(AHEAD * sum(self._client.nthreads().values()), 1)
            self._looked = time.monotonic()
        return self._capacity

    @property
    def busy(self) -> int:
        """How many runs the scheduler has; a reason to stop that was not told yet counts as one."""
        return len(self._under_way) + (self._futile is not None)

    def start(self, task: Task) -> None:
        """Hand a run to the scheduler.

        Raises:
            CrewError: if the scheduler is gone.
        """
        self._check()
        self._number += 1
        key = f"run-{id(self)}-{self._number}"
        future = self._client.submit(on_worker, task, self.time_limit, key=key, pure=False)
        self._under_way[key] = (task, future)
        future.add_done_callback(lambda future: self._ended.put(future.key))

    def finished(self, seconds: float | None) -> list[Finished]:
        """Wait until a run has ended, or for so many seconds, and return what has ended.

        Raises:
            CrewError: if the scheduler is gone.
            Futile: if a function said that no run can succeed.
        """
        keys = []
        with contextlib.suppress(queue.Empty):
            keys.append(self._ended.get(timeout=seconds) if seconds != 0 else self._ended.get_nowait())
            while True:
                keys.append(self._ended.get_nowait())
        self._check()
        ended = [run for key in keys if (run := self._result(key)) is not None]
        if self._futile is not None and not ended:  # what has ended well comes first
            reason, self._futile = self._futile, None
            raise reason
        return ended

    def close(self) -> None:
        """Take back what has not ended, and leave or end the cluster."""
        with contextlib.suppress(Exception):
            if self._client.status == "running":
                self._client.cancel([future for _, future in self._under_way.values()], force=True)
        self._under_way = {}
        for part in (self._client, self._cluster):
            with contextlib.suppress(Exception):
                if part is not None:
                    part.close(timeout=CONNECT)

    def _check(self) -> None:
        if self._client.status != "running":
            raise CrewError("the Dask scheduler is gone; what had arrived from it is kept. Start it anew and go on.")

    def _result(self, key: str) -> Finished | None:
        task, future = self._under_way.pop(key)
        try:
            return future.result(timeout=PATIENCE)
        except Futile as error:
            self._futile = error
            return None
        except (KilledWorker, TimeoutError, distributed.CancelledError) as error:
            reason, ending = f"the Dask worker of this run was lost ({type(error).__name__})", Ending.DIED
        except Exception as error:  # it could not even be begun there: a module is missing, a version differs
            reason, ending = f"on the Dask worker: {type(error).__name__}: {error}", Ending.FAILED
        return Finished(task.seed, None, reason, 0.0, "", ending, task.identity)

"""Dask: the same table as anywhere else; workers and the scheduler may be killed."""

import os
import random
import signal
import socket
import subprocess
import sys
import threading
import time
from pathlib import Path

import pytest

from counted_campaign import campaign, jobs, keys_in_parts, table
from formicarium.campaigns.errors import CrewError
from formicarium.campaigns.here import Here
from formicarium.campaigns.ledger import Ledger

pytest.importorskip("distributed")
from formicarium.campaigns.cluster import DaskCrew, batch_cluster, open_cluster

TESTS = Path(__file__).parents[1]


def test_two_dask_workers_give_the_same_table(tmp_path):
    _, undisturbed = campaign(tmp_path / "here", Here(), jobs(40))
    report, found = campaign(tmp_path / "dask", DaskCrew(*open_cluster("local", 2, {})), jobs(40))
    assert report.standing.produced == 40
    assert found.equals(undisturbed)
    assert keys_in_parts(tmp_path / "dask") == (40, 40)


@pytest.mark.parametrize(
    ("trouble", "words"),
    [
        ("raise", "ArithmeticError: 3 cannot be raised"),
        pytest.param("die", "the Dask worker of this run was lost", marks=pytest.mark.long),
    ],
)
def test_a_run_that_fails_or_kills_its_dask_worker_is_a_failure_of_its_own(tmp_path, trouble, words):
    report, _ = campaign(tmp_path, DaskCrew(*open_cluster("local", 2, {})), jobs(10, trouble=trouble))
    assert (report.standing.done, report.standing.failed) == (8, 2)
    assert all(words in run.failure for run in report.failures)


def test_a_time_limit_holds_on_dask_too(tmp_path):
    crew = DaskCrew(*open_cluster("local", 2, {}), time_limit=4.0)
    report, _ = campaign(tmp_path, crew, jobs(10, trouble="hang"))
    assert (report.standing.done, report.standing.failed) == (8, 2)
    assert {str(run.ending) for run in report.failures} == {"late"}


def test_a_scheduler_that_does_not_answer_is_named(monkeypatch):
    monkeypatch.setattr("formicarium.campaigns.cluster.CONNECT", 0.5)
    with socket.socket() as nobody:
        nobody.bind(("127.0.0.1", 0))
        address = f"tcp://127.0.0.1:{nobody.getsockname()[1]}"
        with pytest.raises(CrewError, match=f"--dask {address}"):
            open_cluster(address, None, {})
    with pytest.raises(CrewError, match="must be local, slurm, pbs, sge or the address"):
        open_cluster("sulrm", None, {})
    with pytest.raises(CrewError, match=r"--dask local: .*no_such_option"):
        open_cluster("local", 1, {"no_such_option": 1})


@pytest.mark.parametrize(
    ("system", "word"), [("slurm", "#SBATCH -p short"), ("pbs", "#PBS -q short"), ("sge", "#$ -q short")]
)
def test_batch_systems_are_asked_as_told(system, word):
    """Up to the cluster's door: the job that would be submitted."""
    with batch_cluster(system, {"queue": "short", "scheduler_options": {"dashboard_address": None}}) as cluster:
        assert word in cluster.job_script()


class Outside:
    """A scheduler and two workers as processes of their own."""

    def __init__(self):
        with socket.socket() as free:
            free.bind(("127.0.0.1", 0))
            self.address = f"tcp://127.0.0.1:{free.getsockname()[1]}"
        port = self.address.rpartition(":")[2]
        self.scheduler = self.start("scheduler", "--host", "127.0.0.1", "--port", port, "--no-dashboard")
        self.workers = [self.start_worker() for _ in range(2)]

    def start(self, *words):
        path = os.pathsep.join([str(TESTS), os.environ.get("PYTHONPATH", "")])
        return subprocess.Popen(
            [sys.executable, "-m", "dask", *words], env={**os.environ, "PYTHONPATH": path},
            stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, start_new_session=True,
        )  # fmt: skip

    def start_worker(self):
        return self.start("worker", self.address, "--nthreads", "1", "--no-dashboard")

    def kill(self, process):
        os.killpg(process.pid, signal.SIGKILL)
        process.wait()

    def close(self):
        for process in [*self.workers, self.scheduler]:
            if process.poll() is None:
                self.kill(process)


@pytest.fixture
def outside():
    cluster = Outside()
    yield cluster
    cluster.close()


def open_outside(address):
    until = time.monotonic() + 30
    while True:
        try:
            return open_cluster(address, None, {})
        except CrewError:
            assert time.monotonic() < until
            time.sleep(0.2)


@pytest.mark.long
@pytest.mark.skipif(os.name != "posix", reason="signals of POSIX systems")
def test_dask_workers_killed_at_random_cost_nothing(tmp_path, outside):
    _, undisturbed = campaign(tmp_path / "here", Here(), jobs(300))
    chance, ended = random.Random(1), threading.Event()

    def kill_and_start():
        while not ended.wait(chance.uniform(1.0, 3.0)):
            index = chance.randrange(2)
            outside.kill(outside.workers[index])
            outside.workers[index] = outside.start_worker()

    trouble = threading.Thread(target=kill_and_start)
    trouble.start()
    crew = DaskCrew(*open_outside(outside.address))
    report, found = campaign(tmp_path / "dask", crew, jobs(300, pause=0.1))
    ended.set()
    trouble.join()
    assert report.standing.failed == 0
    assert found.equals(undisturbed)
    assert keys_in_parts(tmp_path / "dask") == (300, 300)


@pytest.mark.long
@pytest.mark.skipif(os.name != "posix", reason="signals of POSIX systems")
def test_a_scheduler_that_is_killed_ends_the_sitting_and_the_next_goes_on(tmp_path, outside):
    _, undisturbed = campaign(tmp_path / "here", Here(), jobs(100))

    def killer():
        while len(list((tmp_path / "dask" / "parts").glob("*.parquet"))) < 3:
            time.sleep(0.05)
        outside.kill(outside.scheduler)

    trouble = threading.Thread(target=killer)
    trouble.start()
    with pytest.raises(CrewError, match="scheduler is gone"):
        campaign(tmp_path / "dask", DaskCrew(*open_outside(outside.address)), jobs(100, pause=0.1))
    trouble.join()
    ledger = Ledger(tmp_path / "dask")
    ledger.refresh()
    assert 0 < len(ledger.done) < 100
    report, found = campaign(tmp_path / "dask", Here(), jobs(100))
    assert report.loaded == len(ledger.done)
    assert found.equals(undisturbed)
    assert table(tmp_path / "dask", jobs(100)).equals(undisturbed)

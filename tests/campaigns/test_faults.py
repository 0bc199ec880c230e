"""Workers and coordinators killed with -9 at random moments: every run is there exactly once, as if undisturbed."""

import os
import random
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path

import pytest

from counted_campaign import campaign, jobs, keys_in_parts, table
from formicarium.campaigns.here import Here
from formicarium.campaigns.ledger import Ledger
from formicarium.campaigns.workers import Processes

TESTS = Path(__file__).parents[1]
posix = pytest.mark.skipif(os.name != "posix", reason="signals and process lists of POSIX systems")


def start(folder, runs, pause):
    path = os.pathsep.join([str(TESTS), os.environ.get("PYTHONPATH", "")])
    return subprocess.Popen(
        [sys.executable, "-m", "counted_campaign", str(folder), str(runs), str(pause)],
        env={**os.environ, "PYTHONPATH": path},
        text=True,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        start_new_session=True,
    )


def workers_of(process):
    listed = subprocess.run(["ps", "-A", "-o", "pid=,ppid=,command="], capture_output=True, text=True, check=True)
    lines = [line.split(None, 2) for line in listed.stdout.splitlines()]
    return [int(pid) for pid, parent, what in lines if int(parent) == process.pid and "spawn_main" in what]


def done_in(folder):
    ledger = Ledger(folder)
    ledger.refresh()
    return len(ledger.done)


def kill_at_random(folder, runs, pause, kills, seed, deadline=600):
    """Run the campaign, killing coordinators and workers in turn; return how many kills hit a living process."""
    chance, until = random.Random(seed), time.monotonic() + deadline
    process, killed = start(folder, runs, pause), 0
    for number in range(kills):
        before = done_in(folder)
        wait = chance.uniform(0.0, (runs - before) * pause / 2 / (kills - number + 1))
        while done_in(folder) == before and process.poll() is None and time.monotonic() < until:
            time.sleep(0.01)
        time.sleep(wait)
        if process.poll() is not None:
            break
        workers = workers_of(process)
        if number % 2 and workers:
            os.kill(chance.choice(workers), signal.SIGKILL)
        else:
            process.kill()
            process.wait()
            process = start(folder, runs, pause)
        killed += 1
    _, said = process.communicate(timeout=max(until - time.monotonic(), 1))
    assert process.returncode == 0, said
    return killed


def check_whole(folder, runs, pause=0.0):
    found = jobs(runs, pause)
    assert Ledger(folder).failures() == set()
    assert keys_in_parts(folder) == (runs, runs)
    _, undisturbed = campaign(folder / "undisturbed", Here(), jobs(runs))
    assert table(folder, found).equals(undisturbed)


@posix
def test_a_campaign_survives_kills(tmp_path):
    assert kill_at_random(tmp_path, runs=80, pause=0.05, kills=2, seed=1) >= 1
    check_whole(tmp_path, 80)


@posix
@pytest.mark.long
@pytest.mark.parametrize("seed", [1, 2, 3])
def test_a_campaign_of_500_trials_survives_20_kills(tmp_path, seed):
    assert kill_at_random(tmp_path, runs=500, pause=0.1, kills=20, seed=seed) == 20
    check_whole(tmp_path, 500)


@posix
@pytest.mark.long
@pytest.mark.parametrize("seed", [1, 2, 3])
def test_two_coordinators_killed_in_turn_lose_and_repeat_nothing(tmp_path, seed):
    chance = random.Random(seed)
    both = [start(tmp_path, 400, 0.1) for _ in range(2)]
    for _ in range(15):
        time.sleep(chance.uniform(0.3, 2.0))
        index = chance.randrange(2)
        workers = workers_of(both[index])
        if workers and chance.random() < 0.4:
            os.kill(chance.choice(workers), signal.SIGKILL)
        else:
            both[index].kill()
            both[index].communicate()
            both[index] = start(tmp_path, 400, 0.1)
    answers = [process.communicate(timeout=120) for process in both]
    assert [process.returncode for process in both] == [0, 0], answers
    check_whole(tmp_path, 400)


@posix
@pytest.mark.long
def test_two_coordinators_share_the_runs(tmp_path):
    both = [start(tmp_path, 60, 0.05) for _ in range(2)]
    answers = [process.communicate(timeout=60) for process in both]
    produced = [int(out) for out, _ in answers]
    assert sum(produced) == 60, answers
    assert min(produced) >= 10
    check_whole(tmp_path, 60)


@posix
def test_the_runs_of_a_coordinator_that_is_killed_are_taken_over(tmp_path):
    first, second = [start(tmp_path, 40, 0.08) for _ in range(2)]
    while done_in(tmp_path) < 10:
        time.sleep(0.02)
    first.kill()
    _, said = second.communicate(timeout=60)
    first.communicate()
    assert second.returncode == 0, said
    check_whole(tmp_path, 40)


def test_two_coordinators_in_one_process_commit_no_row_twice(tmp_path):
    threads = [threading.Thread(target=campaign, args=(tmp_path, Here(), jobs(30, 0.005))) for _ in range(2)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    check_whole(tmp_path, 30)


@posix
def test_a_worker_that_dies_once_costs_nothing(tmp_path, monkeypatch):
    monkeypatch.setenv("COUNTED_MARK", str(tmp_path / "mark"))
    report, _ = campaign(tmp_path / "set", Processes(2), jobs(20, trouble="die once"))
    assert (tmp_path / "mark").exists()
    assert report.standing.done == 20


@posix
def test_a_run_whose_worker_always_dies_is_a_failure(tmp_path):
    report, _ = campaign(tmp_path, Processes(2), jobs(10, trouble="die"))
    assert (report.standing.done, report.standing.failed) == (8, 2)
    assert {str(run.ending) for run in report.failures} == {"died"}
    assert "exit code -9" in report.failures[0].failure


def test_a_run_that_never_ends_is_ended_and_the_others_go_on(tmp_path):
    report, _ = campaign(tmp_path, Processes(2, time_limit=3.0), jobs(10, trouble="hang"))
    assert (report.standing.done, report.standing.failed) == (8, 2)
    assert {str(run.ending) for run in report.failures} == {"late"}
    assert "took longer than 3 s" in report.failures[0].failure


@pytest.mark.parametrize("workers", [1, 2])
def test_the_table_does_not_depend_on_the_crew(tmp_path, workers):
    _, undisturbed = campaign(tmp_path / "here", Here(), jobs(20))
    assert campaign(tmp_path / "set", Processes(workers), jobs(20))[1].equals(undisturbed)

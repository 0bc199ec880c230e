"""``formicarium schedule`` interrupted, and on other numbers of threads."""

import json
import os
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path

import pytest

pytest.importorskip("highspy", reason="needs the extra 'scheduling'")

from formicarium.campaigns.files import StoreError
from formicarium.commands import planning
from formicarium.commands.folders import named_folder
from formicarium.commands.planning import Wish, plan
from formicarium.scheduling.generator import draw_instance
from formicarium.scheduling.reading import as_content
from formicarium.scheduling.schedule import Answer


def written(instance, folder):
    path = folder / "tasks.json"
    path.write_text(json.dumps(as_content(instance)))
    return path


@pytest.fixture
def heard():
    """Let Ctrl-C be heard: Python leaves it ignored where a shell has put it into the background."""
    previous = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, previous)


@pytest.mark.usefixtures("heard")
@pytest.mark.skipif(os.name != "posix", reason="signals of POSIX systems")
@pytest.mark.parametrize("part", ["first fit", "covering", "annealing"])
def test_ctrl_c_ends_with_the_best_schedule_so_far(part, tmp_path, monkeypatch):
    """The real signal, in the middle of each part of the search."""
    file = written(draw_instance(2, 0.05, 900), tmp_path)
    solve = planning.solve

    def solve_and_interrupt(*arguments, told, **more):
        def heard(news):
            told(news)
            if news.part == part:
                os.kill(os.getpid(), signal.SIGINT)

        return solve(*arguments, told=heard, **more)

    monkeypatch.setattr(planning, "solve", solve_and_interrupt)
    assert plan(Wish(str(file), "travel", "printed", 60.0, None, False, str(tmp_path / "plan"))) == 130
    content = json.loads((tmp_path / "plan" / "schedule.json").read_text())
    assert content["ended"] == "interrupted" and not content["proven"]
    done = [arm["task"] for slot in content["slots"] for arm in slot["arms"]]
    assert sorted(done) == sorted(f"t{k}" for k in range(1, 21))
    assert {path.name for path in (tmp_path / "plan").iterdir()} == {"schedule.json", "map.png", "gantt.png"}


@pytest.mark.usefixtures("heard")
@pytest.mark.skipif(os.name != "posix", reason="signals of POSIX systems")
def test_ctrl_c_is_heard_while_a_long_tour_is_measured(tmp_path):
    instance = draw_instance(6, 0.05, 900, 99)  # takes more than twenty seconds to its end
    instance = instance._replace(priorities=tuple((f"t{k}", f"t{k + 1}") for k in range(1, 99)))
    timer = threading.Timer(3.0, os.kill, (os.getpid(), signal.SIGINT))
    began = time.monotonic()
    timer.start()
    wish = Wish(str(written(instance, tmp_path)), "travel", "printed", 60.0, None, True, str(tmp_path / "p"))
    try:
        code = plan(wish)
    finally:
        timer.cancel()  # a signal after the end would end the tests
    assert code == 130 and time.monotonic() - began < 20.0
    assert json.loads((tmp_path / "p" / "schedule.json").read_text())["ended"] == "interrupted"


def test_where_nothing_can_be_written_nothing_is_searched(tmp_path, monkeypatch):
    monkeypatch.setattr(planning, "solve", None)
    (tmp_path / "file").write_text("")
    with pytest.raises(StoreError, match="Choose another folder"):
        plan(Wish(str(written(draw_instance(2, 0.05, 900), tmp_path)), "time", "printed", 1.0, None, True,
                  str(tmp_path / "file" / "x")))  # fmt: skip


def test_a_name_never_leads_out_of_the_folder_of_results():
    assert named_folder("schedule", "../../a b/[red]", "time") == Path("formicarium-results/schedule-a-b-red-time")
    assert named_folder("schedule", "..") == Path("formicarium-results/schedule-own")
    assert named_folder("schedule", 40 * "蟻" + "-x").name == "schedule-" + 26 * "蟻"  # 80 bytes


def test_what_is_not_proven_is_told_as_a_share_of_the_best():
    answer = Answer("time", None, 3.0, 2.0, 1.0, "none", "time limit")
    assert answer.excess == 0.5 and answer.excess_in_words == "at most 50.00% above the best"
    assert answer._replace(bound=0.0).excess_in_words == "no bound is known yet"


@pytest.mark.parametrize("objective", ["time", pytest.param("travel", marks=pytest.mark.long)])
def test_the_number_of_threads_does_not_matter(objective, tmp_path):
    file = written(draw_instance(5, 0.05, 900), tmp_path)
    found = []
    for threads in ("1", "4"):
        counts = dict.fromkeys(("OMP_NUM_THREADS", "NUMBA_NUM_THREADS", "OPENBLAS_NUM_THREADS"), threads)
        command = ["-m", "formicarium.commands.main", "schedule", file, "--objective", objective, "--reach", "printed"]
        out = tmp_path / f"plan-{threads}"
        subprocess.run([sys.executable, *command, "--out", out], env=os.environ | counts, check=True, timeout=300)
        content = json.loads((out / "schedule.json").read_text())
        assert content["proven"]
        found.append({name: value for name, value in content.items() if name != "seconds"})
    assert found[0] == found[1]

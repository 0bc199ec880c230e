"""``formicarium schedule`` interrupted, and on other numbers of threads."""

import json
import os
import signal
import subprocess
import sys

import pytest

pytest.importorskip("highspy", reason="needs the extra 'scheduling'")

from formicarium.commands import planning
from formicarium.commands.planning import Wish, plan
from formicarium.scheduling.generator import draw_instance
from formicarium.scheduling.reading import as_content


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


@pytest.mark.parametrize("objective", ["time", "travel"])
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

"""Errors of a behaviour name file, line, robot and cycle: the laid-out system with one line made wrong."""

import os
import re
import subprocess
import sys
from functools import partial

import pytest

from formicarium.commands.laying_out import lay_out
from formicarium.systems.diagnosis import changed, lines_of, way_out

PROGRAM = """
import sys
sys.path.insert(0, ".")
from formicarium.systems import stepping
from wrong.study import SYSTEM
stepping.CYCLE_LIMIT = 2.0
stepping.mind_divisions(False)
print(stepping.first_failure(SYSTEM.advance, SYSTEM.begin(SYSTEM.configure(robots=3), 1), 6))
"""
long = partial(pytest.param, marks=pytest.mark.long)
LINE = "    be_quiet(command)\n"
DRIVE = "        drive(command, table.speed, 0.0, epuck.wheel_distance)\n"


@pytest.fixture
def told(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    folder, module = lay_out("wrong")
    file = folder / module / "behaviour.py"
    original = file.read_text()

    def run(line, function="decide", instead=None):
        written = instead.replace("table.speed", line) if instead else f"{LINE}    {line}\n"
        file.write_text(original.replace(instead or LINE, written))
        number = file.read_text().splitlines().index(written.splitlines()[-1]) + 1
        done = subprocess.run(
            [sys.executable, "-c", PROGRAM], cwd=folder, capture_output=True, text=True, check=False,
            env=os.environ | {"FORMICARIUM_INTERPRETED": "1"},
        )  # fmt: skip
        assert done.returncode == 0, done.stderr
        return done.stdout, f"behaviour.py, line {number}, in {function}"

    return run


@pytest.mark.parametrize(
    ("wrong", "said"),
    [("reading.proximty", "AttributeError"), ("raise ValueError('not today')", "ValueError: not today")],
)
def test_an_exception_is_told_with_its_line_robot_and_cycle(told, wrong, said):
    text, place = told(f"if reading.cycle == 3: {wrong}")
    assert text.startswith("cycle 3, robot ") and place in text and said in text


def test_a_speed_that_is_no_number_is_told_with_the_line_that_wrote_it(told):
    text, place = told("np.inf * 0.0 if reading.cycle == 3 else table.speed", "walk", DRIVE)
    assert text.startswith("cycle 3, robot ") and "no number" in text and place in text


def test_an_endless_loop_is_told_with_the_line_in_which_it_turns(told):
    text, place = told("while reading.cycle == 3: pass")
    assert text.startswith("cycle 3, robot ") and "never ends its decision" in text and place in text


def test_a_message_of_the_compiler_is_told_by_its_lines_in_the_readers_files(tmp_path):
    file = tmp_path / "behaviour.py"
    message = (
        "Failed in nopython mode pipeline (step: nopython frontend)\nNo implementation of function dict found\n\n"
        f'During: resolving callee type at {file} (48)\n\nFile "/usr/lib/python3/site-packages/numba/x.py", line 3:\n'
    )
    text = lines_of(message)
    assert f"{file}, line 48" in text and "No implementation of function dict" in text and "site-packages" not in text


def test_the_way_out_is_the_command_that_stops_there():
    found = "cycle 33, robot 232 never ends its decision:\n  behaviour.py, line 4"
    assert "formicarium debug my-swarm --seed 7 --cycle 33 --robot 232\n" in way_out("my-swarm", 7, found, [])
    said = way_out("my-swarm", 7, found, ["swarm.robots=5", "arena.plan=my room.toml"])
    assert " --robot 232 --set swarm.robots=5 --set 'arena.plan=my room.toml'\n" in said
    assert way_out("my-swarm", 7, "cycle 33:\n  loop.py, line 4", []) == ""


def test_what_differs_from_the_usual_is_said_as_one_would_type_it():
    usual = {"swarm": {"robots": 20, "deaths": [], "end": None}, "arena": {"plan": ""}}
    chosen = {"swarm": {"robots": 5, "deaths": [[3, 20.0]], "end": None}, "arena": {"plan": "room.toml"}}
    assert changed(usual, chosen) == ["swarm.robots=5", "swarm.deaths=[[3,20.0]]", "arena.plan=room.toml"]
    assert changed(usual, usual) == []


@pytest.mark.parametrize(
    ("wrong", "said"),
    [
        ("reading.proximity[reading.cycle - 122]", "IndexError: index 8 is out of bounds"),
        ("1.0 / float(reading.cycle - 130)", "ZeroDivisionError: "),  # Python's number; NumPy's:
        long("reading.proximity[0] / (reading.cycle - 130)", "RuntimeWarning: divide by zero"),
        long("reading.proximity[0] * 0.0 / (reading.cycle - 130)", "RuntimeWarning: invalid value encountered"),
    ],
)
def test_what_compiled_code_checks_is_told_as_plain_python_tells_it(tmp_path, monkeypatch, wrong, said):
    monkeypatch.chdir(tmp_path)
    folder, module = lay_out("wrong")
    file = folder / module / "behaviour.py"
    line = f"        command.left = {wrong}"
    file.write_text(file.read_text().replace(LINE, f"{LINE}    if reading.cycle == 130:\n{line}\n"))
    number = file.read_text().splitlines().index(line) + 1
    program = [sys.executable, "-m", "formicarium.commands.main"]
    plain = {name: value for name, value in os.environ.items() if name != "FORMICARIUM_INTERPRETED"}
    name = "wrong+kill:1@2" if "1.0" in wrong else "wrong"  # failures are injected, and errors told, all the same
    run = [*program, "run", name, "--robots", "3", "--set", "time_cap=20"]
    done = subprocess.run(run, cwd=folder, env=plain, capture_output=True, text=True, check=False)
    assert done.returncode == 1 and f"{name}, seed 1, cycle 130, robot " in done.stderr, done.stderr
    assert f"behaviour.py, line {number}, in decide" in done.stderr and said in done.stderr
    command = re.search(r"Way out: formicarium (debug .*)\n", done.stderr)[1].split()
    stopped = subprocess.run(
        [*program, *command], cwd=folder, env=plain, input="c\n", capture_output=True, text=True, check=False
    )
    if "invalid" not in said:  # nobody but the explanation stops at 0 / 0 of NumPy's numbers
        assert f"\n{said.partition(':')[0]}: " in stopped.stdout

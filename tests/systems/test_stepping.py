"""Errors of a behaviour name file, line, robot and cycle: the laid-out system with one line made wrong."""

import os
import subprocess
import sys

import pytest

from formicarium.commands.laying_out import lay_out
from formicarium.systems.diagnosis import lines_of, way_out

PROGRAM = """
import sys
sys.path.insert(0, ".")
from formicarium.systems import stepping
from wrong.study import SYSTEM
stepping.CYCLE_LIMIT = 2.0
print(stepping.first_failure(SYSTEM.advance, SYSTEM.begin(SYSTEM.configure(robots=3), 1), 6))
"""
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
    said = way_out("my-swarm", 7, "cycle 33, robot 232 never ends its decision:\n  behaviour.py, line 4")
    assert "formicarium debug my-swarm --seed 7 --cycle 33 --robot 232 " in said
    assert way_out("my-swarm", 7, "cycle 33:\n  loop.py, line 4") == ""

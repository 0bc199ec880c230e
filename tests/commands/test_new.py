"""A system of one's own is laid out whole or not at all, and found by whoever stands in its folder."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

from formicarium.commands.errors import UserError
from formicarium.commands.laying_out import LAYOUT, lay_out
from formicarium.commands.main import exit_code

ROOT = Path(__file__).parents[2]


@pytest.fixture(autouse=True)
def here(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    return tmp_path


def python(program, folder):
    return subprocess.run([sys.executable, "-c", program], cwd=folder, capture_output=True, text=True, check=False)


def test_the_name_stands_everywhere_and_every_file_is_clean(here, capsys):
    assert exit_code(["new", "my-swarm"]) == 0
    assert "cd my-swarm" in capsys.readouterr().out
    files = [file for file in (here / "my-swarm").rglob("*") if file.is_file()]
    assert len(files) == sum(file.suffix in {".py", ".toml", ".md"} for file in LAYOUT.rglob("*"))
    assert not [file for file in files if "own_swarm" in str(file) or "own-swarm" in file.read_text()]
    subprocess.run([sys.executable, "-m", "ruff", "check", "--select", "E,F,W,B", "my-swarm"], check=True)


def test_who_stands_in_the_folder_finds_the_system_and_who_does_not_does_not(here):
    lay_out("my-swarm")
    program = "from formicarium.systems.registry import names, resolve; print(names(), resolve('my-swarm').summary)"
    inside, outside = python(program, here / "my-swarm"), python(program, here)
    assert "'my-swarm'" in inside.stdout and "e-pucks that gather" in inside.stdout
    assert "unknown system 'my-swarm'" in outside.stderr


def test_the_folder_wins_over_an_installed_copy(here):
    for place in ("installed", "edited"):
        (here / place).mkdir()
        os.chdir(here / place)
        lay_out("my-swarm")
    os.chdir(here)
    file = here / "edited/my-swarm/my_swarm/study.py"
    file.write_text(file.read_text().replace("e-pucks that gather", "edited"))
    program = f"import sys; sys.path.append({str(here / 'installed/my-swarm')!r}); "
    program += "from formicarium.systems.registry import resolve; print(resolve('my-swarm').summary)"
    assert python(program, here / "edited/my-swarm").stdout.strip().endswith("edited")


def test_code_that_cannot_be_imported_is_named_with_file_and_line(here):
    lay_out("my-swarm")
    file = here / "my-swarm/my_swarm/behaviour.py"
    original = file.read_text()
    for wrong, said in (("x = = 1\n", "SyntaxError"), ("import nothing_of_that_name\n", "ModuleNotFoundError"),
                        ("1 / 0\n", "ZeroDivisionError")):  # fmt: skip
        file.write_text(wrong + original)
        for command in (["describe", "my-swarm"], ["systems"]):
            program = f"import sys; from formicarium.commands.main import exit_code; sys.exit(exit_code({command}))"
            done = python(program, here / "my-swarm")
            said_all = "".join((done.stdout + done.stderr).split())
            assert "behaviour.py,line1:" + said in said_all, done.stderr
            assert done.returncode == (2 if command[0] == "describe" else 0)


@pytest.mark.parametrize("name", ["My-Swarm", "my_swarm", "3d", "", "a--b", "../x", "numpy", "class", "mark-i3"])
def test_a_name_that_cannot_be_used_leaves_nothing(here, name):
    with pytest.raises(UserError, match="new"):
        lay_out(name)
    assert list(here.iterdir()) == []


def test_what_is_there_is_never_touched(here):
    (here / "my-swarm").mkdir()
    with pytest.raises(UserError, match="already"):
        lay_out("my-swarm")
    assert list((here / "my-swarm").iterdir()) == []

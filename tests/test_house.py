"""The house rules that a tool can check: style, types, the direction of imports, the size of files."""

import re
import subprocess
import sys
import sysconfig
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
SOURCE = ROOT / "src" / "formicarium"
SCRIPTS = Path(sysconfig.get_path("scripts"))


def check(*command):
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
    assert done.returncode == 0, f"{done.stdout}\n{done.stderr}"


@pytest.mark.parametrize("arguments", [("check",), ("format", "--check")])
def test_style(arguments):
    check(sys.executable, "-m", "ruff", *arguments)


def test_types():
    check(sys.executable, "-m", "mypy")


def test_rooms_import_only_from_rooms_below():
    check(str(SCRIPTS / "lint-imports"))


def test_campaigns_and_statistics_do_not_know_what_they_run():
    for path in [*(SOURCE / "campaigns").rglob("*.py"), *(SOURCE / "statistics").rglob("*.py")]:
        assert "robot" not in path.read_text(encoding="utf-8").lower(), path


def test_files_are_short():
    lengths = {path: len(path.read_text(encoding="utf-8").splitlines()) for path in SOURCE.rglob("*.py")}
    assert not {str(path): length for path, length in lengths.items() if length > 400}


def test_no_file_has_a_name_that_says_nothing():
    vague = {"utils", "util", "helpers", "helper", "common", "manager", "base", "misc", "core", "tools"}
    assert not [path for path in SOURCE.rglob("*.py") if path.stem in vague]


def test_numba_has_one_address():
    users = [p for p in SOURCE.rglob("*.py") if re.search(r"^\s*(import|from) numba", p.read_text("utf-8"), re.M)]
    assert users == [SOURCE / "compiled.py"]


def test_the_automatic_check_runs_the_command_of_the_readme():
    printed = subprocess.run(
        [str(ROOT / ".ci" / "run"), "--print"], capture_output=True, text=True, check=True
    ).stdout.strip()
    assert printed == 'python -m pip install -e ".[test]" && python -m pytest -n 2 --dist loadfile'
    assert printed in (ROOT / "README.md").read_text(encoding="utf-8")

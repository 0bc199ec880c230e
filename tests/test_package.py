"""What is shipped: a wheel that runs without its checkout, extras that resolve alone, a workflow that knows them."""

import os
import shutil
import subprocess
import sys
import tomllib
import zipfile
from pathlib import Path

import pytest
import yaml

ROOT = Path(__file__).parents[1]
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
EXTRAS = sorted(PROJECT["optional-dependencies"])
JOBS = yaml.safe_load((ROOT / ".github" / "workflows" / "tests.yml").read_text(encoding="utf-8"))["jobs"]
# Interpreters that are on the path, the tests' own first; PATH decides which.
NAMES = [f"python3.{minor}" for minor in range(11, 16)]
OUTSIDE = {name: value for name, value in os.environ.items() if name not in ("PYTHONPATH", "FORMICARIUM_CACHE_DIR")}


def works(name):
    found = shutil.which(name)
    return found is not None and subprocess.run([found, "-c", ""], capture_output=True, check=False).returncode == 0


def done(*command, **options):
    finished = subprocess.run(command, env=OUTSIDE, capture_output=True, text=True, check=False, **options)
    assert finished.returncode == 0, f"{finished.stdout}\n{finished.stderr}"
    return finished.stdout


def environment(python, place):
    done(python, "-m", "venv", place)
    return place / ("Scripts" if sys.platform == "win32" else "bin") / "python"


@pytest.fixture(scope="module")
def wheel(tmp_path_factory):
    place = tmp_path_factory.mktemp("wheel")
    done(sys.executable, "-m", "pip", "wheel", "--no-deps", "--wheel-dir", place, ROOT)
    (built,) = place.glob("formicarium-*.whl")
    return built


def test_the_workflow_knows_every_extra_and_the_oldest_python():
    assert sorted(JOBS["wheel"]["strategy"]["matrix"]["extra"]) == sorted({"", *EXTRAS} - {"test"})
    for job in ("smoke", "tests"):
        assert f">={JOBS[job]['strategy']['matrix']['python'][0]}" == PROJECT["requires-python"]
    assert {system.partition("-")[0] for system in JOBS["smoke"]["strategy"]["matrix"]["system"]} == {
        "ubuntu",
        "macos",
        "windows",
    }


def test_the_workflow_runs_files_that_are_there():
    steps = [step["run"] for job in JOBS.values() for step in job["steps"] if "run" in step]
    programs = {word for step in steps for word in step.split() if word.startswith(".ci/")}
    assert programs == {".ci/run", ".ci/smoke.py"} and all((ROOT / program).is_file() for program in programs)


@pytest.mark.long
def test_the_wheel_holds_every_file_of_the_package(wheel):
    files = [path.relative_to(ROOT / "src") for path in (ROOT / "src" / "formicarium").rglob("*") if path.is_file()]
    wanted = {file.as_posix() for file in files if not any(part.startswith((".", "__")) for part in file.parts[:-1])}
    assert wanted == {name for name in zipfile.ZipFile(wheel).namelist() if ".dist-info/" not in name}


@pytest.mark.long
@pytest.mark.parametrize("python", [sys.executable, *filter(works, NAMES)])
def test_the_wheel_alone_runs(python, wheel, tmp_path):
    inside = environment(python, tmp_path / "environment")
    done(inside, "-m", "pip", "install", "--quiet", wheel)
    program = shutil.copy(ROOT / ".ci" / "smoke.py", tmp_path)
    assert " runs with Python " in done(inside, program, cwd=tmp_path)


@pytest.mark.long
@pytest.mark.parametrize("extra", EXTRAS)
def test_every_extra_resolves_alone(extra, wheel, tmp_path):
    inside = environment(sys.executable, tmp_path / "environment")
    told = done(inside, "-m", "pip", "install", "--dry-run", f"{wheel}[{extra}]", cwd=tmp_path)
    assert "Would install" in told

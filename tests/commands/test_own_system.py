"""A reader's own system: a file beside the design, with the installed command, in a folder that was empty."""

import os
import shutil
import subprocess
import sysconfig
from pathlib import Path

import pytest

from formicarium.sources import own_files

TESTS = Path(__file__).parents[1]
DESIGN = """
from steps import MOST
DESIGN = {"name": "walk", "system": "walk:RANDOM_WALK", "replicates": 2, "factors": {"robots": [5, MOST]}}
"""


@pytest.fixture
def folder(tmp_path):
    text = (TESTS / "random_walk.py").read_text()
    (tmp_path / "walk.py").write_text(text.replace("import numpy as np\n", "import numpy as np\nimport steps\n"))
    (tmp_path / "steps.py").write_text("MOST = 9\n")
    (tmp_path / "study.py").write_text(DESIGN)
    return tmp_path


def formicarium(folder, *words):
    command = [Path(sysconfig.get_path("scripts")) / "formicarium", *words]
    return subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)


def test_a_file_in_the_folder_is_a_system_and_its_neighbours_decide_nothing(folder):
    done = formicarium(folder, "campaign", "run", "study.py", "--workers", "2")
    assert "4 of 4 runs done" in done.stdout, done.stderr
    (folder / "study.py").write_text(DESIGN + "# the design was edited\n")
    (folder / "drawing.py").write_text("import walk\n")
    assert "4 of 4 runs done" in formicarium(folder, "campaign", "status", "study.py").stdout
    (folder / "steps.py").write_text("MOST = 9  # what the system imports was edited\n")
    assert "0 of 4 runs done" in formicarium(folder, "campaign", "status", "study.py").stdout


def test_the_sources_of_a_file_are_what_it_imports_and_those_of_a_package_are_all(folder):
    assert [path.name for path in own_files(folder / "walk.py", "")] == ["steps.py", "walk.py"]
    inside = folder / "package" / "systems"
    inside.mkdir(parents=True)
    for path in (folder / "package" / "ground.py", inside / "mine.py"):
        shutil.copy(folder / "steps.py", path)
    assert [path.name for path in own_files(inside / "mine.py", "package.systems")] == ["ground.py", "mine.py"]


def test_an_installed_package_registers_a_system_by_name(folder, monkeypatch):
    """As pip leaves it: the package, and beside it what it registers."""
    site, record = folder / "site", folder / "site" / "walkers-1.0.dist-info"
    (site / "walkers").mkdir(parents=True)
    record.mkdir()
    (site / "walkers" / "__init__.py").touch()
    shutil.copy(TESTS / "random_walk.py", site / "walkers" / "study.py")
    (record / "METADATA").write_text("Metadata-Version: 2.1\nName: walkers\nVersion: 1.0\n")
    (record / "entry_points.txt").write_text("[formicarium.systems]\nwalkers = walkers.study:RANDOM_WALK\n")
    monkeypatch.setenv("PYTHONPATH", os.pathsep.join([str(site), os.environ.get("PYTHONPATH", "")]))
    (folder / "study.toml").write_text('name = "w"\nsystem = "walkers"\nreplicates = 2\n[factors]\nrobots = [4, 5]\n')
    done = formicarium(folder, "campaign", "run", "study.toml", "--workers", "2")
    assert "4 of 4 runs done" in done.stdout, done.stderr
    (site / "walkers" / "__init__.py").write_text("# edited\n")
    assert "0 of 4 runs done" in formicarium(folder, "campaign", "status", "study.toml").stdout

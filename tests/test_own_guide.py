"""The guide to a swarm of one's own is executed as it stands, by the installed command, in an empty folder."""

import os
import re
import shlex
import subprocess
import sys
import sysconfig
from pathlib import Path

import pyarrow.parquet as pq
import pytest

ROOT = Path(__file__).parents[1]
BLOCK = re.compile(r"^<!-- (?P<kind>[^>]+?) -->\n```\w*\n(?P<text>.*?)^```$", re.MULTILINE | re.DOTALL)
COMMAND = Path(sysconfig.get_path("scripts")) / "formicarium"
SHORT = ["--set", "time_cap=30"]  # simulated seconds


def typed(line, folder):
    words = shlex.split(line)
    assert words[0] == "formicarium"
    if words[1] == "run":
        words += [*SHORT, "--workers", "1"]
    done = subprocess.run([COMMAND, *words[1:]], cwd=folder, capture_output=True, text=True, check=False)
    assert done.returncode == 0, f"{line}\n{done.stdout}\n{done.stderr}"
    return done.stdout


def own_lines(text):
    """Lines that say something: neither empty nor only words."""
    return [line for line in text.splitlines() if line.strip() and not line.lstrip().startswith(("#", '"""'))]


def test_the_guide_to_a_swarm_of_ones_own_is_true(tmp_path):
    text = (ROOT / "docs" / "guides" / "own_system.md").read_text(encoding="utf-8")
    blocks = BLOCK.findall(text)
    assert len(blocks) == text.count("```") // 2
    folder, written = tmp_path, []
    for kind, content in blocks:
        if kind.startswith("file: "):
            (folder / kind.removeprefix("file: ")).write_text(content)
            written += own_lines(content)
        elif kind == "commands":
            for line in content.splitlines():
                if line.startswith("cd "):
                    folder = folder / line.removeprefix("cd ")
                else:
                    typed(line, folder)
        elif kind == "python":
            written += own_lines(content)
            environment = os.environ | {"MPLBACKEND": "agg"}
            subprocess.run([sys.executable, "-c", content], cwd=folder, env=environment, check=True)
        else:
            assert kind in ("at the keyboard", "a minute or two")
    assert len(written) < 80 + len(own_lines(blocks_of(blocks, "room.toml")))  # the room is written twice to show how
    rows = pq.read_table(folder / "formicarium-results" / "weights" / "runs.parquet")
    assert rows.num_rows == 24 and max(rows["resting"].to_pylist()) > 8
    tested = subprocess.run([sys.executable, "-m", "pytest", "-q", "-k", "lamp"], cwd=folder, check=False)
    assert tested.returncode == 0
    for name in ("weights.png", "room.html"):
        assert (folder / name).stat().st_size > 10_000


def blocks_of(blocks, name):
    return next(content for kind, content in blocks if kind == f"file: {name}")


@pytest.mark.long
def test_what_is_laid_out_keeps_all_contracts(tmp_path):
    typed("formicarium new light-seekers", tmp_path)
    done = subprocess.run([sys.executable, "-m", "pytest", "-q"], cwd=tmp_path / "light-seekers", check=False)
    assert done.returncode == 0

"""The numbered examples are run as a reader would run them, and print what is stored beside them."""

import os
import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from formicarium.contracts import CONTRACTS
from formicarium.robots.records import SILENCE, Colour
from formicarium.systems.registry import resolve
from formicarium.trial.swarm.castes import castes_by_key

EXAMPLES = Path(__file__).parents[1] / "docs" / "examples"
FILES = sorted(EXAMPLES.glob("example_*.py"))


@pytest.fixture(autouse=True)
def importable(monkeypatch):
    monkeypatch.syspath_prepend(str(EXAMPLES))


@pytest.mark.parametrize("file", FILES, ids=lambda file: file.stem)
def test_an_example_prints_what_is_stored(file, tmp_path):
    done = subprocess.run([sys.executable, file], cwd=tmp_path, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    assert done.stdout == file.with_suffix(".txt").read_text(encoding="utf-8")


def test_examples_are_numbered_told_on_their_page_and_say_what_they_are():
    numbers = [int(re.match(r"example_(\d\d)_", file.name)[1]) for file in FILES]
    assert numbers == list(range(1, len(FILES) + 1))
    page = (EXAMPLES / "index.md").read_text(encoding="utf-8")
    for file in FILES:
        assert file.read_text(encoding="utf-8").startswith('"""')
        assert page.count(f"{{literalinclude}} {file.name}") == page.count(f"{{literalinclude}} {file.stem}.txt") == 1


def test_one_example_uses_every_sensor_of_the_e_puck():
    """The behaviour reads each of them, and each feels something in the trial."""
    system = resolve("example_03_every_sensor:SYSTEM")
    text = (EXAMPLES / "example_03_every_sensor.py").read_text(encoding="utf-8")
    state = system.begin(system.configure(), 1)
    senses = [name for name in state.readings.dtype.names if not name.endswith("_count")]
    unused = [name for name in senses if f"reading.{name}" not in text]
    assert unused == ["identity", "cycle", "right_steps"]  # no senses but names and clocks, and a second wheel's count
    felt = dict.fromkeys(("proximity", "light", "ground", "blob_count", "packet_count", "left_steps"), False)
    heard = False
    while not state.clock[0].finished:
        system.advance(state, 5)
        state.clock[0].event_count = 0
        felt = {name: seen or bool(np.any(state.readings[name])) for name, seen in felt.items()}
        heard = heard or bool((np.asarray(state.readings.infrared) != SILENCE).any())
    assert all(felt.values()) and heard


def test_castes_differ_in_body_wheels_sensors_and_deeds():
    system = resolve("example_04_two_castes:SYSTEM")
    parameters = system.configure()
    state = system.begin(parameters, 1, storage=np.random.default_rng(1).permutation(12))
    scouts = np.asarray(state.castes) == 0
    assert set(state.robots.key[scouts].tolist()) == {0, 1, 2, 3} and (state.memories.caste == state.castes).all()
    assert set(state.world.bodies.radius[scouts]) == {0.03} and set(state.world.bodies.radius[~scouts]) == {0.04}
    assert set(state.world.bodies.mass[scouts]) == {0.3} and set(state.world.bodies.mass[~scouts]) == {1.2}
    state.commands.colour = Colour.GREEN  # of the cycle before: everybody can be seen in the first
    system.advance(state, 1)
    blobs, near = state.readings.blobs, np.zeros(12)
    for i, count in enumerate(state.readings.blob_count):
        near[i] = blobs.distance[i, :count].max(initial=0.0)
    assert near[scouts].max() > 0.29 > near[~scouts].max() > 0.15  # cameras reach 0.332 and 0.25 m, noise 0.013 m
    paths = ("left_path", "right_path")
    before = [np.asarray(state.robots[path]).copy() for path in paths]
    system.advance(state, 299)
    ways = np.max([np.abs(state.robots[path] - was) for path, was in zip(paths, before)], axis=0)
    assert ways[scouts].max() > 29.9 * 0.05 and (ways[~scouts] <= 29.9 * 0.05 + 1e-9).all()


def test_castes_that_are_not_the_swarm_are_told():
    system = resolve("example_04_two_castes:SYSTEM")
    module = sys.modules["example_04_two_castes"]
    numbers = module.Caste(3, module.Epuck()), module.Caste(4, module.Epuck())
    assert castes_by_key(numbers, 7).tolist() == [0, 0, 0, 1, 1, 1, 1]
    with pytest.raises(ValueError, match=r"castes of \[3, 4\] robots: they must make the 8 of swarm.robots"):
        castes_by_key(numbers, 8)
    assert len(system.begin(system.configure(robots=1), 1).robots) == 1


@pytest.mark.parametrize("contract", CONTRACTS, ids=lambda contract: contract.__name__)
def test_two_castes_keep_every_contract(contract):
    contract("example_04_two_castes:SYSTEM")


def test_castes_decide_outside_as_inside(tmp_path):
    """Each controller is told of its own body."""
    environment = os.environ | {"PYTHONPATH": str(EXAMPLES)}
    command = [sys.executable, "-m", "formicarium.commands.main", "onboard", "example_04_two_castes:SYSTEM"]
    done = subprocess.run(
        [*command, "--robots", "4", "--cycles", "20"],
        cwd=tmp_path, env=environment, capture_output=True, text=True, check=False,
    )  # fmt: skip
    assert done.returncode == 0 and "the same" in done.stdout, done.stderr

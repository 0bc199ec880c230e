"""A controller sees its Reading and its Memory and nothing else (TS-18, T1, T6)."""

import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from formicarium.physics.records import records
from formicarium.robots.records import COMMAND, READING
from formicarium.systems.sequencing.behaviour import decide
from formicarium.systems.sequencing.loop import run
from formicarium.systems.sequencing.memory import MEMORY, Role
from formicarium.systems.sequencing.parameters import mark_i3_parameters
from formicarium.systems.sequencing.setup import begin
from systems.stage import step

CYCLES = 300
SEED = 12


def canonical(commands: np.ndarray) -> np.ndarray:
    """Return commands with the payload of silent emitters, which nobody receives, set to 0."""
    commands = np.array(commands)
    commands["payload"][commands["enabled"] == 0] = 0
    return commands


def replay(folder: Path) -> None:
    """Decide from recorded readings alone; memories are given once and then kept by this process itself."""
    p = mark_i3_parameters()
    behaviour, epuck = p.behaviour.record()[0], p.epuck.record()[0]
    readings = np.fromfile(folder / "readings", READING).view(np.recarray).reshape(CYCLES, -1)
    memories = np.fromfile(folder / "memories", MEMORY).view(np.recarray)
    commands = records(COMMAND, readings.shape)
    for cycle in range(CYCLES):
        for i in range(readings.shape[1]):
            decide(readings[cycle, i], memories[i], commands[cycle, i], behaviour, epuck)
    canonical(commands).tofile(folder / "replayed")


@pytest.fixture(scope="module")
def recorded(tmp_path_factory):
    """Record all readings and commands of a trial's cycles while its chain grows."""
    folder = tmp_path_factory.mktemp("recorded")
    state = begin(mark_i3_parameters(), SEED)
    step(state, 1200)
    state.memories.tofile(folder / "memories")
    roles, readings, commands = set(), [], []

    def keep(state):
        readings.append(np.array(state.readings))
        commands.append(canonical(state.commands))
        roles.update(state.memories.role.tolist())

    step(state, CYCLES, None, keep)
    assert roles == {Role.RUNNER, Role.GUARDIAN, Role.TAIL, Role.LINK}
    np.array(readings).tofile(folder / "readings")
    return folder, np.array(commands)


def test_in_a_process_of_its_own_readings_alone_give_every_command_bit_for_bit(recorded):
    folder, commands = recorded
    program = (
        "import sys; from pathlib import Path; sys.path.insert(0, sys.argv[1]);"
        "from systems.test_boundary import replay; replay(Path(sys.argv[2]))"
    )
    arguments = [sys.executable, "-c", program, str(Path(__file__).parents[1]), str(folder)]
    subprocess.run(arguments, env=os.environ.copy(), check=True)
    replayed = np.fromfile(folder / "replayed", COMMAND).reshape(commands.shape)
    assert commands.shape == (CYCLES, 20)
    for name in COMMAND.names:
        assert (replayed[name] == commands[name]).all(), name
    assert len(np.unique(commands["left"])) > 300


def test_nothing_in_a_reading_is_a_place_in_the_world_or_somebody_elses_memory():
    """TS-18, word for word; the random stream is the memory's."""
    assert set(READING.names) == {
        *("identity", "cycle", "proximity", "blob_count", "blobs", "packet_count", "packets"),
        *("infrared", "left_steps", "right_steps"),
    }
    assert READING["blobs"].base.names == ("colour", "distance", "bearing")
    assert READING["packets"].base.names == ("payload", "distance", "bearing")
    assert set(COMMAND.names) == {"left", "right", "colour", "enabled", "payload", "infrared"}


def test_the_stage_runs_the_loop_as_the_system_does():
    """What the other tests stand on: the loop from outside is the loop."""
    inside, outside = begin(mark_i3_parameters(), SEED), begin(mark_i3_parameters(), SEED)
    run(inside, 400)
    step(outside, 400)
    for name in ("memories", "commands", "readings", "booths", "referee", "members"):
        assert getattr(inside, name).tobytes() == getattr(outside, name).tobytes(), name
    assert inside.world.bodies.tobytes() == outside.world.bodies.tobytes()

"""What ``debug`` does: lead a run to a cycle, compiled, and hand its state to an interpreted process."""

import json
import os
import pickle
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Any

from formicarium.commands.errors import UserError
from formicarium.commands.known import find_system, parameters_of
from formicarium.commands.runs import find_run
from formicarium.systems.registry import System, names, resolve
from formicarium.systems.stepping import mind_divisions
from formicarium.views.live.session import Session

PROGRAM = (
    "import json, sys; sys.path[:] = json.loads(sys.argv[1]); from formicarium.commands.debugging import step; "
    "step(sys.argv[2], sys.argv[3], int(sys.argv[4]), int(sys.argv[5]))"
)
Choice = tuple[int | None, int | None, tuple[str, ...]]  # setting, robots, name=value


def debug_run(place: str, cycle: int, robot: int | None, cycles: int, seed: int | None, choice: Choice) -> int:
    """Debug a robot of a run; return the exit code.

    Raises:
        UserError: if there is no such run, cycle or robot.
    """
    name, state = state_of(place, cycle, seed, choice)
    known = sorted(int(identity) for identity in state.robots["identity"])
    if robot is not None and robot not in known:
        raise UserError(f"--robot {robot}: there is none; robots are {', '.join(map(str, known))}")
    chosen = known[0] if robot is None else robot
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "state"
        file.write_bytes(pickle.dumps(state))
        command = [sys.executable, "-c", PROGRAM, json.dumps(sys.path), name, str(file), str(chosen), str(cycles)]
        return subprocess.run(command, env=os.environ | {"FORMICARIUM_INTERPRETED": "1"}, check=False).returncode


def state_of(place: str, cycle: int, seed: int | None, choice: Choice) -> tuple[str, Any]:
    """Return the name of a run's system and its state before a cycle."""
    if Path(place).exists() and place not in names():  # a system of one's own lives in a folder of its name
        if any(choice):
            raise UserError("--set, --setting and --robots go with the name of a system: a stored run has its numbers")
        run = find_run(place, seed)
        session = Session(run.system, run.parameters, run.seed, run.interventions)
        name = run.system.name
    else:
        name, system = place, find_system(place)
        session = Session(system, parameters_of(system, *choice), 1 if seed is None else seed)
    session.advance(cycle)
    if session.cycle != cycle or session.finished:
        raise UserError(f"--cycle {cycle}: the trial ends at cycle {session.cycle}")
    return name, session.state


def step(name: str, file: str, robot: int, cycles: int) -> None:
    """Go through cycles in the debugger, stopping where the robot begins to decide. Runs interpreted."""
    system, state = resolve(name), pickle.loads(Path(file).read_bytes())
    mind_divisions(strict=False)
    print("n next line   s into   p memory.FIELD print   b FILE:LINE break   c next cycle   q end", flush=True)
    for _ in range(cycles):
        if state.clock[0].finished or not _stepped(system, state, robot):
            break


def _stepped(system: System, state: Any, robot: int) -> bool:
    """Let one cycle pass under the debugger; return whether to go on."""
    from bdb import BdbQuit
    from pdb import Pdb, post_mortem

    debugger = Pdb(nosigint=True)

    def waiting(frame: Any, event: str, _: Any) -> Any:
        names = frame.f_locals if event == "call" else {}
        reading = names.get("reading")
        if reading is not None and "memory" in names and getattr(reading, "identity", None) == robot:
            print(f"\nrobot {robot}, cycle {int(state.clock[0].cycle)}", flush=True)
            sys.settrace(None)
            debugger.set_trace(frame)
            return debugger.trace_dispatch
        return None

    sys.settrace(waiting)
    try:
        system.advance(state, 1)  # type: ignore[misc]
    except BdbQuit:
        return False
    except Exception as error:
        sys.settrace(None)
        print(f"\n{type(error).__name__}: {error}; p NAME print   u frame above   q end", flush=True)
        post_mortem(error.__traceback__)
        return False
    finally:
        sys.settrace(None)
    state.clock[0].event_count = 0
    return True

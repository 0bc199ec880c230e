"""``formicarium onboard SYSTEM``: every robot's controller as a process of its own, held against the simulator."""

from typing import Annotated

from cyclopts import Parameter

from formicarium.commands.whole import Whole


def onboard(
    system: str,
    /,
    *,
    seed: Whole = 1,
    start: Whole = 0,
    cycles: Whole = 100,
    robots: Whole | None = None,
    setting: Whole | None = None,
    set_: Annotated[list[str] | None, Parameter(name="--set", negative="")] = None,
    patience: float = 5.0,
) -> int:
    """Run every robot's controller as an interpreted process of its own, as on a real robot, in lock step.

    Each is fed with nothing but its readings, over a local socket, and answers
    with commands. Events and the whole state at the end are held against those
    of the compiled trial: exit code 0 if they are the same bytes, 1 if not or if
    a controller was lost.

    Examples:

        formicarium onboard my-swarm --cycles 300
        formicarium onboard mark-i3 --start 6000 --robots 10
        formicarium onboard coverage --start 300 --robots 10

    Parameters
    ----------
    system
        Name of the system; list them with: formicarium systems
    seed
        Seed of the trial.
    start
        Cycle at which the controllers take over.
    cycles
        How many cycles to run.
    robots
        Number of robots, instead of that of the setting.
    setting
        A published setting of the system, by its number.
    set_
        Change a parameter: NAME=VALUE, as often as needed.
    patience
        Seconds a controller may take for an answer.
    """
    import pickle

    import numpy as np

    from formicarium.commands.errors import UserError
    from formicarium.commands.known import find_system, parameters_of
    from formicarium.contracts.states import differences
    from formicarium.trial.lockstep import Lockstep
    from formicarium.trial.simulate import drain

    if cycles < 1 or start < 0:
        raise UserError(f"--start {start}, --cycles {cycles}: at least 0 and 1")
    found = find_system(system)
    if found.onboard is None or found.begin is None or found.advance is None:
        raise UserError(f"{system} does not say where its robots decide (System.onboard)")
    state = found.begin(parameters_of(found, setting, robots, tuple(set_ or ())), seed)
    found.advance(state, start)
    if int(state.clock[0].cycle) < start:
        raise UserError(f"--start {start}: the trial ends in cycle {int(state.clock[0].cycle)}: begin before")
    state.clock[0].event_count = 0
    other = pickle.loads(pickle.dumps(state))
    logs: list[list[np.ndarray]] = [[], []]
    try:
        started = Lockstep(found.onboard, other, patience)
    except ValueError as error:
        raise UserError(f"{system}: {error}") from error
    with started as controllers:
        print(f"{len(controllers.processes)} controllers take over at cycle {start}", flush=True)
        for _ in range(0, cycles, 100):
            length = min(100, cycles - int(state.clock[0].cycle - start))
            found.advance(state, length)
            controllers.advance(length)
            logs[0].append(drain(state))
            logs[1].append(drain(other))
        lost = controllers.lost
    here, there = (np.concatenate(log) for log in logs)
    apart = differences(state._replace(events=other.events), other)
    if here.tobytes() != there.tobytes():
        apart.insert(0, "events")
    said = f"NOT the same: {', '.join(apart[:5])}" if apart else "the same, and so is every number at the end"
    print(f"{int(state.clock[0].cycle) - start} cycles, {len(there)} events: {said}")
    return 0 if not apart and not lost else 1

"""``formicarium debug RUN``: one robot's decisions, line by line, in Python's own debugger."""

from typing import Annotated

from cyclopts import Parameter

from formicarium.commands.whole import Whole


def debug(
    run: str,
    /,
    *,
    cycle: Whole = 0,
    robot: Whole | None = None,
    cycles: Whole = 10,
    seed: Whole | None = None,
    robots: Whole | None = None,
    setting: Whole | None = None,
    set_: Annotated[list[str] | None, Parameter(name="--set", negative="")] = None,
) -> int:
    """Step through what one robot decides, in plain Python, from any cycle of a run.

    The run is simulated up to the cycle, compiled; from there on the same code
    is interpreted, and Python's debugger (pdb) stops where the robot begins to
    decide: n next line, s into a function, p memory prints, b FILE:LINE sets a
    breakpoint, c goes on to the robot's next cycle, q ends.

    Examples:

        formicarium debug my-swarm --cycle 300 --robot 17
        formicarium debug formicarium-results/my-swarm-33539ab2 --cycle 300
        formicarium debug seven --cycle 4000 --robot 17

    Parameters
    ----------
    run
        A recording, a folder of results, or the name of a system.
    cycle
        Control cycle to begin with, counted from 0.
    robot
        Identity of the robot, as pages and events name it; the first if not given.
    cycles
        How many cycles to stop in.
    seed
        Which run of a folder; the seed of a system's trial, 1 if not given.
    robots
        Number of robots, if a system is named.
    setting
        A published setting, if a system is named.
    set_
        Change a parameter, if a system is named: NAME=VALUE, as often as needed.
    """
    from formicarium.commands.debugging import debug_run

    return debug_run(run, cycle, robot, cycles, seed, (setting, robots, tuple(set_ or ())))

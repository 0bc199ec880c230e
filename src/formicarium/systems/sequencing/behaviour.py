"""One cycle of one robot: the probabilistic finite state machine of TS-Swarm (Fig. S1).

Marks I and II differ in what a guardian does, in the four bytes and in what a verdict means, nothing else.
All robots run this same function; roles are taken at run time. It sees its Reading and its Memory and writes
its Command, and nothing else: the same file runs compiled in the simulator and interpreted on a robot.
"""

from formicarium.compiled import compiled
from formicarium.control.speech import be_quiet
from formicarium.systems.sequencing.guardian import guard
from formicarium.systems.sequencing.guardian_ii import guard_ii
from formicarium.systems.sequencing.link import link
from formicarium.systems.sequencing.memory import Role
from formicarium.systems.sequencing.perception import perceive
from formicarium.systems.sequencing.runner import run
from formicarium.systems.sequencing.tail import tail


@compiled
def decide(reading, memory, command, table, epuck):
    """Read, remember, decide: the paper's control step, every 0.1 s.

    Args:
        reading: READING record, what the robot senses now.
        memory: MEMORY record, changed in place.
        command: COMMAND record, written.
        table: record of BehaviourTable.
        epuck: record of the robot's own table (wheel distance, steps).
    """
    be_quiet(command)
    perceive(reading, memory, table, epuck)
    if memory.role == Role.RUNNER:
        run(reading, memory, command, table, epuck)
    elif memory.role == Role.GUARDIAN:
        if table.mark == 2:
            guard_ii(reading, memory, command, table)
        else:
            guard(reading, memory, command, table)
    elif memory.role == Role.TAIL:
        tail(reading, memory, command, table, epuck)
    elif memory.role == Role.LINK:
        link(reading, memory, command, table, epuck)

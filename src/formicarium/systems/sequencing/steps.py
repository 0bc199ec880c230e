"""How a runner of Mark II keeps to the permutation that the guardians are trying (TS-104, TS-124 to TS-128)."""

from formicarium.compiled import compiled
from formicarium.systems.sequencing.ring import NOBODY, STEPS


@compiled
def keep_step(memory, advert, cycle, table):
    """Compare the own M4PI with a guardian's and tell whether to heed it.

    One or two ahead is newer: start again with it. Three ahead is one behind, a guardian that the news have not
    reached yet: skip it. A runner that has done nothing yet, or has not met its own M4PI for a long time, in which
    four steps may have gone by, takes any.
    """
    if advert.count == NOBODY:
        return False
    ahead = (advert.number - memory.step) % STEPS
    stale = cycle - memory.step_heard > table.step_memory
    if ahead == STEPS - 1 and memory.count > 0 and not stale:
        return False
    if ahead > 0 or stale:
        memory.count = 0
    memory.step = advert.number
    memory.step_heard = cycle
    return True

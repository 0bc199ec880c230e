"""Which arm a backbone robot belongs to: drawn by itself from the master's flooded table (ST-32)."""

from formicarium.compiled import compiled
from formicarium.streams import advanced, uniform

BLOCKS = 2  # place of "blocks" among the choices
BLOCK = 5  # robots of an arm in the authors' files


@compiled
def chance(memory):
    """Return a number in [0, 1) from the robot's own stream."""
    memory.draws = advanced(memory.draws)
    return uniform(memory.draws)


@compiled
def draw_arm(memory):
    """Return an arm, k with probability w_k / sum of w."""
    total = 0.0
    for k in range(memory.arm_count):
        total += memory.arms[k].weight
    left = chance(memory) * total
    for k in range(memory.arm_count):
        left -= memory.arms[k].weight
        if left < 0.0:
            return k + 1
    return memory.arm_count


@compiled
def choose_arm(reading, memory, table):
    """Draw an arm when none is had, and perhaps another one when the master corrects them."""
    if memory.arm_count == 0 or (memory.arm != 0 and memory.correction == memory.drawn):
        return
    memory.drawn = memory.correction
    if table.arm_choice == BLOCKS:
        memory.arm = 1 + ((reading.identity - 1) // BLOCK) % memory.arm_count
    elif memory.arm == 0 or chance(memory) < memory.arms[memory.arm - 1].leave:
        memory.arm = draw_arm(memory)
        memory.aligned = 0
        memory.branch = 0
        memory.place = 0

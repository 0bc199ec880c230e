"""Branches of an arm and places in them, as robots number them.

A branch has a number in octal: 0 is the stem, the arm from the master; each digit says which child of the branch
before it is meant. Places count along a branch from 1; robot ``branch_robots`` is the root of the children, as the
master is of the stems. Whoever stands beyond it is to spare.
"""

import math

from formicarium.angles import wrapped
from formicarium.compiled import compiled
from formicarium.systems.coverage.memory import Shape

DIGIT = 8


@compiled
def level_of(branch):
    """Return how many branchings a branch is away from its stem."""
    level = 0
    while branch > 0:
        branch //= DIGIT
        level += 1
    return level


@compiled
def descends(branch, ancestor):
    """Tell whether a branch is another one, or grows from it."""
    while branch > ancestor:
        branch //= DIGIT
    return branch == ancestor


@compiled
def swing_of(branch, formation):
    """Return the angle from an arm's stem to one of its branches (rad): children fan out over twice ``angle``."""
    swing = 0.0
    while branch > 0:
        if formation.branches > 1:
            swing += formation.angle * (2.0 * (branch % DIGIT - 1) / (formation.branches - 1) - 1.0)
        branch //= DIGIT
    return swing


@compiled
def neighbour_of(memory, arm, child):
    """Return the next arm counter-clockwise (child 1) or clockwise (child 2), by the directions that a robot knows."""
    best = 0
    least = 7.0
    for other in range(1, memory.arm_count + 1):
        turn = memory.arms[other - 1].direction - memory.arms[arm - 1].direction
        turn = (turn if child == 1 else -turn) % (2.0 * math.pi)
        if other != arm and turn < least:
            least = turn
            best = other
    return best


@compiled
def swing_to(memory, arm, child):
    """Return the angle from an arm to the way from its tip to that of a neighbour, as long as itself (rad)."""
    other = neighbour_of(memory, arm, child)
    turn = math.fabs(wrapped(memory.arms[other - 1].direction - memory.arms[arm - 1].direction))
    return (1.0 if child == 1 else -1.0) * 0.5 * (math.pi + turn)


@compiled
def is_to_spare(branch, place, formation):
    """Tell whether a place lies beyond the root of a branch's children."""
    return place > formation.branch_robots and level_of(branch) < formation.depth


@compiled
def is_root(packet, memory, formation):
    """Tell whether a speaker is where one's own branch begins."""
    if memory.branch == 0:
        return packet.linked == 1 and packet.hops == 0
    parent = memory.branch // DIGIT
    return packet.arm == memory.arm and packet.branch == parent and packet.place == formation.branch_robots


@compiled
def is_mate(packet, memory):
    """Tell whether a speaker is of one's own branch."""
    return packet.linked == 1 and packet.arm == memory.arm and packet.branch == memory.branch


@compiled
def remoteness(record, arm, branch, formation):
    """Return how far along its branch a speaker or oneself is (m), by the way to the master.

    A tube's other end may be nearer to the master, so there the way to the own arm's tip counts.
    """
    if formation.kind == Shape.NETWORK and branch > 0:
        own = record.arms[arm - 1]
        return own.way if own.open == 1 else math.inf
    return record.gradient


@compiled
def enter(memory, branch, cycle):
    """Belong to another branch from now on; one's place in it is still to be found."""
    memory.branch = branch
    memory.place = 0
    memory.place_since = cycle
    memory.doubted = 0
    memory.aligned = 0
    memory.reference_place = -1

"""What the published scripts read from the memories of all nodes (author mode). No robot can do any of this."""

import math

from formicarium.compiled import compiled
from formicarium.connectivity import pi1, pi2
from formicarium.connectivity.records import Method


@compiled
def tell(nodes):
    """Tell every node the sum and the 2-norm of f (ST-6, ST-8)."""
    total, square = 0.0, 0.0
    for k in range(len(nodes)):
        total += nodes[k].value
        square += nodes[k].value * nodes[k].value
    for k in range(len(nodes)):
        nodes[k].told_sum = total
        nodes[k].told_norm = math.sqrt(square)


@compiled
def strike(nodes, rules):
    """End the consensus of all nodes when their averages differ by less than the tolerance (ST-6)."""
    if rules.method == Method.PI1 and nodes[0].phase != pi1.NORM:
        return
    if rules.method == Method.PI2 and nodes[0].phase == pi2.STEP:
        return
    if nodes[0].count == 0:
        return  # it began in this iteration
    least, most = nodes[0].average, nodes[0].average
    for k in range(1, len(nodes)):
        least = min(least, nodes[k].average)
        most = max(most, nodes[k].average)
    if most - least < rules.tolerance:
        for k in range(len(nodes)):
            if rules.method == Method.PI1:
                pi1.end_consensus(nodes[k], rules)
            else:
                pi2.end_consensus(nodes[k], rules)


@compiled
def mirror(messages, inbox, heard, mirrored):
    """Take each pair's link from the first node for both: what the second has lost it reads all the same (ST-13)."""
    for i in range(len(heard)):
        for j in range(i + 1, len(heard)):
            mirrored[i, j] = mirrored[j, i] = heard[i, j]
            if heard[i, j]:
                inbox[j, i] = messages[i]

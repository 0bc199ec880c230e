"""PI1: power iteration on L, then on I - L / alpha (Bertrand and Moonen; ST-7).

A cycle: (A) one iteration f <- L f, which removes the mean; (B) 100 iterations f <- (I - L / alpha) f, in which the
Fiedler vector outlives the others; (C) consensus on the norm, f frozen, then f <- f / ||f||.
"""

from formicarium.compiled import compiled
from formicarium.connectivity.consensus import agree_on_norm, begin_norm, gather, norm_rounds, normalise
from formicarium.connectivity.records import Clock

APPLY, DIFFUSE, NORM = 0, 1, 2  # phases


@compiled
def listen(node, inbox, heard, rules):
    """Do one iteration of one node. What it hears is all it learns.

    Args:
        node: NODE, its memory, changed.
        inbox: (K,) MESSAGE, one place a sender.
        heard: (K,) bool, from whom there is a message.
        rules: RULES, known to all.
    """
    degree, values, averages = gather(inbox, heard)
    flow = degree * node.value - values  # (L f)_i
    node.estimate = degree - values / node.value  # ST-9
    if node.phase == APPLY:
        node.value = flow
        node.phase, node.count = DIFFUSE, 0
    elif node.phase == DIFFUSE:
        node.value -= flow / rules.alpha
        node.count += 1
        if node.count == rules.diffusions:
            node.phase = NORM
            begin_norm(node, rules)
    else:
        agree_on_norm(node, inbox, heard, degree, averages, rules)
        if rules.clock == Clock.ROUNDS and node.count == norm_rounds(rules):
            end_consensus(node, rules)


@compiled
def end_consensus(node, rules):
    """End step C."""
    normalise(node, rules)
    node.phase = APPLY

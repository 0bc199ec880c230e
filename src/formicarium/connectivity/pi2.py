"""PI2: power iteration on B = I - eps L - 1 1' / K (Di Lorenzo and Barbarossa; ST-8).

A cycle: (0) consensus on the mean of f; (1) one iteration f <- B f; (2) consensus on the norm, then f <- f / ||f||.
"""

from formicarium.compiled import compiled
from formicarium.connectivity.consensus import agree, agree_on_norm, begin_norm, gather, norm_rounds, normalise
from formicarium.connectivity.records import Clock, Source

MEAN, STEP, NORM = 0, 1, 2  # phases


@compiled
def begin(node):
    """Begin a cycle."""
    node.average = node.value
    node.phase, node.count = MEAN, 0


@compiled
def listen(node, inbox, heard, rules):
    """Do one iteration of one node; arguments as in PI1."""
    degree, values, averages = gather(inbox, heard)
    node.estimate = degree - values / node.value  # ST-9
    if node.phase == STEP:
        mean = node.found_mean if rules.mean_source == Source.CONSENSUS else node.told_sum / rules.nodes
        node.value -= rules.epsilon * (degree * node.value - values) + mean
        node.phase = NORM
        begin_norm(node, rules)
    elif node.phase == MEAN:
        agree(node, degree, averages, rules)
        if rules.clock == Clock.ROUNDS and node.count == rules.rounds:
            end_consensus(node, rules)
    else:
        agree_on_norm(node, inbox, heard, degree, averages, rules)
        if rules.clock == Clock.ROUNDS and node.count == norm_rounds(rules):
            end_consensus(node, rules)


@compiled
def end_consensus(node, rules):
    """End step 0 or 2."""
    if node.phase == MEAN:
        node.found_mean = node.average
        node.phase = STEP
    else:
        normalise(node, rules)
        begin(node)

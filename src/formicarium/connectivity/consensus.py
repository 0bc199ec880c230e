"""Average consensus and the sums that a node takes over what it hears (ST-6)."""

import math

from formicarium.compiled import compiled
from formicarium.connectivity.records import Source


@compiled
def gather(inbox, heard):
    """Return the number of neighbours heard, the sum of their values and the sum of their averages.

    Args:
        inbox: (K,) MESSAGE, one place a sender.
        heard: (K,) bool, from whom there is a message.
    """
    degree, values, averages = 0.0, 0.0, 0.0
    for sender in range(len(heard)):
        if heard[sender]:
            degree += 1.0
            values += inbox[sender].value
            averages += inbox[sender].average
    return degree, values, averages


@compiled
def agree(node, degree, averages, rules):
    """Move a node's average towards its neighbours': c <- c - gamma (D - A) c."""
    node.average -= rules.mixing * (degree * node.average - averages)
    node.count += 1


@compiled
def begin_norm(node, rules):
    """Begin the consensus that ends in a norm: on f^2, on the largest |f|, or, as a mere clock, on f."""
    node.average = node.value
    if rules.norm_source == Source.CONSENSUS:
        node.average = node.value * node.value
    elif rules.norm_source == Source.MAXIMUM:
        node.average = abs(node.value)
    node.count = 0


@compiled
def agree_on_norm(node, inbox, heard, degree, averages, rules):
    """Do one iteration of that consensus."""
    if rules.norm_source == Source.MAXIMUM:
        for sender in range(len(heard)):
            if heard[sender]:
                node.average = max(node.average, inbox[sender].average)
        node.count += 1
    else:
        agree(node, degree, averages, rules)


@compiled
def norm_rounds(rules):
    """Return the rounds after which a node takes its norm for agreed upon."""
    return rules.flood if rules.norm_source == Source.MAXIMUM else rules.rounds


@compiled
def normalise(node, rules):
    """Divide a node's entry by the norm: f <- f / ||f||, ||f||^2 = K times the average of f^2."""
    if rules.norm_source == Source.CONSENSUS:
        norm = math.sqrt(rules.nodes * node.average)
    elif rules.norm_source == Source.MAXIMUM:
        norm = node.average
    else:
        norm = node.told_norm
    node.value /= norm

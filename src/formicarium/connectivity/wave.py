"""Wave: every node's signal obeys the wave equation on the graph (Sahai et al.; ST-10).

    s_i(t) = 2 s_i(t-1) - s_i(t-2) - c^2 [ s_i(t-1) - (1/d_i) sum_j s_j(t-1) ]

The eigenvalues mu of D^-1 L sound as angular frequencies omega, mu = 2 (1 - cos omega) / c^2, which each node finds in
the spectrum of its own signal (``spectrum.py``). The formula as printed in Panerati et al. 2018 lacks -c^2 s_i and
1/d_i; it grows without bound on every graph that has a link (the switch ``printed``).
"""

from formicarium.compiled import compiled
from formicarium.connectivity.consensus import gather


@compiled
def listen(node, inbox, heard, counted, rules):
    """Do one iteration of one node.

    Args:
        node: NODE, its memory, changed.
        inbox: (K,) MESSAGE, one place a sender.
        heard: (K,) bool, whose messages are summed.
        counted: (K,) bool, whose messages make the degree; ``heard`` again but for the artefact Rows.MIRRORED.
        rules: RULES, known to all.
    """
    degree = 0.0
    for sender in range(len(counted)):
        degree += counted[sender]
    pull = 0.0
    if rules.printed:
        pull = -gather(inbox, heard)[1]
    elif degree > 0.0:
        pull = node.value - gather(inbox, heard)[1] / degree
    signal = 2.0 * node.value - node.previous - rules.wave_speed * rules.wave_speed * pull
    node.previous = node.value
    node.value = signal
    node.estimate = signal

"""Iterations: all nodes speak, packets are handed over or lost, all nodes listen."""

from formicarium.compiled import compiled
from formicarium.connectivity import pi1, pi2, wave
from formicarium.connectivity.global_memory import mirror, strike, tell
from formicarium.connectivity.links import deliver
from formicarium.connectivity.records import Clock, Method, Rows, Source


@compiled
def iterate(networks, stay, nodes, messages, inbox, heard, mirrored, rules, drop, drops, stream, history):
    """Do as many iterations as ``history`` has rows.

    Args:
        networks: (M, K, K) bool, who is in reach of whom; one after the other, the last one stays.
        stay: iterations of each network.
        nodes: (K,) NODE, changed.
        messages: (K,) MESSAGE, room for what is said.
        inbox: (K, K) MESSAGE, room for what is received.
        heard: (K, K) bool, room for from whom.
        mirrored: (K, K) bool, room.
        rules: RULES.
        drop: probability that a packet is lost.
        drops: Drops.
        stream: state of the random stream of packets.
        history: (T, K) written: every node's estimate, or Wave's signal.
    """
    told = rules.norm_source == Source.GLOBAL or rules.mean_source == Source.GLOBAL
    for t in range(len(history)):
        # speak
        for k in range(len(nodes)):
            messages[k].value = nodes[k].value
            messages[k].average = nodes[k].average
        # deliver
        network = networks[min(t // stay, len(networks) - 1)]
        stream = deliver(network, messages, inbox, heard, drop, drops, stream)
        # listen
        if told:
            tell(nodes)
        counted = heard
        summed = heard
        if rules.rows == Rows.MIRRORED:
            mirror(messages, inbox, heard, mirrored)
            summed = mirrored
        for k in range(len(nodes)):
            if rules.method == Method.PI1:
                pi1.listen(nodes[k], inbox[k], heard[k], rules)
            elif rules.method == Method.PI2:
                pi2.listen(nodes[k], inbox[k], heard[k], rules)
            else:
                wave.listen(nodes[k], inbox[k], summed[k], counted[k], rules)
        if rules.clock == Clock.GLOBAL and rules.method != Method.WAVE:
            strike(nodes, rules)
        # note
        for k in range(len(nodes)):
            history[t, k] = nodes[k].estimate

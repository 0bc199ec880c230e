"""Estimators aboard robots: one iteration a control cycle, on whatever messages came through in it (ST-73).

The graph changes while they estimate, and nothing is delivered but what a radio did deliver: links are directed.
"""

import numpy as np

from formicarium.compiled import compiled
from formicarium.connectivity import pi1, pi2, wave
from formicarium.connectivity.estimate import Estimates, begin, eigenvalue
from formicarium.connectivity.parameters import EstimatorTable
from formicarium.connectivity.records import MESSAGE, Method
from formicarium.connectivity.spectrum import read_out

BYTES = 16  # that an estimator adds to every message: two numbers of eight


def estimate_aboard(received: np.ndarray, estimator: EstimatorTable, *, seed: int, every: int = 1) -> Estimates:
    """Run an estimator on the messages of a swarm.

    Args:
        received: (T, K, K) bool, row i of cycle t: from whom robot i heard in it.
        estimator: which, and how; nodes must know nothing but what they hear.
        seed: decides the nodes' starts.
        every: cycles between two that are noted, from the first.

    Raises:
        ValueError: if nodes of this estimator would have to be told what no neighbour can tell them.
    """
    if estimator.uses_global_memory:
        raise ValueError(
            f"estimator.method = {estimator.method}: clock, norm, mean or rows take global memory, which robots do "
            "not have. Take the honest ones, the default"
        )
    cycles, size = received.shape[:2]
    nodes = begin(size, estimator, seed)
    start = nodes["value"].copy()[None]
    history = np.empty((cycles, size))
    iterate_aboard(
        np.ascontiguousarray(received, bool), nodes.view(np.recarray), np.zeros(size, MESSAGE).view(np.recarray),
        np.zeros((size, size), MESSAGE).view(np.recarray), estimator.record(size), history,
    )  # fmt: skip
    noted = np.arange(0, cycles, every)
    if estimator.method != "Wave":
        return Estimates(noted + 1, history[noted], None)
    omega = read_out(
        np.concatenate([start, start, history]), noted + 3, estimator.window, estimator.readout == "interpolated"
    )
    return Estimates(noted + 1, eigenvalue(omega, estimator.wave_speed), omega)


@compiled
def iterate_aboard(received, nodes, messages, inbox, rules, history):
    """Do one iteration a cycle.

    Args:
        received: (T, K, K) bool, row i of cycle t: from whom node i hears in it.
        nodes: (K,) NODE, changed.
        messages: (K,) MESSAGE, room for what is said.
        inbox: (K, K) MESSAGE, room for what is received.
        rules: RULES.
        history: (T, K) written: every node's estimate, or Wave's signal.
    """
    for t in range(len(history)):
        # speak
        for k in range(len(nodes)):
            messages[k].value = nodes[k].value
            messages[k].average = nodes[k].average
        # deliver
        for i in range(len(nodes)):
            for j in range(len(nodes)):
                if received[t, i, j]:
                    inbox[i, j] = messages[j]
        # listen
        for k in range(len(nodes)):
            if rules.method == Method.PI1:
                pi1.listen(nodes[k], inbox[k], received[t, k], rules)
            elif rules.method == Method.PI2:
                pi2.listen(nodes[k], inbox[k], received[t, k], rules)
            else:
                wave.listen(nodes[k], inbox[k], received[t, k], received[t, k], rules)
        # note
        for k in range(len(nodes)):
            history[t, k] = nodes[k].estimate

"""Who hears whom in one iteration: three models of a dropped packet (ST-13)."""

from formicarium.compiled import compiled
from formicarium.connectivity.records import Drops
from formicarium.streams import advanced, uniform


@compiled
def deliver(network, messages, inbox, heard, drop, drops, stream):
    """Hand messages over and return the random stream's next state.

    Args:
        network: (K, K) bool, who is in reach of whom.
        messages: (K,) MESSAGE, what each says.
        inbox: (K, K) MESSAGE, changed: row i is what i has received, one place a sender.
        heard: (K, K) bool, changed: row i says from whom i has a message.
        drop: probability that a packet is lost.
        drops: Drops.
        stream: state of the random stream of packets.
    """
    size = len(network)
    if drops != Drops.HOLD_LAST:
        heard[:] = False
    for i in range(size):
        for j in range(i + 1, size):
            if not network[i, j]:
                heard[i, j] = heard[j, i] = False  # out of reach: nothing is held from before
                continue
            stream = advanced(stream)
            to_i = uniform(stream) >= drop
            to_j = to_i
            if drops != Drops.SYMMETRIC:
                stream = advanced(stream)
                to_j = uniform(stream) >= drop
            if to_i:
                inbox[i, j] = messages[j]
                heard[i, j] = True
            if to_j:
                inbox[j, i] = messages[i]
                heard[j, i] = True
    return stream

"""The cache's automaton (AC-31, TP-43): every sequence of comings and goings up to eight, against the table."""

import itertools

from formicarium.devices.cache_pair import PAIR, Pair, came_in, colour_of, went_out
from formicarium.physics.records import records
from formicarium.robots.records import Colour

BLUE, GREEN, RED, OFF = Colour.BLUE, Colour.GREEN, Colour.RED, Colour.OFF
# what the table says: (state, event) -> next state
TABLE = {
    (Pair.EMPTY, "in 0"): Pair.DROPPING,
    (Pair.DROPPING, "out 0"): Pair.FULL,
    (Pair.FULL, "in 1"): Pair.PICKING,
    (Pair.PICKING, "out 1"): Pair.EMPTY,
}
SHOWN = {
    Pair.EMPTY: (BLUE, OFF),
    Pair.DROPPING: (RED, OFF),
    Pair.FULL: (OFF, GREEN),
    Pair.PICKING: (OFF, RED),
}


def test_every_sequence_of_visits():
    """Inside a dark side a robot sees red until it leaves, and nothing comes of it."""
    for length in range(1, 9):
        for sides in itertools.product((0, 1), repeat=length):
            pair, state, inside = records(PAIR, 1)[0], Pair.EMPTY, [None, None]
            for side in sides:
                if inside[side] is None:
                    noticed = came_in(pair, side)
                    assert noticed == ((state, f"in {side}") in TABLE)
                    state = TABLE.get((state, f"in {side}"), state)
                    inside[side] = noticed
                else:
                    if inside[side]:
                        went_out(pair, side)
                        state = TABLE[(state, f"out {side}")]
                    inside[side] = None
                assert pair.state == state
                for which in (0, 1):
                    shown = colour_of(pair, which, int(inside[which] is not None))
                    assert shown == (RED if inside[which] is not None else SHOWN[state][which])

"""AC-29 to AC-31: the method's equations, its times and the cache's automaton, worked out beside the runs.

Each is held by a test of its own; here the code that runs is asked once more, so that a report says what it stands on.
"""

import itertools

import numpy as np

from formicarium.devices.cache_pair import PAIR, Pair, came_in, went_out
from formicarium.physics.records import records
from formicarium.robots.forager import READING
from formicarium.studies.foraging import Row, Runs
from formicarium.systems.partitioning.choices import close_timer
from formicarium.systems.partitioning.memory import CHART, MEMORY, NEVER, Area, Label
from formicarium.systems.partitioning.parameters import partitioning_parameters
from formicarium.systems.partitioning.strategy import giving_up_probability, partition_probability

TESTED = "tests/systems/partitioning/"
# t_NP, both parts alike (s) -> P_p at S = 5 (TP-13)
EQUATION_1 = (
    *((400, 60, 0.999991), (400, 120, 0.965555), (400, 150, 0.841131), (400, 180, 0.635424), (400, 200, 0.5)),
    *((400, 220, 0.377541), (400, 260, 0.182426), (400, 320, 0.047426), (200, 50, 0.993307), (100, 100, 0.006693)),
)
# s waited, both estimates 60 s -> P_g at K = -0.5, O = -1 (TP-15)
EQUATION_4 = (
    *((0, 0.3208), (30, 0.3486), (60, 0.3775), (120, 0.4378), (180, 0.5)),
    *((240, 0.5622), (360, 0.6792), (600, 0.8520), (1200, 0.9859)),
)
STEEPNESS, LEAST = 5.0, 1e-12
PATIENCE = (-0.5, -1.0)  # K, O
LONGEST = 8  # comings and goings in a row (AC-31)
# what a pair does when a robot comes into or leaves the source side (0) or the nest side (1), TP-43
TABLE = {
    (Pair.EMPTY, "in", 0): Pair.DROPPING,
    (Pair.DROPPING, "out", 0): Pair.FULL,
    (Pair.FULL, "in", 1): Pair.PICKING,
    (Pair.PICKING, "out", 1): Pair.EMPTY,
}


def equations(runs: Runs) -> tuple[str, bool | None]:
    """AC-29: the specification's tables of P_p and P_g, to their last digit; mirror images; the sign of patience."""
    first = max(abs(partition_probability(w, t, t, STEEPNESS, LEAST) - p) for w, t, p in EQUATION_1)
    second = max(abs(giving_up_probability(w, 60.0, 60.0, 60.0, *PATIENCE) - p) for w, p in EQUATION_4)
    ratios = np.geomspace(0.05, 20.0, 400)
    values = np.array([partition_probability(r, 0.5, 0.5, STEEPNESS, LEAST) for r in ratios])
    mirror = float(np.abs(values + values[::-1] - 1.0).max())
    grows = all(np.diff([giving_up_probability(w, 60.0, 60.0, 60.0, *PATIENCE) for w in range(0, 2000, 10)]) > 0)
    words = f"P_p off its table (6 digits) by {first:.0e}, P_g (4 digits) by {second:.0e}, P_p(r) + P_p(1/r) off 1 by "
    words += f"{mirror:.0e}; P_p never falls with r, P_g grows with the wait: {grows} ({TESTED}test_strategy.py)"
    return words, first <= 1e-6 and second <= 1e-4 and mirror < 1e-9 and bool((np.diff(values) >= 0).all()) and grows


def scripted_times(runs: Runs) -> tuple[str, bool | None]:
    """AC-30: a robot with known times against sums by hand; giving up itself is held by the test."""
    memory, reading, chart = records(MEMORY, 1)[0], records(READING, 1)[0], records(CHART, 1)[0]
    table = partitioning_parameters().strategy.record()[0]
    memory.harvest, memory.store, memory.whole, memory.timer, chart.cycle_time = 60.0, 80.0, 150.0, NEVER, 0.1
    # when (s), where, and how the next trip is chosen: a first harvest, 100 s of harvesting, a crossing of 200 s, 50 s
    # of storing, a crossing after giving up
    trace = (
        *((30, Area.SOURCE, Label.CACHE), (130, Area.SOURCE, Label.CORRIDOR), (330, Area.NEST, Label.CACHE)),
        *((380, Area.NEST, Label.GAVE_UP), (700, Area.SOURCE, Label.NONE)),
    )
    for second, area, label in trace:
        reading.cycle, memory.area = 10 * second, area
        close_timer(reading, memory, table, chart, area == Area.NEST)
        memory.timer, memory.set_out, memory.label = reading.cycle, area, label
    expected = (0.2 * 60 + 0.8 * 100, 0.2 * 80 + 0.8 * 50, 0.2 * 150 + 0.8 * 2 * 200)
    found = (float(memory.harvest), float(memory.store), float(memory.whole))
    words = "harvest, store, whole {:.0f}, {:.0f}, {:.0f} s".format(*found)
    words += " after a trace, by hand {:.0f}, {:.0f}, {:.0f}".format(*expected)
    return f"{words} ({TESTED}test_choices.py)", bool(np.allclose(found, expected, rtol=0, atol=1e-9))


def automaton(runs: Runs) -> tuple[str, bool | None]:
    """AC-31: every row of comings and goings at one pair against the table; harvested against stored in the runs."""
    wrong = count = 0
    for sides in itertools.product((0, 1), repeat=LONGEST):
        pair, state, inside = records(PAIR, 1)[0], Pair.EMPTY, [False, False]
        noticed = [False, False]
        for side in sides:
            way = "out" if inside[side] else "in"
            expected = TABLE.get((state, way, side), state)
            if way == "in":
                noticed[side] = bool(came_in(pair, side))
            elif noticed[side]:
                went_out(pair, side)
            else:
                expected = state  # who came in unnoticed leaves nothing behind
            inside[side] = not inside[side]
            state, count = expected, count + 1
            wrong += pair.state != state
    rows = [*runs.performance, *runs.adaptivity, *runs.scalability]
    lost = sum(not _conserved(row) for row in rows)
    words = f"{wrong} of {count} steps of all {2**LONGEST} rows of {LONGEST} off the table"
    words += f" (tests/devices/test_cache_pair.py); objects unaccounted for at the end in {lost} of {len(rows)} runs"
    return words, None if not rows else wrong == 0 and lost == 0


def _conserved(row: Row) -> bool:
    """Tell whether what was harvested is stored, in robots' grippers or in the pairs (TP-47)."""
    under_way = row["harvested"] - row["stored"]
    return 0 <= under_way <= row["robots"] + row.get("arena.cache_pairs", partitioning_parameters().arena.cache_pairs)

"""What the paper says, R1 to R20, tested on our runs: a sentence, what we found, and a plain verdict each."""

from collections.abc import Callable, Iterable
from functools import partial
from statistics import median
from typing import NamedTuple

from formicarium.studies import mark_ii, scaling, smallest_arena
from formicarium.studies.cells import Study, StudyCell, grid
from formicarium.studies.verdicts import LEAST_RUNS, NO_RUNS, Answer, Missing, loses_more

I3, I4, II3, II4 = "mark-i3", "mark-i4", "mark-ii3", "mark-ii4"
Test = Callable[[Study], Answer]

STATEMENTS: tuple[tuple[str, str, Test], ...] = (
    ("R1", "9 of 10 runs of Mark I3 on e-pucks did ten sequences by 2,400 s", smallest_arena.robots),
    ("R2", "27 of 30 simulated runs of Mark I3 did, with 20 robots", partial(smallest_arena.success, variant=I3)),
    ("R3a", "Mark I4: 27 of 30 by 100,000 s, with 22 robots", partial(smallest_arena.success, variant=I4)),
    ("R3b", "Mark I4 is slightly slower than Mark I3", partial(smallest_arena.slower, one=I4, other=I3)),
    ("R4", "Mark II3: 24 of 30 by 100,000 s, with 25 robots", partial(smallest_arena.success, variant=II3)),
    ("R5a", "Mark II4: 20 of 30 by 100,000 s, with 27 robots", partial(smallest_arena.success, variant=II4)),
    ("R5b", "Mark II4 succeeds less often than Mark II3", partial(smallest_arena.less_successful, one=II4, other=II3)),
    (
        "R6",
        "Mark II3: half of the runs in less than 2,000 s",
        partial(smallest_arena.half_by, variant=II3, time=2000.0),
    ),
    (
        "R7",
        "Mark II4: half of the runs only after 8,000 s",
        partial(smallest_arena.half_after, variant=II4, time=8000.0),
    ),
    ("R8", "e-pucks and simulation of Mark I3 perform alike", smallest_arena.alike),
    ("R9a", "Mark I3 scales well to larger arenas with √2 times the robots each", partial(scaling.scales, variant=I3)),
    ("R9b", "so does Mark I4", partial(scaling.scales, variant=I4)),
    ("R10", "the number of chain members of Mark I3 is linear in the side of the arena", scaling.linear),
    ("R11a", "Mark I3: slightly more robots (+20 %) help in all settings", partial(scaling.more_help, variant=I3)),
    ("R11b", "Mark I3: fewer robots (-20 %) degrade success", partial(scaling.fewer_degrade, variant=I3)),
    ("R11c", "Mark I3 is robust to many more robots (+40 to +100 %)", partial(scaling.robust, variant=I3)),
    ("R12a", "Mark I4: slightly more robots (+20 %) mostly help", partial(scaling.more_help, variant=I4)),
    ("R12b", "Mark I4: fewer robots (-20 %) degrade success", partial(scaling.fewer_degrade, variant=I4)),
    ("R12c", "Mark I4: many more robots (+80, +100 %) hurt too", partial(scaling.crowds_hurt, variant=I4)),
    ("R13a", "in one arena Mark I3 has about as many members whatever N", partial(scaling.same_members, variant=I3)),
    (
        "R13b",
        "so has Mark I4 in at least half of the runs of every setting, with the default or more robots",
        partial(scaling.same_members, variant=I4, centre=median),
    ),
    ("R14a", "Mark II3 scales less well than Mark I3", partial(scaling.scales_less, one=II3, other=I3)),
    ("R14b", "Mark II3 is close to one half in the largest arena", partial(scaling.half_of_the_runs, variant=II3)),
    ("R14c", "Mark II3 is less robust to N than Mark I3", partial(loses_more, one=II3, other=I3)),
    ("R15a", "Mark II4 scales less well than Mark I4", partial(scaling.scales_less, one=II4, other=I4)),
    ("R15b", "Mark II4 is less robust to N than Mark I4", partial(loses_more, one=II4, other=I4)),
    (
        "R15c",
        "ten sequences of Mark II4 take longer than of Mark II3",
        partial(smallest_arena.slower, one=II4, other=II3),
    ),
    ("R16a", "Marks II3 and II4 close the loop in about the same time, II4 slightly sooner", mark_ii.same_chain_time),
    ("R16b", "because its branches hold fewer robots", mark_ii.shorter_branches),
    (
        "R17",
        "the first sequence of Mark II4 takes longer than that of Mark II3",
        partial(smallest_arena.slower, one=II4, other=II3, column="time_1_s"),
    ),
    ("R18a", "once Mark II3 has done its first sequence it reliably does ten", partial(mark_ii.reliable, variant=II3)),
    ("R18b", "so does Mark II4", partial(mark_ii.reliable, variant=II4)),
    (
        "R19a",
        "in successful runs of Mark II3 the number of members does not depend on N",
        partial(scaling.same_members, variant=II3, successful=True),
    ),
    ("R19b", "nor in those of Mark II4", partial(scaling.same_members, variant=II4, successful=True)),
    ("R20", "Mark II fails because branches merge, pushed links stay pushed, and runs are long", mark_ii.guesses),
    (
        "TS-151a",
        "derived: without a fault Mark II3 fails as often before its first success as the search tree says",
        partial(mark_ii.searched_in_order, variant=II3),
    ),
    ("TS-151b", "derived: so does Mark II4", partial(mark_ii.searched_in_order, variant=II4)),
    ("TS-151c", "derived: all 6 places of the correct order are as likely", partial(mark_ii.uniform, variant=II3)),
    ("TS-151d", "derived: all 24 are", partial(mark_ii.uniform, variant=II4)),
)


class Claim(NamedTuple):
    """A statement of the paper with what our runs say to it."""

    number: str
    statement: str  # the paper's, re-worded
    finding: str  # ours, in numbers
    verdict: str  # compatible, better, worse, not testable from the text, too few runs yet


def claims(cells: Iterable[StudyCell]) -> list[Claim]:
    """Test every statement on the cells that have enough runs."""
    study = grid(cells, LEAST_RUNS)
    found = []
    for number, statement, test in STATEMENTS:
        try:
            finding, verdict = test(study)
        except Missing as missing:
            finding, verdict = str(missing), NO_RUNS
        found.append(Claim(number, statement, finding, verdict))
    return found

"""How a statement of the paper is judged. Tests and thresholds come from its wording and from what a run of thirty
can tell, and were fixed before the listed runs of Marks I4, II3 and II4 were made; they are the same for all variants.
"""

import math
from collections.abc import Sequence

from formicarium.statistics.compare import fisher
from formicarium.statistics.effects import Effect, holm, risk_difference
from formicarium.statistics.intervals import wilson
from formicarium.studies.cells import NAMES, Study, StudyCell, level_name, pooled

LEAST_RUNS = 10  # of a cell that is tested; fewer would find anything compatible
ALPHA = 0.05
LEAST_R_SQUARED = 0.98  # "linear"; the paper gives no number
MOST_SPREAD = 0.20  # "about the same" while the robots double; the paper gives no number
RELIABLE = 0.90  # "reliably"; the paper gives no number
ABOUT_THE_SAME = (0.75, 1.0)  # ratio of medians, "slightly less"; the paper gives no number

COMPATIBLE, BETTER, WORSE = "compatible", "better", "worse"
UNTESTABLE, NO_RUNS = "not testable from the text", "too few runs yet"

Answer = tuple[str, str]  # finding and verdict


class Missing(Exception):
    """The runs that a statement is about are not there yet."""


def cell_of(study: Study, variant: str, setting: int = 0, level: int = 0) -> StudyCell:
    """Return a cell with enough runs, or raise Missing."""
    cell = study[variant].get(setting, {}).get(level)
    if cell is None:
        raise Missing(f"{NAMES[variant]} has fewer than {LEAST_RUNS} runs in setting {setting}, {level_name(level)}")
    return cell


def defaults(study: Study, variant: str) -> dict[int, StudyCell]:
    """Return the cells with the default number of robots by setting, two at least, or raise Missing."""
    found = {setting: levels[0] for setting, levels in sorted(study[variant].items()) if 0 in levels}
    if len(found) < 2:
        raise Missing(f"runs of {NAMES[variant]} with the default number of robots in fewer than two settings")
    return found


def share_of(successes: int, runs: int) -> str:
    """Write a share with its interval: "27/30 (0.74 to 0.97)"."""
    share = wilson(successes, runs)
    return f"{successes}/{runs} ({share.low:.2f} to {share.high:.2f})"


def sum_up(higher: Sequence[bool], p_values: Sequence[float]) -> str:
    """Sum up tests of "ours is not lower": worse if one is significantly lower, better if one is higher and none so."""
    clear = [up for up, p_value in zip(higher, p_values) if p_value < ALPHA]
    return COMPATIBLE if not clear else BETTER if all(clear) else WORSE


def against(cell: StudyCell, paper: tuple[int, int]) -> Answer:
    """Compare the success of a cell with the paper's (Fisher's exact test)."""
    return against_each({cell.setting: cell}, paper)


def against_each(cells: dict[int, StudyCell], paper: tuple[int, int]) -> Answer:
    """Compare the success of cells by setting with the paper's (Fisher's exact test, Holm over the settings)."""
    p_values = holm([fisher(*cell.counts, *paper).p_value for cell in cells.values()])
    said = [
        f"setting {setting}: {share_of(*cell.counts)}, chain complete in {len(cell.members('members_at_completion'))}, "
        f"p {p_value:.2g}"
        for (setting, cell), p_value in zip(cells.items(), p_values)
    ]
    higher = [cell.successes / len(cell.runs) > paper[0] / paper[1] for cell in cells.values()]
    finding = f"{'; '.join(said)} (Fisher against the paper's {share_of(*paper)}{', Holm' if len(cells) > 1 else ''})"
    return finding, sum_up(higher, p_values)


def not_higher(one: Sequence[StudyCell], other: Sequence[StudyCell]) -> Answer:
    """Test "one succeeds less often than the other", each pooled over its cells: better if it clearly does not."""
    a, b = pooled(one), pooled(other)
    p_value = fisher(*a, *b).p_value
    higher = a[0] / a[1] > b[0] / b[1]
    verdict = BETTER if higher and p_value < ALPHA else COMPATIBLE
    names = [NAMES[cells[0].variant] for cells in (one, other)]
    return f"{names[0]} {share_of(*a)}, {names[1]} {share_of(*b)}, p {p_value:.2g} (Fisher)", verdict


def loss(study: Study, variant: str) -> Effect:
    """Return by how much the success with other numbers of robots is below that with the default, settings pooled."""
    both = [levels for levels in study[variant].values() if 0 in levels and len(levels) > 1]
    if not both:
        raise Missing(f"{NAMES[variant]} has no setting with the default and another number of robots")
    usual = pooled(levels[0] for levels in both)
    return risk_difference(*usual, *pooled(cell for levels in both for level, cell in levels.items() if level))


def loses_more(study: Study, one: str, other: str) -> Answer:
    """Test "one is less robust to N than the other": better if it clearly loses less."""
    a, b = loss(study, one), loss(study, other)
    more = a.value - b.value
    low = more - math.hypot(a.value - a.low, b.high - b.value)
    high = more + math.hypot(a.high - a.value, b.value - b.low)
    finding = (
        f"other numbers of robots lose {a.value:.2f} ({a.low:.2f} to {a.high:.2f}) of success in {NAMES[one]}, "
        f"{b.value:.2f} ({b.low:.2f} to {b.high:.2f}) in {NAMES[other]}; difference {more:+.2f} "
        f"({low:.2f} to {high:.2f})"
    )
    return finding, BETTER if high < 0 else COMPATIBLE

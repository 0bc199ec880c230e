"""What the paper says about Mark I3, tested on our runs: a sentence and a verdict each."""

from collections.abc import Callable, Mapping, Sequence
from statistics import fmean
from typing import NamedTuple

from formicarium.statistics.compare import fisher
from formicarium.statistics.effects import holm
from formicarium.statistics.intervals import wilson
from formicarium.statistics.lines import fit_line
from formicarium.studies.cells import LEVELS, PAPER_SUCCESS, StudyCell, by_setting, level_name

LEAST_RUNS = 10  # of a cell that is tested; fewer would find anything compatible
LEAST_R_SQUARED = 0.98  # "linear"; the paper gives no number
MOST_SPREAD = 0.20  # "about the same" while the robots double; the paper gives no number
ALPHA = 0.05

Study = Mapping[int, Mapping[int, StudyCell]]  # setting -> level -> cell with runs


class Claim(NamedTuple):
    """A statement of the paper with what our runs say to it."""

    number: str
    statement: str  # the paper's, re-worded
    finding: str  # ours, in numbers
    verdict: str  # compatible, better, worse, not testable


def claims(cells: Sequence[StudyCell]) -> list[Claim]:
    """Test R9, R10, R11 (in three parts) and R13."""
    study = by_setting(cell for cell in cells if len(cell.runs) >= LEAST_RUNS)
    tests: list[tuple[str, str, Callable[[Study], tuple[str, str]]]] = [
        ("R9", "success scales to larger arenas with √2 times the robots each (27/30 in the smallest)", _scales),
        ("R10", "the number of chain members is linear in the side of the arena", _linear),
        ("R11a", "slightly more robots (+20 %) help in all settings", _more_help),
        ("R11b", "fewer robots (-20 %) degrade success", _fewer_degrade),
        ("R11c", "success is robust to many more robots (+40 to +100 %)", _robust),
        ("R13", "in one arena the number of chain members is about the same whatever the number of robots", _same),
    ]
    return [Claim(number, statement, *test(study)) for number, statement, test in tests]


def _scales(study: Study) -> tuple[str, str]:
    found = [(setting, levels[0]) for setting, levels in study.items() if 0 in levels]
    if len(found) < 2:
        return "runs with the default number of robots in fewer than two settings", "not testable"
    p_values = holm([fisher(cell.successes, len(cell.runs), *PAPER_SUCCESS).p_value for _, cell in found])
    said = []
    for (setting, cell), p_value in zip(found, p_values):
        share, closed = wilson(cell.successes, len(cell.runs)), len(cell.members("members_at_completion"))
        said.append(
            f"setting {setting}: {cell.successes}/{len(cell.runs)} ({share.low:.2f} to {share.high:.2f}), "
            f"chain complete in {closed}, p {p_value:.2g}"
        )
    paper = PAPER_SUCCESS[0] / PAPER_SUCCESS[1]
    higher = [cell.successes / len(cell.runs) > paper for _, cell in found]
    return f"{'; '.join(said)} (Fisher against 27/30, Holm)", _verdict(higher, p_values)


def _linear(study: Study) -> tuple[str, str]:
    cells = [levels[0] for levels in study.values() if 0 in levels]
    points = [(cell.side, fmean(m)) for cell in cells if (m := cell.members("members_at_completion"))]
    if len(points) < 3:
        return f"completed chains in {len(points)} arenas", "not testable"
    line = fit_line(*zip(*points))
    return (
        f"{line.intercept:.1f} members + {line.slope:.1f} per metre through the means of {len(points)} arenas, "
        f"R² = {line.r_squared:.3f} (we ask for {LEAST_R_SQUARED})",
        "compatible" if line.r_squared >= LEAST_R_SQUARED else "worse",
    )


def _against_default(study: Study, level: int) -> tuple[str, list[bool], list[float], list[int]]:
    """Return what to say, where success is higher than with the default, p-values after Holm, and pooled counts."""
    pairs = [(k, levels[level], levels[0]) for k, levels in study.items() if level in levels and 0 in levels]
    p_values = [fisher(one.successes, len(one.runs), two.successes, len(two.runs)).p_value for _, one, two in pairs]
    said = [
        f"setting {k}: {one.successes}/{len(one.runs)} against {two.successes}/{len(two.runs)}, p {p_value:.2g}"
        for (k, one, two), p_value in zip(pairs, p_values)
    ]
    higher = [one.successes / len(one.runs) > two.successes / len(two.runs) for _, one, two in pairs]
    pooled = [sum(numbers) for numbers in zip(*(
        (one.successes, len(one.runs), two.successes, len(two.runs)) for _, one, two in pairs
    ))]  # fmt: skip
    if pooled:
        said.append(
            f"all {len(pairs)} together: {pooled[0]}/{pooled[1]} against {pooled[2]}/{pooled[3]}, "
            f"p {fisher(*pooled).p_value:.2g} (Fisher)"
        )
    return "; ".join(said), higher, holm(p_values), pooled


def _more_help(study: Study) -> tuple[str, str]:
    finding, higher, p_values, pooled = _against_default(study, 20)
    if not pooled:
        return "no setting has runs with +20 % and with the default", "not testable"
    lower = pooled[0] / pooled[1] < pooled[2] / pooled[3]
    worse = (lower and fisher(*pooled).p_value < ALPHA) or _verdict(higher, p_values) == "worse"
    return finding, "worse" if worse else "compatible"


def _fewer_degrade(study: Study) -> tuple[str, str]:
    finding, _, _, pooled = _against_default(study, -20)
    if not pooled:
        return "no setting has runs with -20 % and with the default", "not testable"
    lower = pooled[0] / pooled[1] < pooled[2] / pooled[3]
    return finding, "compatible" if lower and fisher(*pooled).p_value < ALPHA else "better"


def _robust(study: Study) -> tuple[str, str]:
    said, levels, together, lost = [], [], [], 0
    for level in (level for level in LEVELS if level >= 40):
        _, higher, p_values, pooled = _against_default(study, level)
        if not pooled:
            continue
        down = [p_value < ALPHA and not up for up, p_value in zip(higher, p_values)]
        levels.append(pooled[0] / pooled[1] > pooled[2] / pooled[3])
        together.append(fisher(*pooled).p_value)
        lost += sum(down)
        said.append(
            f"{level_name(level)}: {pooled[0]}/{pooled[1]} against {pooled[2]}/{pooled[3]} in {len(down)} settings, "
            f"p {together[-1]:.2g}, significantly lower in {sum(down)} of them"
        )
    if not said:
        return "no setting has runs with +40 % or more and with the default", "not testable"
    worse = lost or _verdict(levels, holm(together)) == "worse"
    return f"{'; '.join(said)} (Fisher)", "worse" if worse else "compatible"


def _same(study: Study) -> tuple[str, str]:
    spreads, said = [], []
    for setting, levels in study.items():
        cells = [cell for level, cell in levels.items() if level >= 0]
        if len(cells) < 2:
            continue
        means = [fmean(cell.members()) for cell in cells]
        spreads.append((max(means) - min(means)) / fmean(means))
        done = [fmean(values) for cell in cells if (values := cell.members(successful=True))]
        only = f" (successful runs {(max(done) - min(done)) / fmean(done):.0%})" if len(done) > 1 else ""
        said.append(f"setting {setting}: {min(means):.1f} to {max(means):.1f}, spread {spreads[-1]:.0%}{only}")
    if not spreads:
        return "no setting has runs with two numbers of robots from the default upwards", "not testable"
    finding = f"{'; '.join(said)}; mean members at the end, default to +100 % (we ask for at most {MOST_SPREAD:.0%})"
    return finding, "compatible" if max(spreads) <= MOST_SPREAD else "worse"


def _verdict(higher: Sequence[bool], p_values: Sequence[float]) -> str:
    """Sum up tests of "ours is not lower": worse if one is significantly lower, better if one is higher and none so."""
    clear = [up for up, p_value in zip(higher, p_values) if p_value < ALPHA]
    return "compatible" if not clear else "better" if all(clear) else "worse"

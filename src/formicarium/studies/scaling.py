"""R9 to R15: larger arenas, fewer and more robots (Figs 5, 7 and S18)."""

from collections.abc import Callable
from statistics import fmean, median
from typing import NamedTuple

from formicarium.statistics.compare import fisher
from formicarium.statistics.effects import holm
from formicarium.statistics.intervals import wilson
from formicarium.statistics.lines import fit_line
from formicarium.studies.cells import LEVELS, NAMES, PAPER, Study, level_name, pooled
from formicarium.studies.verdicts import (
    ALPHA,
    BETTER,
    COMPATIBLE,
    LEAST_R_SQUARED,
    MOST_SPREAD,
    WORSE,
    Answer,
    Missing,
    against_each,
    cell_of,
    defaults,
    not_higher,
    share_of,
    sum_up,
)


def scales(study: Study, variant: str) -> Answer:
    """R9: success with the default number of robots is in every arena what the paper has in the smallest."""
    return against_each(defaults(study, variant), PAPER[variant])


def linear(study: Study) -> Answer:
    """R10: a straight line through the mean numbers of members at completion."""
    cells = defaults(study, "mark-i3").values()
    points = [(cell.side, fmean(m)) for cell in cells if (m := cell.members("members_at_completion"))]
    if len(points) < 3:
        raise Missing(f"completed chains in {len(points)} arenas")
    line = fit_line(*zip(*points))
    return (
        f"{line.intercept:.1f} members + {line.slope:.1f} per metre through the means of {len(points)} arenas, "
        f"R² = {line.r_squared:.3f} (we ask for {LEAST_R_SQUARED})",
        COMPATIBLE if line.r_squared >= LEAST_R_SQUARED else WORSE,
    )


class Against(NamedTuple):
    """One level of a variant against the default, setting by setting and in all settings that have both."""

    settings: list[int]
    counts: list[tuple[int, int, int, int]]  # successes and runs at the level, successes and runs with the default
    p_values: list[float]  # of the settings, after Holm
    pooled: tuple[int, int, int, int]  # all settings together
    p_value: float

    @property
    def change(self) -> float:
        """Success at this level minus success with the default, all settings together."""
        return self.pooled[0] / self.pooled[1] - self.pooled[2] / self.pooled[3]

    @property
    def lower_in(self) -> int:
        """Settings in which success is significantly lower than with the default."""
        pairs = zip(self.counts, self.p_values)
        return sum(a / n < b / m and p_value < ALPHA for (a, n, b, m), p_value in pairs)

    @property
    def finding(self) -> str:
        """Every setting and all together, in words."""
        each = [
            f"setting {k}: {a}/{n} against {b}/{m}, p {p_value:.2g}"
            for k, (a, n, b, m), p_value in zip(self.settings, self.counts, self.p_values)
        ]
        return f"{'; '.join(each)} (Holm); {self.together}"

    @property
    def together(self) -> str:
        """All settings together, in words."""
        a, n, b, m = self.pooled
        return f"all {len(self.settings)} together: {a}/{n} against {b}/{m}, p {self.p_value:.2g} (Fisher)"


def against_default(study: Study, variant: str, level: int) -> Against:
    """Compare a level with the default by Fisher's exact test, or raise Missing."""
    pairs = [(k, own[level], own[0]) for k, own in sorted(study[variant].items()) if level in own and 0 in own]
    if not pairs:
        raise Missing(f"no setting has runs of {NAMES[variant]} with {level_name(level)} and with the default")
    counts = [(*one.counts, *two.counts) for _, one, two in pairs]
    together = (*pooled(one for _, one, _ in pairs), *pooled(two for _, _, two in pairs))
    p_values = holm([fisher(*four).p_value for four in counts])
    return Against([k for k, _, _ in pairs], counts, p_values, together, fisher(*together).p_value)


def more_help(study: Study, variant: str) -> Answer:
    """R11, R12: success with +20 % is not lower than with the default."""
    found = against_default(study, variant, 20)
    worse = (found.change < 0 and found.p_value < ALPHA) or found.lower_in
    return found.finding, WORSE if worse else COMPATIBLE


def fewer_degrade(study: Study, variant: str) -> Answer:
    """R11, R12: success with -20 % is lower than with the default."""
    found = against_default(study, variant, -20)
    return found.finding, COMPATIBLE if found.change < 0 and found.p_value < ALPHA else BETTER


def _crowds(study: Study, variant: str, least: int) -> list[tuple[int, Against]]:
    found = []
    for level in (level for level in LEVELS if level >= least):
        try:
            found.append((level, against_default(study, variant, level)))
        except Missing:
            continue
    if not found:
        raise Missing(f"no setting has runs of {NAMES[variant]} with {level_name(least)} or more and with the default")
    return found


def _told(found: list[tuple[int, Against]]) -> str:
    return "; ".join(
        f"{level_name(level)}: {one.together}, significantly lower in {one.lower_in} of them" for level, one in found
    )


def robust(study: Study, variant: str) -> Answer:
    """R11: success with +40 to +100 % is not lower than with the default."""
    found = _crowds(study, variant, 40)
    levels = sum_up([one.change > 0 for _, one in found], holm([one.p_value for _, one in found]))
    worse = levels == WORSE or any(one.lower_in for _, one in found)
    return _told(found), WORSE if worse else COMPATIBLE


def crowds_hurt(study: Study, variant: str) -> Answer:
    """R12: success with +80 and +100 % is lower than with the default."""
    found = _crowds(study, variant, 80)
    adjusted = holm([one.p_value for _, one in found])
    hurt = any(one.change < 0 and p_value < ALPHA for (_, one), p_value in zip(found, adjusted))
    return _told(found), COMPATIBLE if hurt else BETTER


def same_members(study: Study, variant: str, centre: Callable = fmean, *, successful: bool = False) -> Answer:
    """R13, R19: members at the end from the default to +100 %, their means or medians setting by setting."""
    spreads, said = [], []
    for setting, levels in sorted(study[variant].items()):
        own = [cell.members(successful=successful) for level, cell in levels.items() if level >= 0]
        middles = [centre(values) for values in own if values]
        if len(middles) < 2:
            continue
        spreads.append((max(middles) - min(middles)) / fmean(middles))
        said.append(f"setting {setting}: {min(middles):.1f} to {max(middles):.1f}, spread {spreads[-1]:.0%}")
    if not spreads:
        raise Missing(f"no setting has runs of {NAMES[variant]} with two numbers of robots from the default upwards")
    what = f"{'median' if centre is median else 'mean'} members of {'successful' if successful else 'all'} runs"
    finding = f"{'; '.join(said)}; {what}, default to +100 % (we ask for at most {MOST_SPREAD:.0%})"
    return finding, COMPATIBLE if max(spreads) <= MOST_SPREAD else WORSE


def half_of_the_runs(study: Study, variant: str) -> Answer:
    """R14: success in the largest arena is close to one half."""
    cell = cell_of(study, variant, 4)
    share = wilson(*cell.counts)
    verdict = WORSE if share.high < 0.5 else BETTER if share.low > 0.5 else COMPATIBLE
    return f"setting 4: {share_of(*cell.counts)}", verdict


def scales_less(study: Study, one: str, other: str) -> Answer:
    """R14, R15: success in the larger arenas, 1 to 4, is lower than another variant's in the same arenas."""
    a, b = defaults(study, one), defaults(study, other)
    both = [k for k in a if k in b and k > 0]
    if not both:
        raise Missing(f"no larger arena with runs of both {NAMES[one]} and {NAMES[other]}")
    finding, verdict = not_higher([a[k] for k in both], [b[k] for k in both])
    return f"settings {', '.join(map(str, both))} together: {finding}", verdict

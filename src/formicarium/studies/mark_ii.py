"""R16 to R20 and the derived checks of the search: what the paper says of Mark II alone (Fig. S19)."""

import math
from collections import Counter
from collections.abc import Iterator
from statistics import fmean

import scipy

from formicarium.statistics.effects import median_ratio
from formicarium.statistics.intervals import wilson
from formicarium.studies.cells import NAMES, VARIANTS, Row, Study
from formicarium.studies.tables import causes
from formicarium.studies.verdicts import (
    ABOUT_THE_SAME,
    ALPHA,
    BETTER,
    COMPATIBLE,
    LEAST_RUNS,
    RELIABLE,
    UNTESTABLE,
    WORSE,
    Answer,
    Missing,
    cell_of,
    share_of,
)

MARKS_II = tuple(name for name, variant in VARIANTS.items() if variant.mark == 2)
FAULTS = ("protocol_faults", "disagreements", "unfounded", "mixed")  # columns that count them
# The causes that the paper guesses at, and the commonest that it does not name -> words in ours.
GUESSES = {
    "branches interfere or merge": ("branch", "loop did not close"),
    "pushed links do not readjust": ("displaced", "did not get round"),
    "long runs": ("too slow", "still growing"),
    "no robot left outside the chain (not the paper's)": ("all robots in",),
}


def same_chain_time(study: Study) -> Answer:
    """R16: II4 closes its loop about as fast as II3, slightly faster: ratio of medians with a bootstrap interval."""
    two, three = (cell_of(study, name) for name in ("mark-ii4", "mark-ii3"))
    column = "time_chain_s"
    sets = [([row[column] for row in cell.runs], cell.ends) for cell in (two, three)]
    ratio = median_ratio(*sets[0], *sets[1])
    low, high = ABOUT_THE_SAME
    finding = (
        f"{two.times(column).median:,.0f} s and {three.times(column).median:,.0f} s, ratio {ratio.value:.2f} "
        f"({ratio.low:.2f} to {ratio.high:.2f}; we ask for {low} to {high})"
    )
    return finding, WORSE if ratio.low > high else BETTER if ratio.high < low else COMPATIBLE


def shorter_branches(study: Study) -> Answer:
    """R16: a branch of II4 holds fewer robots than one of II3 (Mann and Whitney)."""
    two, three = (cell_of(study, name).links_of_branches for name in ("mark-ii4", "mark-ii3"))
    if not two or not three:
        raise Missing("no closed loop in one of the two")
    p_value = float(scipy.stats.mannwhitneyu(two, three, alternative="two-sided").pvalue)
    finding = f"{fmean(two):.1f} links in {len(two)} branches of II4, {fmean(three):.1f} in {len(three)} of II3"
    longer = fmean(two) > fmean(three) and p_value < ALPHA
    return f"{finding}, p {p_value:.2g}", WORSE if longer else COMPATIBLE


def _runs(study: Study, variant: str) -> list[Row]:
    runs = [run for levels in study[variant].values() for cell in levels.values() for run in cell.runs]
    if not runs:
        raise Missing(f"{NAMES[variant]} has no cell with {LEAST_RUNS} runs")
    return runs


def reliable(study: Study, variant: str) -> Answer:
    """R18: of the runs that have done a sequence, those that do ten; all cells pooled."""
    started = [run for run in _runs(study, variant) if run["time_1_s"] is not None]
    if not started:
        raise Missing(f"no run of {NAMES[variant]} with a sequence")
    counts = sum(run["time_10_s"] is not None for run in started), len(started)
    verdict = WORSE if wilson(*counts).high < RELIABLE else COMPATIBLE
    return f"{share_of(*counts)} of the runs with a first sequence, all cells pooled (we ask for {RELIABLE})", verdict


def searched_in_order(study: Study, variant: str) -> Answer:
    """TS-151: without a fault there were as many failed sequences before the first success as the UPI says."""
    found = [run for run in _runs(study, variant) if run["time_1_s"] is not None and run["upi_correct"] is not None]
    sound = [run for run in found if not any(run[fault] for fault in FAULTS)]
    if not sound:
        raise Missing(f"no run of {NAMES[variant]} with a sequence and without a fault")
    equal = sum(run["failed_sequences"] == run["upi_correct"] for run in sound)
    finding = f"{equal} of {len(sound)} runs with a sequence and without a fault ({len(found) - len(sound)} had one)"
    return finding, COMPATIBLE if equal == len(sound) else WORSE


def uniform(study: Study, variant: str) -> Answer:
    """TS-151: every place of the correct order in the search is as likely (chi-square; all cells pooled)."""
    leaves = math.factorial(VARIANTS[variant].tasks)
    numbers = [run["upi_correct"] for run in _runs(study, variant) if run["upi_correct"] is not None]
    if len(numbers) < 5 * leaves:
        raise Missing(f"{len(numbers)} elections in {NAMES[variant]}; the test needs {5 * leaves}")
    counted = Counter(numbers)
    p_value = float(scipy.stats.chisquare([counted[k] for k in range(leaves)]).pvalue)
    finding = f"{len(numbers)} elections, mean {fmean(numbers):.2f} of expected {(leaves - 1) / 2}, p {p_value:.2g}"
    return finding, COMPATIBLE if p_value >= ALPHA else WORSE


def guesses(study: Study) -> Answer:
    """R20: how many failures have a cause of the kind that the paper supposes."""
    found = sum((causes(_runs(study, name)) for name in MARKS_II if study[name]), Counter())
    total = found.total()
    if not total:
        raise Missing("no failed run")
    kinds = Counter(dict.fromkeys(GUESSES, 0))
    for cause, count in found.items():
        kinds[_kind(cause)] += count
    finding = "; ".join(f"{kind}: {count} of {total}" for kind, count in kinds.items())
    return f"{finding}. The paper only supposes its causes, so nothing can contradict them", UNTESTABLE


def _kind(cause: str) -> str:
    def fitting() -> Iterator[str]:
        for kind, words in GUESSES.items():
            if any(word in cause for word in words):
                yield kind

    return next(fitting(), "others")

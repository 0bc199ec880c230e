"""R1 to R8: the smallest arena with the default number of robots (Fig. 4)."""

from formicarium.statistics.compare import log_rank
from formicarium.statistics.effects import hazard_ratio, holm
from formicarium.statistics.intervals import wilson
from formicarium.statistics.runtimes import in_words
from formicarium.studies.cells import NAMES, PAPER, PAPER_ROBOTS, VARIANTS, Study, StudyCell
from formicarium.studies.verdicts import (
    ALPHA,
    BETTER,
    COMPATIBLE,
    WORSE,
    Answer,
    against,
    cell_of,
    not_higher,
    share_of,
    sum_up,
)
from formicarium.systems.sequencing.study import published_run_times

WHAT = {"time_chain_s": "chain", "time_1_s": "first", "time_5_s": "fifth", "time_10_s": "tenth"}


def robots(study: Study) -> Answer:
    """R1: our simulated runs against the paper's ten on e-pucks."""
    return against(cell_of(study, "mark-i3"), PAPER_ROBOTS)


def success(study: Study, variant: str) -> Answer:
    """R2 to R5: success against the paper's thirty simulated runs."""
    return against(cell_of(study, variant), PAPER[variant])


def slower(study: Study, one: str, other: str, column: str = "time_10_s") -> Answer:
    """R3, R15, R17: one variant takes longer than another; better if it is clearly faster (log-rank)."""
    a, b = cell_of(study, one), cell_of(study, other)
    p_value = log_rank(*_seconds(a, column), *_seconds(b, column)).p_value
    ratio = hazard_ratio(*_seconds(a, column), *_seconds(b, column))
    finding = (
        f"medians {in_words(a.times(column).median)} ({NAMES[one]}) and {in_words(b.times(column).median)} "
        f"({NAMES[other]}), rate ratio {ratio.value:.2f} "
        f"({ratio.low:.2f} to {ratio.high:.2f}), p {p_value:.2g} (log-rank)"
    )
    return finding, BETTER if p_value < ALPHA and ratio.value > 1 else COMPATIBLE


def less_successful(study: Study, one: str, other: str) -> Answer:
    """R5: one variant succeeds less often than another."""
    return not_higher([cell_of(study, one)], [cell_of(study, other)])


def half_by(study: Study, variant: str, time: float) -> Answer:
    """R6: half of the runs have done ten sequences by a time; worse if clearly fewer have."""
    cell = cell_of(study, variant)
    finding, high, _ = _by(cell, time)
    return finding, WORSE if high < 0.5 else COMPATIBLE


def half_after(study: Study, variant: str, time: float) -> Answer:
    """R7: half of the runs only after a time; better if clearly more have by then."""
    cell = cell_of(study, variant)
    finding, _, low = _by(cell, time)
    return finding, BETTER if low > 0.5 else COMPATIBLE


def alike(study: Study) -> Answer:
    """R8: e-pucks and simulation take the same time to the chain, 1, 5 and 10 sequences (log-rank, Holm)."""
    cell, cap = cell_of(study, "mark-i3"), VARIANTS["mark-i3"].time_caps[0]
    published = published_run_times()
    p_values, faster, said = [], [], []
    for column, times in published.items():
        ours = [time if time is not None and time < cap else None for time in _seconds(cell, column)[0]]
        sets = ours, [min(end, cap) for end in cell.ends], times, [cap] * len(times)
        p_values.append(log_rank(*sets).p_value)
        ratio = hazard_ratio(*sets)
        faster.append(ratio.value > 1)
        rates = f"rate ratio {ratio.value:.2f} ({ratio.low:.2f} to {ratio.high:.2f})"
        said.append(f"{WHAT[column]}: median {in_words(cell.times(column).median)}, {rates}")
    adjusted = holm(p_values)
    finding = "; ".join(f"{text}, p {p_value:.2g}" for text, p_value in zip(said, adjusted))
    return f"{finding} (log-rank against Table S3, Holm)", sum_up(faster, adjusted)


def _by(cell: StudyCell, time: float) -> tuple[str, float, float]:
    share = wilson(cell.reached(time), len(cell.runs))
    finding = f"by {time:,.0f} s {share_of(share.successes, share.runs)}; median {in_words(cell.times().median)}"
    return finding, share.high, share.low


def _seconds(cell: StudyCell, column: str) -> tuple[list[float | None], list[float]]:
    return [row[column] for row in cell.runs], cell.ends
